// SPDX-License-Identifier: MIT
// Normal maps in memory, and what calls on them have in common. CMake target tspace::maps.
#pragma once

#include <cstdint>
#include <span>

#include "tspace/texture_wrap.h"
#include "tspace/vec.h"

namespace tspace {

/// The space of the vectors of a map.
enum class MapSpace : std::uint32_t {
    tangent = 0,
    object = 1  ///< the coordinates of the meshes
};

/// An image of a normal map.
struct MapImage {
    std::uint32_t width = 0, height = 0;
    std::span<const Vec3> texels = {};  ///< width * height, channels from 0 to 1, row 0 is v = 0
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
};

}  // namespace tspace
