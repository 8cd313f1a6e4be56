// SPDX-License-Identifier: MIT
// Detection of triangle faults. Triangles wound against their neighbors are found by union-find: each triangle stores
// whether its winding equals that of the root of its set.
#include "core/mesh/pools/primitive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "core/base/near_positions.h"
#include "core/base/parallel.h"
#include "core/base/sort.h"
#include "core/base/unique_index.h"
#include "core/base/vec_math.h"
#include "core/mesh/surface/surface.h"
#include "tspace/span.h"

namespace tspace {
namespace {

struct WindingCounts {
    /// Number of triangles with the minority winding of their component, where components consist of triangles
    /// connected over edges that exactly two triangles share. A component that is inside out as a whole has none.
    std::uint64_t turned_count = 0;
    /// Number of triangles in two-sided sheets: another triangle, or the other diagonal split of a flat quad, covers
    /// the same positions with the opposite winding.
    std::uint64_t two_sided_count = 0;
};

class WoundSets {
  public:
    explicit WoundSets(std::size_t count) : parents_(count), turned_(count, 0) {
        for (std::uint32_t i = 0; i < count; ++i) parents_[i] = i;
    }

    /// Returns the root, and whether the triangle is wound opposite to it.
    std::pair<std::uint32_t, bool> find(std::uint32_t triangle) {
        bool turned = false;
        std::uint32_t root = triangle;
        for (; parents_[root] != root; root = parents_[root]) turned = turned != (turned_[root] != 0);
        bool rest = turned;
        for (std::uint32_t i = triangle; parents_[i] != i;) {
            const std::uint32_t next = std::exchange(parents_[i], root);
            const bool own = std::exchange(turned_[i], std::uint8_t{rest}) != 0;
            rest = rest != own;
            i = next;
        }
        return {root, turned};
    }
    /// Joins the sets of two triangles with equal or opposite winding.
    void join(std::uint32_t a, std::uint32_t b, bool alike) {
        const auto [root_a, turned_a] = find(a);
        const auto [root_b, turned_b] = find(b);
        if (root_a == root_b) return;
        parents_[root_b] = root_a;
        turned_[root_b] = std::uint8_t{(turned_a != turned_b) == alike};
    }

  private:
    std::vector<std::uint32_t> parents_;
    std::vector<std::uint8_t> turned_;
};

struct EdgeUse {
    std::uint32_t low, high, triangle;
    bool is_forward;
};

/// A face (triangle or quad) with its points in a canonical order, equal for both windings.
template <std::size_t count>
struct Side {
    std::array<std::uint32_t, count> points = {};
    std::array<std::uint32_t, 2> triangles = {};
    bool is_even = false;  ///< true: `points` is a rotation of the face's order; false: a rotation of its reverse

    Side(std::array<std::uint32_t, count> p, std::array<std::uint32_t, 2> of) : points(p), triangles(of) {
        std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
        is_even = points[1] < points[count - 1];
        if (!is_even) std::swap(points[1], points[count - 1]);
    }
};

/// Marks the triangles of faces that exist in both windings.
template <std::size_t count>
void markTwoSided(std::vector<Side<count>>& sides, std::vector<bool>& marked) {
    sortList(sides.begin(), sides.end(),
             [](const Side<count>& a, const Side<count>& b) { return a.points < b.points; });
    for (std::size_t i = 0, past = 0; i < sides.size(); i = past) {
        std::size_t even = 0;
        while (past < sides.size() && sides[past].points == sides[i].points) even += sides[past++].is_even ? 1U : 0U;
        if (even == 0 || even == past - i) continue;
        for (; i < past; ++i) {
            for (const std::uint32_t triangle : sides[i].triangles) marked[triangle] = true;
        }
    }
}

/// Finds two-sided sheets: triangle by triangle, or quad by quad if the two sides have different diagonals.
class Sheets {
  public:
    Sheets(const StridedSpan<const Vec3>& positions, std::span<const std::uint32_t> corners,
           std::span<const std::uint32_t> points)
        : positions_(positions), corners_(corners), points_(points) {}

    [[nodiscard]] std::uint64_t count(std::span<const EdgeUse> edges) const {
        std::vector<bool> marked(corners_.size() / 3, false);
        std::vector<Side<3>> triangles;
        for (std::uint32_t t = 0; t < marked.size(); ++t) {
            const std::array<std::uint32_t, 3> p = {at(t, 0), at(t, 1), at(t, 2)};
            if (p[0] != p[1] && p[1] != p[2] && p[2] != p[0]) triangles.push_back({p, {t, t}});
        }
        markTwoSided(triangles, marked);
        std::vector<Side<4>> quads;
        for (std::size_t i = 0, past = 0; i < edges.size(); i = past) {
            while (past < edges.size() && edges[past].low == edges[i].low && edges[past].high == edges[i].high) ++past;
            if (past - i != 2 || edges[i].is_forward == edges[i + 1].is_forward) continue;
            addQuad(edges[i].is_forward ? edges[i] : edges[i + 1], edges[i].is_forward ? edges[i + 1] : edges[i],
                    quads);
        }
        markTwoSided(quads, marked);
        return static_cast<std::uint64_t>(std::count(marked.begin(), marked.end(), true));
    }

  private:
    [[nodiscard]] std::uint32_t at(std::uint32_t triangle, std::size_t k) const {
        return points_[3 * std::size_t{triangle} + k];
    }
    /// Returns the corner opposite to an edge.
    [[nodiscard]] std::size_t across(const EdgeUse& edge) const {
        std::size_t c = 3 * std::size_t{edge.triangle};
        while (points_[c] == edge.low || points_[c] == edge.high) ++c;
        return c;
    }
    [[nodiscard]] bool isCollapsed(std::uint32_t t) const {
        return at(t, 0) == at(t, 1) || at(t, 1) == at(t, 2) || at(t, 2) == at(t, 0);
    }

    /// Adds a quad if it is flat. Others are rejected: the two pairs of faces of a tetrahedron also share four points,
    /// but are no two-sided sheet. `from` runs from the point with the lower index to the other one.
    void addQuad(const EdgeUse& from, const EdgeUse& back, std::vector<Side<4>>& quads) const {
        constexpr double kFlat = 1e-6;
        if (isCollapsed(from.triangle) || isCollapsed(back.triangle)) return;
        const std::size_t c = across(from), d = across(back);
        const auto edge = [&](std::size_t corner, std::size_t other) {
            return toDouble(positions_[corners_[corner]]) - toDouble(positions_[corners_[other]]);
        };
        const std::size_t first = c / 3 * 3;
        const DVec3 a = edge(first + 1, first), b = edge(first + 2, first), e = edge(d, first);
        const DVec3 normal = cross(a, b);
        if (std::fabs(dot(normal, e)) > kFlat * length(normal) * length(e)) return;
        quads.push_back({{from.low, points_[d], from.high, points_[c]}, {from.triangle, back.triangle}});
    }

    StridedSpan<const Vec3> positions_;
    std::span<const std::uint32_t> corners_, points_;
};

/// Counts winding faults. `corners`: three per triangle. Positions are compared exactly, but -0 equals 0. O(n log n);
/// 200 bytes per triangle and 20 per vertex temporarily.
WindingCounts countWinding(const StridedSpan<const Vec3>& positions, std::span<const std::uint32_t> corners) {
    UniqueIndex<std::array<std::uint32_t, 3>> places(positions.count);
    std::vector<std::uint32_t> points(corners.size());
    for (std::size_t c = 0; c < corners.size(); ++c) points[c] = places.indexOf(positionKey(positions[corners[c]]));
    std::vector<EdgeUse> edges;
    edges.reserve(corners.size());
    const auto triangle_count = static_cast<std::uint32_t>(corners.size() / 3);
    for (std::uint32_t t = 0; t < triangle_count; ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = points[3 * std::size_t{t} + k], b = points[3 * std::size_t{t} + (k + 1) % 3];
            if (a != b) edges.push_back({std::min(a, b), std::max(a, b), t, a < b});
        }
    }
    sortList(edges.begin(), edges.end(), [](const EdgeUse& a, const EdgeUse& b) {
        return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    });
    WoundSets sets(triangle_count);
    for (std::size_t i = 0, past = 0; i < edges.size(); i = past) {
        while (past < edges.size() && edges[past].low == edges[i].low && edges[past].high == edges[i].high) ++past;
        if (past - i != 2) continue;
        sets.join(edges[i].triangle, edges[i + 1].triangle, edges[i].is_forward != edges[i + 1].is_forward);
    }
    std::vector<std::array<std::uint64_t, 2>> ways(triangle_count);
    for (std::uint32_t t = 0; t < triangle_count; ++t) {
        const auto [root, turned] = sets.find(t);
        ++ways[root][turned ? 1 : 0];
    }
    WindingCounts winding;
    for (const auto& [as_root, other] : ways) winding.turned_count += std::min(as_root, other);
    winding.two_sided_count = Sheets(positions, corners, points).count(edges);
    return winding;
}

/// Counts the faults of one primitive. `positions` come from NearMesh, because neighbors are found by equal positions.
void countFaultsOf(const StridedSpan<const Vec3>& positions, std::span<const Vec3> normals,
                   std::span<const std::uint32_t> corners, FramesReport& report) {
    for (std::size_t c = 0; !normals.empty() && c + 2 < corners.size(); c += 3) {
        const DVec3 first = toDouble(positions[corners[c]]);
        const DVec3 face =
            cross(toDouble(positions[corners[c + 1]]) - first, toDouble(positions[corners[c + 2]]) - first);
        for (std::size_t k = 0; k < 3; ++k)
            report.normals_behind_count += dot(face, toDouble(normals[corners[c + k]])) < 0 ? 1U : 0U;
    }
    const WindingCounts winding = countWinding(positions, corners);
    report.turned_triangle_count = winding.turned_count;
    report.two_sided_triangle_count = winding.two_sided_count;
}

}  // namespace

void countFaults(std::span<const Vec3> positions, std::span<const Vec3> normals,
                 std::span<const std::vector<std::uint32_t>> corner_lists, float weld_distance,
                 std::span<FramesReport> reports) {
    // Close positions are searched once for all primitives, because each may use a small part of the vertices.
    std::vector<std::uint32_t> corners;
    for (const std::vector<std::uint32_t>& list : corner_lists) corners.insert(corners.end(), list.begin(), list.end());
    Parallel parallel(Execution{}, corners.size());
    const NearMesh near({.positions = positions, .indices = corners}, weld_distance, nullptr, parallel);
    for (std::size_t p = 0; p < reports.size(); ++p)
        countFaultsOf(near.view().positions, normals, corner_lists[p], reports[p]);
}

}  // namespace tspace
