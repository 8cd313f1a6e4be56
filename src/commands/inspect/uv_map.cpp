// SPDX-License-Identifier: MIT
// UV islands, and the orientation of each.
#include "commands/inspect/uv_map.h"

#include <vector>

#include "core/mesh/surface/uvs.h"

namespace tspace {

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

    const UvIslands islands = findUvIslands(corners, positions, uvs);
    info.uv_island_count = islands.count;
    std::vector<double> island_area(islands.count, 0.0);
    for (std::size_t i = 0; i < triangle_count; ++i) {
        const double area =
            signedUvArea(uvs[corners[3 * i]], uvs[corners[3 * i + 1]], uvs[corners[3 * i + 2]], v_runs_down);
        // NaN and infinity count as "no area" too, since they give no direction.
        if (!(area < 0 || area > 0) || area - area != 0) {
            ++info.degenerate_uv_count;
            continue;
        }
        info.mirrored_triangle_count += area < 0;
        island_area[islands.island_of[i]] += area;
    }
    for (const double area : island_area) info.mirrored_island_count += area < 0;
}

}  // namespace tspace
