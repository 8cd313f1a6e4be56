// SPDX-License-Identifier: MIT
// Errors of the mip levels that an engine computes from the stored texels of a baked map.
#pragma once

#include <array>

#include "tspace/maps.h"

namespace tspace::bench {

inline constexpr unsigned kLevels = 4;  ///< levels from blocks of 2 x 2 texels to blocks of 16 x 16 texels

/// Returns, for each level, the mean angle in degrees between the mean of a block of texels and the mean of the unit
/// normals of a finer map of the same surface. Blocks with background in either map are excluded. `fine`: the finer
/// map, whose width must be a multiple of the map's.
std::array<double, kLevels> levelErrors(const BakedMap& map, const BakedMap& fine);

}  // namespace tspace::bench
