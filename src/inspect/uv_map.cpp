// SPDX-License-Identifier: MIT
// UV islands by union-find over welded edges, and the orientation of each.
#include "inspect/uv_map.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "core/unique_index.h"

namespace tspace {
namespace {

/// Per vertex the number of its position together with its UV.
std::vector<std::uint32_t> weldVertices(std::span<const Vec3> positions, std::span<const Vec2> uvs) {
    UniqueIndex<std::array<std::uint32_t, 5>> points(positions.size());
    std::vector<std::uint32_t> welded(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        welded[i] = points.indexOf({weldBits(positions[i].x), weldBits(positions[i].y), weldBits(positions[i].z),
                                    weldBits(uvs[i].x), weldBits(uvs[i].y)});
    }
    return welded;
}

/// Sets of triangles, merged by size with path halving: near-linear, and no recursion.
class TriangleSets {
  public:
    explicit TriangleSets(std::size_t count) : parent_(count), size_(count, 1) {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }
    std::uint32_t find(std::uint32_t triangle) {
        while (parent_[triangle] != triangle) {
            parent_[triangle] = parent_[parent_[triangle]];
            triangle = parent_[triangle];
        }
        return triangle;
    }
    void merge(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        if (a == b) return;
        if (size_[a] < size_[b]) std::swap(a, b);
        parent_[b] = a;
        size_[a] += size_[b];
    }

  private:
    std::vector<std::uint32_t> parent_;
    std::vector<std::uint32_t> size_;
};

/// Twice the signed area with v upwards. Double, so that no finite float UVs overflow and float differences
/// are exact.
double signedArea(const Vec2& a, const Vec2& b, const Vec2& c, bool v_runs_down) {
    const double s1 = static_cast<double>(b.x) - a.x;
    const double t1 = static_cast<double>(b.y) - a.y;
    const double s2 = static_cast<double>(c.x) - a.x;
    const double t2 = static_cast<double>(c.y) - a.y;
    const double area = s1 * t2 - s2 * t1;
    return v_runs_down ? -area : area;
}

TriangleSets joinIslands(std::span<const std::uint32_t> corners, const std::vector<std::uint32_t>& welded) {
    TriangleSets islands(corners.size() / 3);
    UniqueIndex<std::array<std::uint32_t, 2>> edges(corners.size());
    std::vector<std::uint32_t> first_triangle;
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
        const auto triangle = static_cast<std::uint32_t>(corner / 3);
        const std::size_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
        const auto [low, high] = std::minmax(welded[corners[corner]], welded[corners[next]]);
        const std::uint32_t edge = edges.indexOf({low, high});
        if (edge == first_triangle.size()) {
            first_triangle.push_back(triangle);
        } else {
            islands.merge(first_triangle[edge], triangle);
        }
    }
    return islands;
}

}  // namespace

void describeUvMap(std::span<const std::uint32_t> corners, std::span<const Vec3> positions, std::span<const Vec2> uvs,
                   bool v_runs_down, PrimitiveInfo& info) {
    const std::size_t triangle_count = corners.size() / 3;
    for (std::size_t i = 0; i < triangle_count; ++i) {
        const Vec3& a = positions[corners[3 * i]];
        const Vec3& b = positions[corners[3 * i + 1]];
        const Vec3& c = positions[corners[3 * i + 2]];
        info.degenerate_triangle_count += a == b || b == c || c == a;
    }
    if (uvs.empty()) return;

    TriangleSets islands = joinIslands(corners, weldVertices(positions, uvs));
    std::vector<double> island_area(triangle_count, 0.0);
    for (std::size_t i = 0; i < triangle_count; ++i) {
        const std::uint32_t island = islands.find(static_cast<std::uint32_t>(i));
        info.uv_island_count += island == i;
        const double area =
            signedArea(uvs[corners[3 * i]], uvs[corners[3 * i + 1]], uvs[corners[3 * i + 2]], v_runs_down);
        // Also NaN and infinity count as "no area": no direction can be had from them.
        if (!(area < 0 || area > 0) || area - area != 0) {
            ++info.degenerate_uv_count;
            continue;
        }
        info.mirrored_triangle_count += area < 0;
        island_area[island] += area;
    }
    for (const double area : island_area) info.mirrored_island_count += area < 0;
}

}  // namespace tspace
