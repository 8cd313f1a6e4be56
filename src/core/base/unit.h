// SPDX-License-Identifier: MIT
// Which vectors have a direction, scaling to length 1 that no finite vector defeats, and a basis around a unit vector.
#pragma once

#include <algorithm>

#include "core/base/vec_math.h"

namespace tspace {

inline bool isZero(const Vec3& v) { return v.x == 0 && v.y == 0 && v.z == 0; }
inline bool isDirection(const Vec3& v) { return isFinite(v) && !isZero(v); }

/// Scales v to length 1; false, and v unchanged, when it is zero or not finite. The largest component is
/// brought to 1 first: squares of small products of floats would vanish even in double.
inline bool normalize(DVec3& v) {
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) return false;
    const double largest = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
    if (largest == 0) return false;
    const DVec3 scaled{v.x / largest, v.y / largest, v.z / largest};
    v = (1 / length(scaled)) * scaled;
    return true;
}

/// Two axes that make a right-handed orthonormal basis (x, y, n) with a unit vector. Exact when n lies along an axis.
/// Based on: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
struct PlaneAxes {
    DVec3 x, y;
};

inline PlaneAxes planeAxes(const DVec3& n) {
    const double s = n.z < 0 ? -1.0 : 1.0;  // -0 as +0, so that equal normals have equal bases
    const double a = -1 / (s + n.z);
    const double b = n.x * n.y * a;
    return {{1 + s * n.x * n.x * a, s * b, -s * n.x}, {b, s + n.y * n.y * a, -n.y}};
}

}  // namespace tspace
