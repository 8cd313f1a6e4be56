// SPDX-License-Identifier: MIT
// What smaller levels of a baked map are off by, where an engine makes them of its texels as stored.
#pragma once

#include <array>

#include "tspace/maps.h"

namespace tspace::bench {

inline constexpr unsigned kLevels = 4;  ///< blocks of 2 x 2 to 16 x 16 texels

/// For each level the mean angle, in degrees, between the mean of a block of texels and the mean of the unit normals that a finer map of
/// the same surface has there; blocks with background in either map are left out. `fine`: of a width that is a multiple.
std::array<double, kLevels> levelErrors(const BakedMap& map, const BakedMap& fine);

}  // namespace tspace::bench
