// SPDX-License-Identifier: MIT
// The connected pieces of a UV map.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tspace/vec.h"

namespace tspace {

struct UvIslands {
    std::vector<std::uint32_t> island_of = {};  ///< one per triangle
    std::uint32_t count = 0;                    ///< numbered in order of their first triangles
};

/// Two triangles belong to one island when they share an edge whose ends are equal in position and in UV, however the
/// vertices are indexed. `corners`: three per triangle, each smaller than positions.size() and uvs.size(). Expected linear
/// time; about 60 bytes per corner.
UvIslands findUvIslands(std::span<const std::uint32_t> corners, std::span<const Vec3> positions,
                        std::span<const Vec2> uvs);

/// Twice the signed area with v upwards. Double, so that no finite float UVs overflow and float differences are exact.
double signedUvArea(const Vec2& a, const Vec2& b, const Vec2& c, bool v_runs_down);

}  // namespace tspace
