// SPDX-License-Identifier: MIT
// Implements quads.h in this order: pairs of triangles, selection of quads by stored tangents, and the choice of faces.
#include "core/mesh/quads/quads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/vec_math.h"
#include "core/mesh/surface/surface.h"
#include "tspace/tangents.h"

namespace tspace {

// Search for pairs of triangles that form quads: candidates are found triangle by triangle, and quads are selected
// along each run of candidates to maximize the total gain.

namespace {

using Corners = std::array<std::uint32_t, 3>;

/// Tests whether two vertices are the same corner of a quad.
class SameVertex {
  public:
    SameVertex(const MeshView& mesh, std::span<const Vec4> tangents) : mesh_(mesh), tangents_(tangents) {}
    bool operator()(std::uint32_t a, std::uint32_t b) const {
        if (a == b) return true;
        return mesh_.positions[a] == mesh_.positions[b] &&
               (mesh_.normals.empty() || mesh_.normals[a] == mesh_.normals[b]) &&
               (mesh_.uvs.empty() || mesh_.uvs[a] == mesh_.uvs[b]) &&
               (tangents_.empty() || tangents_[a] == tangents_[b]);
    }

  private:
    const MeshView& mesh_;
    std::span<const Vec4> tangents_;
};

Corners verticesOf(const MeshView& mesh, std::size_t triangle) {
    return {mesh.indices[3 * triangle], mesh.indices[3 * triangle + 1], mesh.indices[3 * triangle + 2]};
}

/// Returns the unit normal of a triangle, or zero if it has no area.
DVec3 normalOf(const MeshView& mesh, const Corners& v) {
    const DVec3 a = toDouble(mesh.positions[v[0]]);
    DVec3 normal = cross(toDouble(mesh.positions[v[1]]) - a, toDouble(mesh.positions[v[2]]) - a);
    return normalize(normal) ? normal : DVec3{};
}

std::uint8_t seamOf(const MeshView& mesh, const SameVertex& same, const Corners& a, const Corners& b) {
    std::uint8_t seam = 0;
    for (unsigned i = 0; i < 3; ++i) {
        for (unsigned k = 0; k < 3; ++k) {
            if (!same(a[i], b[(k + 1) % 3]) || !same(a[(i + 1) % 3], b[k])) continue;
            if (seam != 0) return 0;  // several shared edges: the triangles have the same corners, or one has no area
            seam = static_cast<std::uint8_t>(1 + 3 * i + k);
        }
    }
    if (seam == 0) return 0;
    // Triangles without area cannot fold back on each other.
    return dot(normalOf(mesh, a), normalOf(mesh, b)) < 0 ? std::uint8_t{0} : seam;
}

/// Returns how closely the corners of a quad are right angles: 1 for a rectangle, 0 if all corners are straight or
/// collapsed.
double squareness(const MeshView& mesh, const std::uint32_t quad[4]) {
    std::array<DVec3, 4> edges;
    for (unsigned k = 0; k < 4; ++k) {
        edges[k] =
            toDouble(mesh.positions[mesh.indices[quad[(k + 1) % 4]]]) - toDouble(mesh.positions[mesh.indices[quad[k]]]);
        if (!normalize(edges[k])) return 0;
    }
    double sum = 0;
    for (unsigned k = 0; k < 4; ++k) sum += std::fabs(dot(edges[k], edges[(k + 1) % 4]));
    return 1 - sum / 4;
}

}  // namespace

QuadCandidates::QuadCandidates(const MeshView& triangles, std::span<const Vec4> tangents) {
    const std::size_t count = triangles.cornerCount() / 3;
    seams_.assign(count, 0);
    const SameVertex same(triangles, tangents);
    for (std::size_t t = 0; t + 1 < count; ++t) {
        seams_[t] = seamOf(triangles, same, verticesOf(triangles, t), verticesOf(triangles, t + 1));
        count_ += seams_[t] != 0;
    }
}

void QuadCandidates::cornersOf(std::size_t t, bool is_turned, std::uint32_t quad[4]) const {
    const std::size_t first = 3 * t, second = first + 3, i = patternOf(t) / 3, k = patternOf(t) % 3;
    const std::array<std::size_t, 4> corners = {first + (i + 1) % 3, first + (i + 2) % 3, first + i,
                                                second + (k + 2) % 3};
    for (unsigned n = 0; n < 4; ++n) quad[n] = static_cast<std::uint32_t>(corners[(n + (is_turned ? 1 : 0)) % 4]);
}

QuadPairs choosePairs(const QuadCandidates& candidates, std::span<const float> gains) {
    const std::size_t count = candidates.triangleCount();
    QuadPairs pairs(count, PairKind::none);
    if (count < 2) return pairs;
    // Computes sums from the end, so that the earlier pair wins among equal sums: most[t] is the maximum gain of
    // triangles t and later.
    std::vector<double> most(count + 1, 0);
    for (std::size_t t = count - 1; t-- > 0;) {
        most[t] = most[t + 1];
        if (candidates.has(t) && gains[t] > 0) most[t] = std::max(most[t], gains[t] + most[t + 2]);
    }
    for (std::size_t t = 0; t + 1 < count; ++t) {
        if (!candidates.has(t) || !(gains[t] > 0) || gains[t] + most[t + 2] < most[t]) continue;
        pairs[t++] = PairKind::quad;
    }
    return pairs;
}

QuadPairs pairsByShape(const MeshView& triangles, const QuadCandidates& candidates) {
    std::array<std::size_t, 9> pattern_counts = {};
    for (std::size_t t = 0; t < candidates.triangleCount(); ++t) {
        if (candidates.has(t)) ++pattern_counts[candidates.patternOf(t)];
    }
    const auto most = static_cast<double>(*std::max_element(pattern_counts.begin(), pattern_counts.end()));
    std::vector<float> gains(candidates.triangleCount(), 0);
    for (std::size_t t = 0; t < gains.size(); ++t) {
        if (!candidates.has(t)) continue;
        std::uint32_t quad[4];
        candidates.cornersOf(t, false, quad);
        const double usual = static_cast<double>(pattern_counts[candidates.patternOf(t)]) / most;
        gains[t] = static_cast<float>(1 + usual + squareness(triangles, quad));
    }
    return choosePairs(candidates, gains);
}

bool hasTies(const MeshView& triangles, const QuadCandidates& candidates, const QuadPairs& pairs) {
    for (std::size_t t = 0; t < pairs.size(); ++t) {
        if (pairs[t] == PairKind::none) continue;
        std::array<std::uint32_t, 4> quad;
        candidates.cornersOf(t, false, quad.data());
        for (std::uint32_t& corner : quad) corner = triangles.indices[corner];
        const auto uv = [&](unsigned k) { return triangles.uvs[quad[k]]; };
        const auto position = [&](unsigned k) { return triangles.positions[quad[k]]; };
        const Vec2 a = uv(2) - uv(0), b = uv(3) - uv(1);
        const Vec3 c = position(2) - position(0), d = position(3) - position(1);
        if (a.x * a.x + a.y * a.y == b.x * b.x + b.y * b.y && dot(c, c) == dot(d, d)) return true;
    }
    return false;
}

QuadFaces facesOfPairs(const QuadCandidates& candidates, const QuadPairs& pairs) {
    QuadFaces faces;
    const std::size_t count = candidates.triangleCount();
    faces.face_corners.resize(3 * count);
    faces.corners.reserve(3 * count);
    const auto add = [&](std::size_t corner) {
        faces.face_corners[corner] = static_cast<std::uint32_t>(faces.corners.size());
        faces.corners.push_back(static_cast<std::uint32_t>(corner));
    };
    for (std::size_t t = 0; t < count; ++t) {
        if (pairs[t] == PairKind::none) {
            for (std::size_t k = 0; k < 3; ++k) add(3 * t + k);
            faces.sizes.push_back(3);
            continue;
        }
        std::array<std::uint32_t, 4> quad;
        candidates.cornersOf(t, pairs[t] == PairKind::turned, quad.data());
        for (const std::uint32_t corner : quad) add(corner);
        // The corners of the second triangle at the diagonal belong to the same face corners as those of the first.
        const std::size_t i = candidates.patternOf(t) / 3, k = candidates.patternOf(t) % 3, second = 3 * (t + 1);
        faces.face_corners[second + k] = faces.face_corners[3 * t + (i + 1) % 3];
        faces.face_corners[second + (k + 1) % 3] = faces.face_corners[3 * t + i];
        faces.sizes.push_back(4);
        ++faces.quad_count;
        ++t;
    }
    return faces;
}

// Selection of pairs by the stored tangents: compares how many corners a pair explains in a mesh with the pair and in a
// mesh without it.

namespace {

/// Minimum share of the corners unexplained by triangles that quads must explain. Selected pairs explain up to 6 % of
/// them in meshes of other programs, and over 70 % if the tangents were computed on quads.
constexpr double kExplainedPart = 0.4;
/// Minimum share of all corners that quads must explain in addition to triangles.
constexpr double kExplainedShare = 0.01;
/// Minimum share of the corners that the faces must explain: faces that explain fewer are not the faces that the
/// tangents were computed on.
constexpr double kLeastExplained = 0.5;
/// Share of the corners that the first two pairings must explain: if they explain less, no other pairing will explain
/// half.
constexpr double kHopelessShare = 0.25;

/// Maximum number of rounds. Which corners a pair explains depends on the neighboring pairs, so pairs are selected
/// again while that explains more.
constexpr int kRounds = 4;

double shareOf(std::uint64_t count, std::uint64_t total) {
    return total == 0 ? 0 : static_cast<double>(count) / static_cast<double>(total);
}

/// Returns the angle between each stored tangent and the computed one, in degrees.
std::vector<float> distances(const MeshView& triangles, std::span<const Vec4> stored, std::span<const Vec4> computed) {
    std::vector<float> degrees(computed.size(), 180);
    for (std::size_t c = 0; c < computed.size(); ++c) {
        const Vec3 a = xyz(stored[triangles.indices[c]]), b = xyz(computed[c]);
        if (!isFinite(a) || !isFinite(b) || a == Vec3{} || b == Vec3{}) continue;
        degrees[c] = static_cast<float>(angleBetween(toDouble(a), toDouble(b)) * (180 / kPi));
    }
    return degrees;
}

class Fitter {
  public:
    Fitter(const MeshView& triangles, std::span<const Vec4> stored, double tolerance_deg,
           const QuadCandidates& candidates, const Execution& execution)
        : triangles_(triangles), stored_(stored), tolerance_deg_(tolerance_deg), candidates_(candidates),
          execution_(execution), votes_(uvVotes(triangles)), alone_(candidates.triangleCount()),
          paired_(candidates.triangleCount(), 0), best_kinds_(candidates.triangleCount(), PairKind::quad) {}

    void takeTriangles(std::span<const Vec4> tangents) {
        const std::vector<float> degrees = distances(triangles_, stored_, tangents);
        for (std::size_t t = 0; t < alone_.size(); ++t) alone_[t] = fitOf(degrees, t);
        fit_.near_on_triangles = fit_.near_on_quads = countNear(degrees);
    }

    [[nodiscard]] bool canWin() const {
        return fit_.corner_count != fit_.near_on_triangles &&
               shareOf(fit_.corner_count - fit_.near_on_triangles, fit_.corner_count) >= kExplainedShare;
    }

    [[nodiscard]] bool isHopeless() const { return shareOf(fit_.near_on_quads, fit_.corner_count) < kHopelessShare; }

    /// Computes tangents with these pairs, records what each pair explains, and keeps the best faces.
    Result<Done> tryPairs(const QuadPairs& pairs) {
        QuadFaces faces = facesOfPairs(candidates_, pairs);
        Result<std::vector<Vec4>> tangents = tangentsOnFaces(triangles_, faces, execution_);
        if (!tangents) return std::move(tangents).error();
        const std::vector<float> degrees = distances(triangles_, stored_, *tangents);
        for (std::size_t t = 0; t < pairs.size(); ++t) {
            if (pairs[t] == PairKind::none) {
                alone_[t] = fitOf(degrees, t);
                continue;
            }
            const float fit = fitOf(degrees, t) + fitOf(degrees, t + 1);
            if (fit > paired_[t]) best_kinds_[t] = pairs[t];
            paired_[t] = best_kinds_[t] == pairs[t] ? fit : std::max(paired_[t], fit);
            ++t;
        }
        const std::uint64_t near = countNear(degrees);
        if (near <= fit_.near_on_quads) return Done{};
        fit_.near_on_quads = near;
        fit_.faces = std::move(faces);
        fit_.tangents = *std::move(tangents);
        return Done{};
    }

    /// Returns the pairs that explain most according to the recorded results. A pair that explains as many corners as
    /// its two triangles is accepted, because quads are preferred.
    [[nodiscard]] QuadPairs bestPairs() const {
        constexpr float kTie = 1e-3F;
        std::vector<float> gains(paired_.size(), 0);
        for (std::size_t t = 0; t + 1 < gains.size(); ++t) {
            if (candidates_.has(t)) gains[t] = paired_[t] - alone_[t] - alone_[t + 1] + kTie;
        }
        QuadPairs pairs = choosePairs(candidates_, gains);
        for (std::size_t t = 0; t < pairs.size(); ++t) {
            if (pairs[t] != PairKind::none) pairs[t] = best_kinds_[t];
        }
        return pairs;
    }

    QuadFit& fit() { return fit_; }

  private:
    /// Returns how well the triangle's corners are explained: 0 to 1 per corner, 1 for equal tangents, and at least 0.5
    /// within the tolerance.
    [[nodiscard]] float fitOf(const std::vector<float>& degrees, std::size_t t) const {
        if (votes_[t] == 0) return 0;
        float sum = 0;
        for (std::size_t c = 3 * t; c < 3 * t + 3; ++c)
            sum += (isNear(degrees[c]) ? 0.5F : 0.0F) + 0.5F / (1 + 10 * degrees[c]);
        return sum;
    }

    [[nodiscard]] bool isNear(float degrees) const { return degrees <= tolerance_deg_; }

    std::uint64_t countNear(const std::vector<float>& degrees) {
        std::uint64_t near = 0;
        fit_.corner_count = 0;
        for (std::size_t c = 0; c < degrees.size(); ++c) {
            if (votes_[c / 3] == 0) continue;
            ++fit_.corner_count;
            near += isNear(degrees[c]) ? 1 : 0;
        }
        return near;
    }

    const MeshView& triangles_;
    std::span<const Vec4> stored_;
    double tolerance_deg_;
    const QuadCandidates& candidates_;
    const Execution& execution_;
    std::vector<std::uint8_t> votes_;
    std::vector<float> alone_,
        paired_;            ///< corners that were explained in the last computation, by single triangles and by pairs
    QuadPairs best_kinds_;  ///< kind of each pair (`quad` or `turned`) that explained most
    QuadFit fit_ = {};
};

/// Returns alternative pairs: none of them is in `pairs`, but they may contain the same triangles.
QuadPairs otherPairs(const QuadCandidates& candidates, const QuadPairs& pairs) {
    std::vector<float> gains(pairs.size());
    for (std::size_t t = 0; t < pairs.size(); ++t) gains[t] = pairs[t] == PairKind::none ? 1.0F : 0.0F;
    return choosePairs(candidates, gains);
}

QuadPairs turnedPairs(QuadPairs pairs) {
    for (PairKind& kind : pairs) kind = kind == PairKind::none ? kind : PairKind::turned;
    return pairs;
}

}  // namespace

bool quadsWin(std::uint64_t corner_count, std::uint64_t near_on_triangles, std::uint64_t near_on_quads) {
    if (near_on_quads <= near_on_triangles) return false;
    const std::uint64_t gained = near_on_quads - near_on_triangles;
    return shareOf(near_on_quads, corner_count) >= kLeastExplained &&
           shareOf(gained, corner_count) >= kExplainedShare &&
           shareOf(gained, corner_count - near_on_triangles) >= kExplainedPart;
}

Result<std::vector<Vec4>> tangentsOnFaces(const MeshView& triangles, const QuadFaces& faces,
                                          const Execution& execution) {
    std::vector<std::uint32_t> indices(faces.corners.size());
    for (std::size_t c = 0; c < indices.size(); ++c) indices[c] = triangles.indices[faces.corners[c]];
    MeshView mesh = triangles;
    mesh.indices = IndexView(std::span<const std::uint32_t>(indices));
    mesh.face_sizes = faces.sizes;
    std::vector<Vec4> on_faces(indices.size());
    const Result<TangentReport> made =
        generateTangents(mesh, {.convention = conventions::opengl}, {.tangents = on_faces}, execution);
    if (!made) return made.error();
    std::vector<Vec4> tangents(faces.face_corners.size());
    for (std::size_t c = 0; c < tangents.size(); ++c) tangents[c] = on_faces[faces.face_corners[c]];
    return tangents;
}

Result<QuadFit> fitQuads(const MeshView& triangles, std::span<const Vec4> stored, const Execution& execution,
                         double tolerance_deg, std::span<const Vec4> on_triangles) {
    const QuadCandidates candidates(triangles, stored);
    if (candidates.count() == 0) return QuadFit{};
    Fitter fitter(triangles, stored, tolerance_deg, candidates, execution);
    std::vector<Vec4> computed;
    if (on_triangles.empty()) {
        computed.resize(triangles.cornerCount());
        const Result<TangentReport> made =
            generateTangents(triangles, {.convention = conventions::opengl}, {.tangents = computed}, execution);
        if (!made) return made.error();
        on_triangles = computed;
    }
    fitter.takeTriangles(on_triangles);
    if (!fitter.canWin()) return std::move(fitter.fit());
    const QuadPairs by_shape = pairsByShape(triangles, candidates);
    if (Result<Done> done = fitter.tryPairs(by_shape); !done) return std::move(done).error();
    if (hasTies(triangles, candidates, by_shape)) {
        if (Result<Done> done = fitter.tryPairs(turnedPairs(by_shape)); !done) return std::move(done).error();
    }
    if (Result<Done> done = fitter.tryPairs(otherPairs(candidates, by_shape)); !done) return std::move(done).error();
    for (int round = 0; round < kRounds && !fitter.isHopeless(); ++round) {
        const std::uint64_t before = fitter.fit().near_on_quads;
        if (Result<Done> done = fitter.tryPairs(fitter.bestPairs()); !done) return std::move(done).error();
        if (round > 0 && fitter.fit().near_on_quads == before) break;
    }
    return std::move(fitter.fit());
}

// Choice of the faces by evidence: first the stored tangents, then the program that wrote the file.

namespace {

/// Minimum share of the triangles in pairs with one of Blender's two edge patterns for a mesh to count as a quad mesh
/// from Blender. Nearly all triangles of a quad mesh are in such pairs, but few triangles of a triangle mesh.
constexpr double kLeastBlenderShare = 0.6;

/// Returns whether the pattern is one that Blender writes. Blender cuts a quad along its first and third corner (or, if
/// this would flip a triangle, along the others), and writes the corners of both triangles in the order of the quad.
bool isBlenderPattern(unsigned pattern) {
    constexpr unsigned kFan = 3 * 2 + 0, kOther = 3 * 1 + 2;
    return pattern == kFan || pattern == kOther;
}

bool areBlenderQuads(const QuadCandidates& candidates, const QuadPairs& pairs) {
    std::size_t count = 0;
    for (std::size_t t = 0; t < pairs.size(); ++t) {
        if (pairs[t] != PairKind::none && isBlenderPattern(candidates.patternOf(t))) count += 2;
    }
    return static_cast<double>(count) >= kLeastBlenderShare * static_cast<double>(candidates.triangleCount());
}

}  // namespace

Result<QuadFaces> chooseFaces(const MeshView& triangles, std::span<const Vec4> stored, bool is_from_blender,
                              Faces faces, const Execution& execution) {
    if (faces == Faces::triangles) return QuadFaces{};
    if (!stored.empty()) {
        Result<QuadFit> fit = fitQuads(triangles, stored, execution);
        if (!fit) return std::move(fit).error();
        if (fit->wins()) return std::move(fit->faces);
        if (faces == Faces::automatic) return QuadFaces{};
    } else if (faces == Faces::automatic && !is_from_blender) {
        return QuadFaces{};
    }
    const QuadCandidates candidates(triangles);
    if (candidates.count() == 0) return QuadFaces{};
    const QuadPairs pairs = pairsByShape(triangles, candidates);
    if (faces == Faces::automatic && !areBlenderQuads(candidates, pairs)) return QuadFaces{};
    return facesOfPairs(candidates, pairs);
}

QuadFaces facesOfPolygons(std::span<const std::uint32_t> face_sizes, const Triangulation& triangles) {
    constexpr std::uint32_t kSkipped = 0xffffffffU;
    QuadFaces faces;
    std::vector<std::uint32_t> face_corner_of;  // for each corner of a polygon: its corner in `faces`
    for (const std::uint32_t size : face_sizes) {
        for (std::uint32_t k = 0; k < size; ++k) {
            face_corner_of.push_back(size < 3 ? kSkipped : static_cast<std::uint32_t>(faces.corners.size()));
            if (size >= 3) faces.corners.push_back(kSkipped);
        }
        if (size >= 3) faces.sizes.push_back(size);
        faces.quad_count += size > 3 ? 1 : 0;
    }
    faces.face_corners.reserve(triangles.corners.size());
    for (std::size_t c = 0; c < triangles.corners.size(); ++c) {
        const std::uint32_t face_corner = face_corner_of[triangles.corners[c]];
        faces.corners[face_corner] = static_cast<std::uint32_t>(c);
        faces.face_corners.push_back(face_corner);
    }
    return faces;
}

}  // namespace tspace
