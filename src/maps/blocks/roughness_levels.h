// SPDX-License-Identifier: MIT
// Smaller levels of a roughness texture, with what the normals of each texel spread.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "maps/blocks/normal_levels.h"

namespace tspace {

/// Occlusion, roughness and metalness, from 0 to 1.
struct RoughnessLevel {
    std::uint32_t width = 0, height = 0;
    std::vector<Vec3> texels = {};
};

/// Empty, or why the grids of a normal map and a roughness texture do not fit: half a sentence. They do where they are equal, or one is
/// a power of two larger along both sides.
std::string whyGridsDiffer(const RoughnessLevel& roughness, std::uint32_t width, std::uint32_t height);

/// All levels down to 1 x 1. Channels are means, weighted by the coverage of the normals where they have one; green, the roughness r, is (mean(r)^4 + spread)^(1/4), 1 at most: a microfacet lobe
/// (Beckmann) whose slopes have the variance r^4 / 2 along each axis, folded with the normals of that level of the normal map which a
/// pixel reads at the same time. `factor` is multiplied into green before. `normals`: all levels, with spreads; whyGridsDiffer must be empty.
std::vector<RoughnessLevel> makeRoughnessLevels(const RoughnessLevel& first, float factor,
                                                std::span<const NormalLevel> normals, Parallel& parallel);

}  // namespace tspace
