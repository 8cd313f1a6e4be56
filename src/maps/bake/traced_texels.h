// SPDX-License-Identifier: MIT
// Results of the rays for the texels of a map.
#pragma once

#include <cstdint>

#include "core/base/memory.h"
#include "tspace/maps.h"
#include "tspace/span.h"

namespace tspace {

/// Ray results per texel. All vectors are unit length, relative to T, B and N or in object space.
struct TracedTexels {
    Buffer<Vec3> wanted = {};  ///< at the center; the mean if several triangles cover it. Zero: unknown
    Buffer<TexelOrigin> origins = {};
    /// Number of texels whose triangles want vectors that differ by more than 2 degrees, with the sum and the maximum
    /// of these angles.
    std::uint64_t conflict_count = 0;
    double conflict_sum_deg = 0, conflict_max_deg = 0;
    Buffer<std::uint32_t> ranks = {};  ///< result of ranksOfPieces; empty: all triangles of a texel contribute
    /// with ranks: per texel, the smallest rank of the triangles that cover its center
    Buffer<std::uint32_t> owners = {};
};

}  // namespace tspace
