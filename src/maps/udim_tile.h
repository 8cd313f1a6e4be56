// SPDX-License-Identifier: MIT
// UDIM: UV maps whose unit squares have an image each, ten in a row, 1001 and on.
#pragma once

#include <cstdint>

#include "tspace/vec.h"

namespace tspace {

/// The tile of a triangle's middle, by the UVs of its three corners; 0: none (not finite, or outside of tiles 1001 to 9990).
inline std::uint32_t tileOf(const Vec2* uvs) {
    const double u = (static_cast<double>(uvs[0].x) + uvs[1].x + uvs[2].x) / 3;
    // Tiles go upwards, and v runs down.
    const double v = 1 - (static_cast<double>(uvs[0].y) + uvs[1].y + uvs[2].y) / 3;
    if (!(u >= 0 && u < 10 && v >= 0 && v < 899)) return 0;
    return 1001 + static_cast<std::uint32_t>(u) + 10 * static_cast<std::uint32_t>(v);
}

}  // namespace tspace
