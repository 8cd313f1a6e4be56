// SPDX-License-Identifier: MIT
// Encodes vectors of given directions and lengths as 8-bit integers, such that neighboring texels compensate for
// rounding errors under filtering.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "maps/solve/solve_texels.h"
#include "tspace/maps.h"

namespace tspace {

/// Returns the parameters for choosing 8-bit integers for three channels with the requested lengths.
IntegerChoice integerChoice(TexelLengths lengths);

struct VectorMap {
    /// Vectors as stored: 2 c - 1 for channel values c. A zero vector is unknown, and stays unchanged.
    std::span<Vec3> vectors = {};
    std::span<const bool> keeps = {};  ///< flags of vectors that are already integers and must not change
    std::uint32_t width = 0;
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
    float scale = 1;  ///< factor by which readers multiply x and y
};

/// Quantizes vectors to integers such that the filtered map keeps its directions. Lengths within the requested range
/// may change. Vectors whose length is outside it, and vectors next to one that differs by more than 9 degrees, keep
/// their length within 5 %. Memory: 150 bytes per texel, for 130 rows at a time. The result does not depend on the
/// number of threads.
void chooseLengths(const VectorMap& map, TexelLengths lengths, Parallel& parallel, const Allocator* allocator);

}  // namespace tspace
