// SPDX-License-Identifier: MIT
// Positions that were rounded to decimals, or to fractions of a box, and stored as floats: the step is found in them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "tspace/span.h"
#include "tspace/vec.h"

namespace tspace {

/// The step that all values of an axis are whole multiples of, from one of them on, but for the rounding of floats; 0 where
/// there is none, or it is next to that rounding. `axis`: 0 to 2. Linear.
double latticeStep(StridedSpan<const Vec3> positions, std::size_t axis);

/// Whether triangles lie as rounding leaves them: where steps can turn dP/du by over 10 degrees, it differs between
/// neighbours by about as much, in direction and in length. Models that were built on a grid have steps too, and UVs that go
/// with them, and so does terrain along the axes of its raster: `may_be_raster` says along which all edges are as long.
/// `error`: as in PositionRounding. False where too few triangles say anything. O(n log n).
bool scattersByRounding(StridedSpan<const Vec3> positions, StridedSpan<const Vec2> uvs,
                        std::span<const std::span<const std::uint32_t>> corner_lists, double error,
                        const std::array<bool, 3>& may_be_raster);

}  // namespace tspace
