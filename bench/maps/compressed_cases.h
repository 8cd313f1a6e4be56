// SPDX-License-Identifier: MIT
// Normal maps typical of games, from formulas and seeds, for measuring formats and levels.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "textures/blocks/normal_levels.h"

namespace tspace::bench {

struct CompressedCase {
    std::string name = {};
    NormalLevel level = {};
};

/// smooth: a bake of a smooth low poly, with kinks at its edges, up to 15 degrees. relief: bricks, bevels and domes, up
/// to 67 degrees. leather: cells of 4 to 8 texels, 18 degrees in the mean. hard: flats tilted by up to 40 degrees,
/// edges of one texel. scratch: grooves of 1 to 3 texels. All are periodic. `size`: a multiple of 64.
std::vector<CompressedCase> compressedCases(std::uint32_t size, std::uint32_t seed);

}  // namespace tspace::bench
