// SPDX-License-Identifier: MIT
// Compresses normal maps to blocks of two channels (BC5, EAC RG11): x and y. Readers compute z after filtering.
#pragma once

#include <cstdint>
#include <vector>

#include "textures/blocks/normal_levels.h"
#include "tspace/map_files.h"

namespace tspace {

struct BlockOptions {
    TextureFormat format = TextureFormat::bc5;  ///< bc5 or eacRg11
    bool is_signed = false;
    TextureQuality quality = TextureQuality::fast;
};

struct FittedLevel {
    std::vector<std::uint8_t> blocks = {};  ///< blocks of 16 bytes each, row by row
    std::vector<Vec2> texels = {};          ///< x and y of each texel, as decoded
};

/// Fits blocks to a level. The map repeats. Errors are approximately squared angles: x and y are weighted by the
/// derivative of the direction that is reconstructed from them (at z of at least 0.2), at points between the texels,
/// where both the map and the texture are filtered. Linear time. Memory: 48 bytes per texel. The result is identical
/// for any number of threads and on any CPU.
FittedLevel fitBlocks(const NormalLevel& level, const BlockOptions& options, Parallel& parallel);

/// Returns the x and y with the least error of the filtered map, as input for other encoders. Texels that would move
/// only slightly are kept. Values may slightly exceed the range -1 to 1.
std::vector<Vec2> fitTexels(const NormalLevel& level, Parallel& parallel);

}  // namespace tspace
