// SPDX-License-Identifier: MIT
// Mip levels of a roughness texture that include the spread of the normals in each texel.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "textures/blocks/normal_levels.h"

namespace tspace {

/// Level of a texture with occlusion, roughness and metalness in the range 0 to 1.
struct RoughnessLevel {
    std::uint32_t width = 0, height = 0;
    std::vector<Vec3> texels = {};
};

/// Returns the reason why the sizes of a normal map and a roughness texture do not match, as a sentence fragment; an
/// empty string if they match: they must be equal, or one must be larger by the same power of two along both sides.
std::string whyGridsDiffer(const RoughnessLevel& roughness, std::uint32_t width, std::uint32_t height);

/// Returns all levels down to 1 x 1. Channels are means, weighted by the coverage of the normals if there is any.
/// Green, the roughness r, becomes (mean(r)^4 + spread)^(1/4), at most 1. This convolves a Beckmann microfacet lobe,
/// whose slopes have the variance r^4 / 2 along each axis, with the normals in the level of the normal map that a pixel
/// samples at the same time. Green is multiplied by `factor` first. `normals`: all levels, with spreads; whyGridsDiffer
/// must return an empty string.
std::vector<RoughnessLevel> makeRoughnessLevels(const RoughnessLevel& first, float factor,
                                                std::span<const NormalLevel> normals, Parallel& parallel);

}  // namespace tspace
