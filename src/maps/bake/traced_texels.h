// SPDX-License-Identifier: MIT
// The results of rays for the texels of a map.
#pragma once

#include <cstdint>

#include "core/base/memory.h"
#include "tspace/maps.h"
#include "tspace/span.h"

namespace tspace {

/// The results of rays for texels. All vectors are unit, along T, B and N, or of the object.
struct TracedTexels {
    Buffer<Vec3> wanted = {};  ///< at the centre; the mean where several triangles show it. Zero: not known
    Buffer<TexelOrigin> origins = {};
    /// Texels whose triangles want over 2 degrees different vectors; the sum and the largest of these angles.
    std::uint64_t conflict_count = 0;
    double conflict_sum_deg = 0, conflict_max_deg = 0;
    Buffer<std::uint32_t> ranks = {};   ///< ranksOfPieces; empty: all triangles of a texel count
    Buffer<std::uint32_t> owners = {};  ///< with ranks, of each texel: the smallest one of those that show its centre
};

}  // namespace tspace
