// SPDX-License-Identifier: MIT
// How far stored positions are from those that were meant: floats far from the origin have coarse steps, and positions may
// have been rounded to decimals before.
#pragma once

#include <cstdint>
#include <span>

#include "tspace/span.h"
#include "tspace/vec.h"

namespace tspace {

struct PositionRounding {
    double step = 0;          ///< between neighbouring numbers, along the coarsest axis; 0: nothing to speak of
    double error = 0;         ///< the farthest that a position can be from the one that was rounded to it
    double far = 0;           ///< the largest coordinate
    bool was_before = false;  ///< they had been rounded before they were stored as floats
};

/// `stored_step`: of a format with whole numbers, in units of the positions; 0 for floats. Their steps are those of the
/// largest coordinates, or coarser where all positions lie on multiples; none along axes of a raster. Near the origin
/// positions that lie on multiples were rounded only where the UVs say so (empty: nothing does). `corner_lists`: three
/// per triangle, for each mesh over these positions. Nothing where the mesh is 2^16 steps wide or more.
PositionRounding roundingOf(StridedSpan<const Vec3> positions, StridedSpan<const Vec2> uvs,
                            std::span<const std::span<const std::uint32_t>> corner_lists, double stored_step = 0);

/// Triangles that rounding turns.
struct TurnedTriangles {
    std::uint64_t count = 0, total = 0;
    double share = 0;  ///< of the surface: those that are turned by more than the limit
    double worst_deg = 0;
    std::uint32_t first = 0;  ///< a corner of the first
};
/// By how much rounding turns the plane of each triangle, in the mean square. Linear.
TurnedTriangles turnedBy(const PositionRounding& rounding, StridedSpan<const Vec3> positions,
                         std::span<const std::uint32_t> corners, double limit_deg);

/// From this share of the surface on it is more than a few slivers.
inline constexpr double kSomeTurned = 0.01;

}  // namespace tspace
