// SPDX-License-Identifier: MIT
// Errors of smaller mip levels of a baked map that an engine computes from its stored texels.
#pragma once

#include <array>

#include "tspace/maps.h"

namespace tspace::bench {

inline constexpr unsigned kLevels = 4;  ///< blocks of 2 x 2 to 16 x 16 texels

/// Returns, for each level, the mean angle in degrees between the mean of a block of texels and the mean of the unit
/// normals of a finer map of the same surface; blocks with background in either map are excluded. `fine`: its width
/// must be a multiple.
std::array<double, kLevels> levelErrors(const BakedMap& map, const BakedMap& fine);

}  // namespace tspace::bench
