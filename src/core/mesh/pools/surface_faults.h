// SPDX-License-Identifier: MIT
// Faults of the triangles that frames were made on, counted for a report.
#pragma once

#include <cstdint>
#include <span>

#include "tspace/asset.h"
#include "tspace/vec.h"

namespace tspace {

/// Fills normals_behind_count, and with `counts_winding` turned_triangle_count and two_sided_triangle_count.
/// `normals`: those that were made, one per vertex, or empty. `corners`: three per triangle.
void countFaults(std::span<const Vec3> positions, std::span<const Vec3> normals, std::span<const std::uint32_t> corners,
                 bool counts_winding, PrimitiveReport& report);

}  // namespace tspace
