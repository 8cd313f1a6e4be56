// SPDX-License-Identifier: MIT
// How far a compressed normal map is from the map that it stands for, as both are filtered.
#pragma once

#include <span>

#include "maps/blocks/normal_levels.h"

namespace tspace {

/// In degrees.
struct FilteredError {
    double mean_deg = 0, p99_deg = 0, max_deg = 0;
    double max_x = 0, max_y = 0;  ///< position of the maximum, in texels; centers lie at halves
};

/// What a renderer shades at 3 x 3 points a texel (of some rows, where there are more than 4 million): of `truth` bilinear, then unit; of
/// `texels` the same, or, with `makes_z`, x and y bilinear and z made of them. The map repeats. The same for any number of threads.
FilteredError measureFiltered(const NormalLevel& truth, std::span<const Vec3> texels, bool makes_z, Parallel& parallel);

}  // namespace tspace
