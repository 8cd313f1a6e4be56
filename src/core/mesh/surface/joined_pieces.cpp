// SPDX-License-Identifier: MIT
// Finds the pieces that form one surface: first equal points, then votes for pairs of pieces from their shared edges
// and triangles, and finally groups of pieces.
#include "core/mesh/surface/surface.h"

#include <algorithm>
#include <tuple>

#include "core/base/mesh_loops.h"
#include "core/base/near_positions.h"
#include "core/base/owned_mesh.h"
#include "core/base/parallel.h"
#include "core/base/sort.h"
#include "core/base/unique_index.h"

namespace tspace {
namespace {

constexpr std::uint32_t kNoPiece = 0xffffffffu;
/// Two pieces coincide if at least one in this many triangles of the smaller piece coincides with a triangle of the
/// other.
constexpr std::size_t kOverlap = 10;

}  // namespace

JoinedPieces::JoinedPieces(std::span<const std::span<const Vec3>> vertex_lists, std::span<const SurfacePiece> pieces,
                           float weld_distance)
    : pieces_(pieces) {
    weld(vertex_lists, weld_distance);
    markShared();
    std::map<Pair, Votes> votes;
    voteByEdges(votes);
    voteByTriangles(votes);
    group(votes);
    std::erase_if(borders_, [&](const Border& border) {
        return !areJoined(border.triangles[0].piece, border.triangles[1].piece);
    });
    listTriangles();
}

void JoinedPieces::weld(std::span<const std::span<const Vec3>> vertex_lists, float distance) {
    OwnedMesh all;
    for (const std::span<const Vec3> list : vertex_lists) {
        first_vertex_.push_back(all.positions.size());
        all.positions.insert(all.positions.end(), list.begin(), list.end());
    }
    for (const SurfacePiece& piece : pieces_) {
        for (const std::uint32_t corner : piece.corners)
            all.indices.push_back(static_cast<std::uint32_t>(first_vertex_[piece.vertices] + corner));
    }
    Parallel parallel(Execution{}, all.indices.size());
    const NearMesh near(all.view(), distance, nullptr, parallel);
    const StridedSpan<const Vec3>& positions = near.view().positions;
    UniqueIndex<std::array<std::uint32_t, 3>> points(positions.count);
    points_.reserve(positions.count);
    for (std::size_t v = 0; v < positions.count; ++v) points_.push_back(points.indexOf(positionKey(positions[v])));
    is_shared_.resize(points.size());
}

void JoinedPieces::markShared() {
    std::vector<std::uint32_t> owner(is_shared_.size(), kNoPiece);
    for (std::uint32_t piece = 0; piece < pieces_.size(); ++piece) {
        for (const std::uint32_t vertex : pieces_[piece].corners) {
            const std::uint32_t point = pointOf(piece, vertex);
            if (owner[point] == kNoPiece) owner[point] = piece;
            if (owner[point] != piece) is_shared_[point] = true;
        }
    }
}

/// Counts the votes of shared edges. Edges of more than two triangles are ignored, because their neighbors are
/// ambiguous.
void JoinedPieces::voteByEdges(std::map<Pair, Votes>& votes) {
    std::vector<PieceTriangle> triangles;
    for (std::uint32_t piece = 0; piece < pieces_.size(); ++piece) {
        for (std::uint32_t t = 0; t < pieces_[piece].corners.size() / 3; ++t) triangles.push_back({piece, t});
    }
    const auto pointAt = [&](std::uint32_t c) { return corner(triangles[c / 3], c % 3); };
    const auto forHalves = [&](const auto& add) {
        for (std::uint32_t c = 0; c < 3 * triangles.size(); ++c) {
            const std::uint32_t a = pointAt(c), b = pointAt(c % 3 == 2 ? c - 2 : c + 1);
            if (a != b && is_shared_[a] && is_shared_[b]) add(std::min(a, b), std::max(a, b), c);
        }
    };
    forEachEdge(is_shared_.size(), nullptr, forHalves,
                [&](std::uint32_t low, std::uint32_t high, std::span<const HalfEdge> halves) {
                    if (halves.size() != 2) return;
                    const std::uint32_t first = cornerOf(halves[0]), second = cornerOf(halves[1]);
                    const PieceTriangle &a = triangles[first / 3], &b = triangles[second / 3];
                    if (a.piece == b.piece) return;
                    Votes& pair = votes[{a.piece, b.piece}];
                    const bool agrees = pointAt(first) != pointAt(second);
                    ++(agrees ? pair.agreeing : pair.turned);
                    if (agrees) borders_.push_back({{a, b}, {low, high}});
                });
}

void JoinedPieces::voteByTriangles(std::map<Pair, Votes>& votes) const {
    std::vector<std::pair<std::array<std::uint32_t, 3>, std::uint32_t>> triangles;
    for (std::uint32_t piece = 0; piece < pieces_.size(); ++piece) {
        for (std::uint32_t t = 0; t < pieces_[piece].corners.size() / 3; ++t) {
            std::array<std::uint32_t, 3> points = {corner({piece, t}, 0), corner({piece, t}, 1), corner({piece, t}, 2)};
            if (!is_shared_[points[0]] || !is_shared_[points[1]] || !is_shared_[points[2]]) continue;
            sortList(points.begin(), points.end());
            if (points[0] != points[1] && points[1] != points[2]) triangles.emplace_back(points, piece);
        }
    }
    sortList(triangles.begin(), triangles.end());
    for (std::size_t i = 1; i < triangles.size(); ++i) {
        if (triangles[i].first == triangles[i - 1].first && triangles[i].second != triangles[i - 1].second)
            ++votes[{triangles[i - 1].second, triangles[i].second}].overlapping;
    }
}

void JoinedPieces::group(const std::map<Pair, Votes>& votes) {
    const auto lie = [&](std::uint32_t a, std::uint32_t b) {
        const auto found = votes.find({std::min(a, b), std::max(a, b)});
        const std::size_t least = std::min(pieces_[a].corners.size(), pieces_[b].corners.size()) / 3;
        return found != votes.end() && found->second.overlapping > 0 && found->second.overlapping * kOverlap >= least;
    };
    for (std::uint32_t piece = 0; piece < pieces_.size(); ++piece) {
        group_.push_back(piece);
        groups_.push_back({piece});
    }
    for (const auto& [pair, vote] : votes) {
        const std::uint32_t a = group_[pair.first], b = group_[pair.second];
        if (a == b || vote.agreeing <= vote.turned) continue;
        const bool overlap = std::any_of(groups_[a].begin(), groups_[a].end(), [&](std::uint32_t one) {
            return std::any_of(groups_[b].begin(), groups_[b].end(),
                               [&](std::uint32_t other) { return lie(one, other); });
        });
        if (overlap) continue;
        for (const std::uint32_t piece : groups_[b]) group_[piece] = a;
        groups_[a].insert(groups_[a].end(), groups_[b].begin(), groups_[b].end());
        groups_[b].clear();
    }
}

void JoinedPieces::listTriangles() {
    begins_.assign(is_shared_.size() + 2, 0);
    const auto forAll = [&](const auto& call) {
        for (std::uint32_t piece = 0; piece < pieces_.size(); ++piece) {
            if (othersOf(piece) == 0) continue;
            for (std::uint32_t t = 0; t < pieces_[piece].corners.size() / 3; ++t) {
                for (std::size_t k = 0; k < 3; ++k) call(PieceTriangle{piece, t}, corner({piece, t}, k));
            }
        }
    };
    forAll([&](const PieceTriangle&, std::uint32_t point) { ++begins_[point + 2]; });
    for (std::size_t p = 2; p < begins_.size(); ++p) begins_[p] += begins_[p - 1];
    triangles_.resize(begins_.back());
    forAll([&](const PieceTriangle& at, std::uint32_t point) { triangles_[begins_[point + 1]++] = at; });
}

std::vector<std::uint32_t> JoinedPieces::sharedPoints(std::uint32_t piece) const {
    std::vector<std::uint32_t> result;
    for (const std::uint32_t vertex : pieces_[piece].corners) {
        const std::uint32_t point = pointOf(piece, vertex);
        if (is_shared_[point]) result.push_back(point);
    }
    sortList(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    std::erase_if(result, [&](std::uint32_t point) {
        return std::none_of(triangles_.begin() + begins_[point], triangles_.begin() + begins_[point + 1],
                            [&](const PieceTriangle& at) { return at.piece != piece && areJoined(at.piece, piece); });
    });
    return result;
}

std::vector<PieceTriangle> JoinedPieces::around(std::uint32_t piece, unsigned rings) const {
    std::vector<PieceTriangle> result;
    std::vector<std::uint32_t> points = sharedPoints(piece);
    const auto isLess = [](const PieceTriangle& a, const PieceTriangle& b) {
        return std::tie(a.piece, a.triangle) < std::tie(b.piece, b.triangle);
    };
    for (; rings != 0 && !points.empty(); --rings) {
        for (const std::uint32_t point : points) {
            for (std::uint32_t i = begins_[point]; i < begins_[point + 1]; ++i) {
                const PieceTriangle& at = triangles_[i];
                if (at.piece != piece && areJoined(at.piece, piece)) result.push_back(at);
            }
        }
        sortList(result.begin(), result.end(), isLess);
        const auto isSame = [](const PieceTriangle& a, const PieceTriangle& b) {
            return a.piece == b.piece && a.triangle == b.triangle;
        };
        result.erase(std::unique(result.begin(), result.end(), isSame), result.end());
        if (rings == 1) break;
        points.clear();
        for (const PieceTriangle& at : result) {
            for (std::size_t k = 0; k < 3; ++k) points.push_back(corner(at, k));
        }
        sortList(points.begin(), points.end());
        points.erase(std::unique(points.begin(), points.end()), points.end());
    }
    return result;
}

}  // namespace tspace
