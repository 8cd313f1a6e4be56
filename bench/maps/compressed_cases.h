// SPDX-License-Identifier: MIT
// Normal maps of the kinds that games have, from formulas and seeds: what formats and levels are measured on.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "maps/blocks/normal_levels.h"

namespace tspace::bench {

struct CompressedCase {
    std::string name = {};
    NormalLevel level = {};
};

/// smooth: a bake of a smooth low poly, with kinks at its edges, 15 degrees at most. relief: bricks, bevels and domes, up to 67. leather: cells of 4
/// to 8 texels, 18 in the mean. hard: flats tilted by up to 40, edges of one texel. scratch: grooves of 1 to 3 texels. All repeat.
/// `size`: a multiple of 64.
std::vector<CompressedCase> compressedCases(std::uint32_t size, std::uint32_t seed);

}  // namespace tspace::bench
