// SPDX-License-Identifier: MIT
// Vectors of given directions and lengths as integers of 8 bits, such that neighbours make good under the filter what is rounded off.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "maps/solve/solve_texels.h"
#include "tspace/maps.h"

namespace tspace {

/// Integers of 8 bits for three channels, whose lengths are as asked.
IntegerChoice integerChoice(TexelLengths lengths);

struct VectorMap {
    std::span<Vec3> vectors = {};      ///< vectors as stored: 2 c - 1 for channels c. Zero: unknown, and unchanged
    std::span<const bool> keeps = {};  ///< vectors that are such integers and stay
    std::uint32_t width = 0;
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
    float scale = 1;  ///< readers multiply x and y by it
};

/// Makes of vectors ones that integers stand for: those by which the filtered map points where it did. One whose length is not
/// of the asked ones keeps it, within a twentieth; and so do those beside vectors over 9 degrees away.
/// Memory: 150 bytes a texel, of 130 rows at a time. The same bits for any number of threads.
void chooseLengths(const VectorMap& map, TexelLengths lengths, Parallel& parallel, const Allocator* allocator);

}  // namespace tspace
