// SPDX-License-Identifier: MIT
// Normal maps as blocks of two channels (BC5, EAC RG11): x and y, and z is made by who reads them, after the filter.
#pragma once

#include <cstdint>
#include <vector>

#include "maps/blocks/normal_levels.h"

namespace tspace {

enum class BlockFormat : std::uint8_t { bc5, eacRg11 };

enum class BlockQuality : std::uint8_t {
    quick,  ///< each channel of a block by itself: least squares of its texels
    fast,   ///< the least error as it is filtered, one round
    best    ///< like `fast`, with three rounds and more palettes
};

struct BlockOptions {
    BlockFormat format = BlockFormat::bc5;
    bool is_signed = false;
    BlockQuality quality = BlockQuality::fast;
};

struct FittedLevel {
    std::vector<std::uint8_t> blocks = {};  ///< 16 bytes each, row by row
    std::vector<Vec2> texels = {};          ///< x and y as they are decoded
};

/// The map repeats. Errors are squares of angles, nearly: x and y count as the direction that is made of them changes (the first
/// derivative, at z of 0.2 at least), at points between the texels, where both the map and the texture are filtered. Time: linear.
/// Memory: 48 bytes a texel. The same bytes for any number of threads, and on any CPU.
FittedLevel fitBlocks(const NormalLevel& level, const BlockOptions& options, Parallel& parallel);

/// x and y for which the map is nearest as it is filtered, for packers of others: where that moves them by little, they stay. They may be a
/// little beyond -1 to 1.
std::vector<Vec2> fitTexels(const NormalLevel& level, Parallel& parallel);

}  // namespace tspace
