// SPDX-License-Identifier: MIT
// An orthonormal basis around a unit vector in double precision.
// Based on: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
#pragma once

#include "core/vec_math.h"

namespace tspace {

/// Two axes that make a right-handed orthonormal basis (x, y, n). Exact when n lies along an axis.
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
