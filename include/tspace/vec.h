// SPDX-License-Identifier: MIT
// Plain float tuples used at the border. They have no padding, so an array of Vec3 is an array of 3 floats
// per element and may be viewed as such.
#pragma once

namespace tspace {

struct Vec2 {
    float x = 0, y = 0;
    friend bool operator==(const Vec2&, const Vec2&) = default;
};

struct Vec3 {
    float x = 0, y = 0, z = 0;
    friend bool operator==(const Vec3&, const Vec3&) = default;
};

/// A tangent with its sign: x, y, z is the tangent, w the sign (+1 or -1).
struct Vec4 {
    float x = 0, y = 0, z = 0, w = 0;
    friend bool operator==(const Vec4&, const Vec4&) = default;
};

static_assert(sizeof(Vec2) == 8 && sizeof(Vec3) == 12 && sizeof(Vec4) == 16);

/// The first three components: the tangent without its sign.
inline Vec3 xyz(const Vec4& v) { return {v.x, v.y, v.z}; }

}  // namespace tspace
