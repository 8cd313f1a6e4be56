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

/// Returns periodic maps. smooth: a bake of a smooth low poly, with kinks of up to 15 degrees at its edges. relief:
/// bricks, bevels and domes with slopes up to 67 degrees. leather: cells of 4 to 8 texels with a mean slope of 18
/// degrees. hard: flat areas tilted by up to 40 degrees, with edges one texel wide. scratch: grooves 1 to 3 texels
/// wide. `size`: width and height, a multiple of 64.
std::vector<CompressedCase> compressedCases(std::uint32_t size, std::uint32_t seed);

}  // namespace tspace::bench
