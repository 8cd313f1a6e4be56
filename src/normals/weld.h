// SPDX-License-Identifier: MIT
// Vertices at the same position are one point.
#pragma once

#include <cstdint>

#include "core/memory.h"
#include "core/parallel.h"
#include "tspace/span.h"

namespace tspace {

/// For each vertex the lowest vertex at the same position. Coordinates are compared exactly, but -0 equals 0;
/// a position with a NaN equals no other. O(n) for any ordinary input, O(n log n) for one made to defeat the
/// hash.
Buffer<std::uint32_t> weldPositions(StridedSpan<const Vec3> positions, const Allocator* allocator,
                                    Parallel& parallel);

}  // namespace tspace
