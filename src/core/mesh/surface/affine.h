// SPDX-License-Identifier: MIT
// Affine transforms: rotation, scale, shear and offset, in double precision.
#pragma once

#include "core/base/vec_math.h"

namespace tspace {

/// Affine transform: x, y and z are the images of the axes, origin is the image of (0, 0, 0).
struct Affine {
    DVec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{};

    [[nodiscard]] DVec3 direction(const DVec3& d) const { return d.x * x + d.y * y + d.z * z; }
    [[nodiscard]] DVec3 point(const DVec3& p) const { return direction(p) + origin; }
    [[nodiscard]] double determinant() const { return dot(x, cross(y, z)); }
    /// Transforms a normal: it stays perpendicular to surfaces and on their outside, for any matrix. The length is
    /// arbitrary.
    [[nodiscard]] DVec3 normal(const DVec3& n) const {
        const DVec3 turned = n.x * cross(y, z) + n.y * cross(z, x) + n.z * cross(x, y);
        return determinant() < 0 ? -1.0 * turned : turned;
    }
};

/// Returns the transform that applies `inner`, then `outer`.
inline Affine compose(const Affine& outer, const Affine& inner) {
    return {outer.direction(inner.x), outer.direction(inner.y), outer.direction(inner.z), outer.point(inner.origin)};
}

/// Returns a transformed vector with its original length; the original vector if the result has no direction.
inline Vec3 rotatedVector(const Vec3& before, DVec3 after) {
    const double size = length(toDouble(before));
    return normalize(after) ? toFloat(size * after) : before;
}

inline Vec3 normalAt(const Affine& place, const Vec3& normal) {
    return rotatedVector(normal, place.normal(toDouble(normal)));
}

/// Transforms a tangent. Its sign changes under a mirroring transform, so that the bitangent follows the surface.
inline Vec4 tangentAt(const Affine& place, const Vec4& tangent) {
    const Vec3 direction = rotatedVector(xyz(tangent), place.direction(toDouble(xyz(tangent))));
    return {direction.x, direction.y, direction.z, place.determinant() < 0 ? -tangent.w : tangent.w};
}

}  // namespace tspace
