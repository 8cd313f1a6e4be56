// SPDX-License-Identifier: MIT
// Computes statistics of the UV map of a triangle mesh that matter before tangents are computed.
#pragma once

#include <cstdint>
#include <span>

#include "tspace/inspect.h"
#include "tspace/span.h"

namespace tspace {

/// Fills the degenerate, mirrored and island counts of `info`. `corners`: three vertices per triangle, each less than
/// positions.size(). `uvs`: one per vertex, or empty, in which case only degenerate_triangle_count is filled.
/// `v_runs_down`: v = 0 is the top row of the image (glTF), so unmirrored triangles have negative area in (u, v). Two
/// triangles belong to one island if they share an edge whose ends have equal positions and UVs, regardless of indices.
/// An island is mirrored if the sum of its signed areas is negative with v pointing up. Expected linear time; about 60
/// bytes per corner.
void describeUvMap(std::span<const std::uint32_t> corners, std::span<const Vec3> positions, std::span<const Vec2> uvs,
                   bool v_runs_down, PrimitiveInfo& info);

}  // namespace tspace
