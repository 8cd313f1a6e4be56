// SPDX-License-Identifier: MIT
// Pictures of a bake: what each texel is, and where the error is.
#pragma once

#include <vector>

#include "tspace/map_bake.h"

namespace tspace {

/// Red: nothing was met; yellow: several triangles; green: baked; dark green: padding; black: background.
std::vector<Vec3> pictureOfOrigins(const BakedMap& map);

/// From black (0) over blue, red and yellow to white (`top_deg` and more). Texels without triangles: dark grey.
std::vector<Vec3> pictureOfHeat(const std::vector<float>& heat, double top_deg);

}  // namespace tspace
