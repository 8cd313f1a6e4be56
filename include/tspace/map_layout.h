// SPDX-License-Identifier: MIT
// Where an image keeps the vectors of a normal map, when that is not x, y and z in red, green and blue. CMake target tspace::maps.
#pragma once

#include <cstdint>

#include "tspace/vec.h"

namespace tspace {

/// A channel of an image.
enum class MapChannel : std::uint32_t {
    red = 0,
    green = 1,
    blue = 2,
    alpha = 3,
    none = 4  ///< of z only: it is the root of 1 - x^2 - y^2
};

/// The curve that was applied to the numbers of an image that was taken for a picture.
enum class MapCurve : std::uint32_t {
    none = 0,
    srgb = 1,       ///< the sRGB curve was put on: a flat texel is (188, 188, 255)
    linearised = 2  ///< it was taken off: a flat texel is (55, 55, 255)
};

struct MapComponent {
    MapChannel channel = MapChannel::red;
    bool is_inverted = false;  ///< it holds 1 - c

    friend bool operator==(const MapComponent&, const MapComponent&) = default;
};

/// The default is what glTF has.
struct MapLayout {
    MapComponent x{MapChannel::red}, y{MapChannel::green}, z{MapChannel::blue};
    MapCurve curve = MapCurve::none;  ///< of red, green and blue; alpha never has one

    friend bool operator==(const MapLayout&, const MapLayout&) = default;
};

/// The texel (x, y, z), each from 0 to 1 as in a normal map, of an image with that layout. Where z is to be made of x and y
/// and these are longer than 1, z is 0.5. Thread-safe.
Vec3 readTexel(const Vec3& rgb, float alpha, const MapLayout& layout);

}  // namespace tspace
