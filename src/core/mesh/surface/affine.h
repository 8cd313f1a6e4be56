// SPDX-License-Identifier: MIT
// Places in space: rotation, scale, shear and offset, in double.
#pragma once

#include "core/base/vec_math.h"

namespace tspace {

/// x, y and z are where the axes go, origin where (0, 0, 0) goes.
struct Affine {
    DVec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{};

    [[nodiscard]] DVec3 direction(const DVec3& d) const { return d.x * x + d.y * y + d.z * z; }
    [[nodiscard]] DVec3 point(const DVec3& p) const { return direction(p) + origin; }
    [[nodiscard]] double determinant() const { return dot(x, cross(y, z)); }
    /// Maps a normal: it stays perpendicular to surfaces and on their outside, for any matrix. The length has no
    /// meaning.
    [[nodiscard]] DVec3 normal(const DVec3& n) const {
        const DVec3 turned = n.x * cross(y, z) + n.y * cross(z, x) + n.z * cross(x, y);
        return determinant() < 0 ? -1.0 * turned : turned;
    }
};

/// First `inner`, then `outer`.
inline Affine compose(const Affine& outer, const Affine& inner) {
    return {outer.direction(inner.x), outer.direction(inner.y), outer.direction(inner.z), outer.point(inner.origin)};
}

/// A vector that a place turned, as long as it was before; that one where it has no direction any more.
inline Vec3 turnedVector(const Vec3& before, DVec3 after) {
    const double size = length(toDouble(before));
    return normalize(after) ? toFloat(size * after) : before;
}

inline Vec3 normalAt(const Affine& place, const Vec3& normal) {
    return turnedVector(normal, place.normal(toDouble(normal)));
}

/// Its bitangent goes with the surface, also where the place mirrors it.
inline Vec4 tangentAt(const Affine& place, const Vec4& tangent) {
    const Vec3 direction = turnedVector(xyz(tangent), place.direction(toDouble(xyz(tangent))));
    return {direction.x, direction.y, direction.z, place.determinant() < 0 ? -tangent.w : tangent.w};
}

}  // namespace tspace
