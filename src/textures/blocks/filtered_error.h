// SPDX-License-Identifier: MIT
// Error of a compressed normal map relative to its source, both bilinearly filtered.
#pragma once

#include <span>

#include "textures/blocks/normal_levels.h"

namespace tspace {

/// Error angles of a texture, in degrees.
struct FilteredError {
    double mean_deg = 0, p99_deg = 0, max_deg = 0;
    double max_x = 0, max_y = 0;  ///< position of the maximum, in texels; texel centers are at halves
};

/// Compares the shading normals at 3 x 3 points per texel (in a subset of the rows for more than 4 million texels).
/// `truth` and `texels` are filtered and normalized. With `makes_z`, only x and y of `texels` are filtered, and z is
/// computed from them. The map repeats. The result does not depend on the number of threads.
FilteredError measureFiltered(const NormalLevel& truth, std::span<const Vec3> texels, bool makes_z, Parallel& parallel);

}  // namespace tspace
