// SPDX-License-Identifier: MIT
// Detection of triangle faults. Triangles wound against their neighbors are found by union-find.
#include "core/mesh/pools/primitive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "core/base/disjoint_sets.h"
#include "core/base/mesh_loops.h"
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

/// Joins two triangles with equal or opposite winding. Member 2 t of the sets is triangle t, and 2 t + 1 is the
/// triangle turned over. A relation that contradicts earlier ones is ignored: a surface may have only one side.
void joinWound(std::vector<std::uint32_t>& parents, std::uint32_t a, std::uint32_t b, bool alike) {
    const std::uint32_t same = 2 * b + (alike ? 0 : 1), opposite = same ^ 1U;
    if (rootOf(parents.data(), 2 * a) == rootOf(parents.data(), opposite)) return;
    joinSets(parents.data(), 2 * a, same);
    joinSets(parents.data(), 2 * a + 1, opposite);
}

/// Returns the number of triangles with the minority winding of their component.
std::uint64_t countTurned(std::vector<std::uint32_t>& parents) {
    std::vector<std::uint32_t> counts(parents.size());
    for (std::uint32_t member = 0; member < parents.size(); member += 2) ++counts[rootOf(parents.data(), member)];
    // The lowest triangle t of a component is a root, and so is its turned copy.
    std::uint64_t turned = 0;
    for (std::uint32_t member = 0; member < parents.size(); member += 2) {
        if (parents[member] == member) turned += std::min(counts[member], counts[member + 1]);
    }
    return turned;
}

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

    /// Adds the quad of two triangles that share an edge, if it is flat. Others are rejected: the two pairs of faces of
    /// a tetrahedron also share four points, but are no two-sided sheet. `from` and `back`: the corners at which the
    /// edge starts in each triangle; `from` is the one of its lower point.
    void addQuad(std::uint32_t from, std::uint32_t back) {
        constexpr double kFlat = 1e-6;
        if (isCollapsed(from / 3) || isCollapsed(back / 3)) return;
        const std::uint32_t c = across(from), d = across(back), first = from / 3 * 3;
        const auto edge = [&](std::uint32_t corner) {
            return toDouble(positions_[corners_[corner]]) - toDouble(positions_[corners_[first]]);
        };
        const DVec3 normal = cross(edge(first + 1), edge(first + 2)), e = edge(d);
        if (std::fabs(dot(normal, e)) > kFlat * length(normal) * length(e)) return;
        quads_.push_back({{points_[from], points_[d], points_[back], points_[c]}, {from / 3, back / 3}});
    }

    [[nodiscard]] std::uint64_t count() {
        std::vector<bool> marked(corners_.size() / 3, false);
        std::vector<Side<3>> triangles;
        for (std::uint32_t t = 0; t < marked.size(); ++t) {
            if (!isCollapsed(t)) triangles.push_back({{at(t, 0), at(t, 1), at(t, 2)}, {t, t}});
        }
        markTwoSided(triangles, marked);
        markTwoSided(quads_, marked);
        return static_cast<std::uint64_t>(std::count(marked.begin(), marked.end(), true));
    }

  private:
    [[nodiscard]] std::uint32_t at(std::uint32_t triangle, std::size_t k) const {
        return points_[3 * std::size_t{triangle} + k];
    }
    /// Returns the corner opposite to the edge that starts at a corner.
    static std::uint32_t across(std::uint32_t corner) { return corner / 3 * 3 + (corner + 2) % 3; }
    [[nodiscard]] bool isCollapsed(std::uint32_t t) const {
        return at(t, 0) == at(t, 1) || at(t, 1) == at(t, 2) || at(t, 2) == at(t, 0);
    }

    StridedSpan<const Vec3> positions_;
    std::span<const std::uint32_t> corners_, points_;
    std::vector<Side<4>> quads_ = {};
};

/// Counts winding faults. `corners`: three per triangle. Positions are compared exactly, but -0 equals 0. O(n log n);
/// 150 bytes per triangle and 24 per vertex temporarily.
WindingCounts countWinding(const StridedSpan<const Vec3>& positions, std::span<const std::uint32_t> corners) {
    UniqueIndex<std::array<std::uint32_t, 3>> places(positions.count);
    std::vector<std::uint32_t> points(corners.size());
    for (std::size_t c = 0; c < corners.size(); ++c) points[c] = places.indexOf(positionKey(positions[corners[c]]));
    const auto forHalves = [&](const auto& add) {
        for (std::uint32_t c = 0; c < points.size(); ++c) {
            const std::uint32_t a = points[c], b = points[c % 3 == 2 ? c - 2 : c + 1];
            if (a != b) add(std::min(a, b), std::max(a, b), c);
        }
    };
    std::vector<std::uint32_t> parents(corners.size() / 3 * 2);
    std::iota(parents.begin(), parents.end(), 0U);
    Sheets sheets(positions, corners, points);
    forEachEdge(places.size(), nullptr, forHalves,
                [&](std::uint32_t low, std::uint32_t, std::span<const HalfEdge> halves) {
                    if (halves.size() != 2) return;
                    const std::uint32_t first = cornerOf(halves[0]), second = cornerOf(halves[1]);
                    const bool is_forward = points[first] == low, alike = is_forward != (points[second] == low);
                    joinWound(parents, first / 3, second / 3, alike);
                    if (alike) sheets.addQuad(is_forward ? first : second, is_forward ? second : first);
                });
    return {countTurned(parents), sheets.count()};
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
