// SPDX-License-Identifier: MIT
// Results of the rays for the texels of a map.
#pragma once

#include <cstdint>

#include "core/base/memory.h"
#include "tspace/maps.h"
#include "tspace/span.h"

namespace tspace {

/// Ray results per texel. All vectors have unit length, and are relative to T, B and N or in object space.
struct TracedTexels {
    /// target vector at the center of each texel; the mean if several triangles cover it; zero: unknown
    Buffer<Vec3> wanted = {};
    Buffer<TexelOrigin> origins = {};
    /// Number of texels whose triangles require vectors that differ by more than 2 degrees, with the sum and the
    /// maximum of these angles.
    std::uint64_t conflict_count = 0;
    double conflict_sum_deg = 0, conflict_max_deg = 0;
    /// priority of each triangle (ranksOfPieces); empty: all triangles of a texel contribute
    Buffer<std::uint32_t> ranks = {};
    /// For each texel, the smallest rank of the triangles that cover its center; only if `ranks` is not empty.
    Buffer<std::uint32_t> owners = {};
};

}  // namespace tspace
