// SPDX-License-Identifier: MIT
// Angles in double precision without libm, whose last bits differ between platforms: only + - * / and sqrt.
#pragma once

#include "core/vec_math.h"

namespace tspace {

inline constexpr double kPi = 3.14159265358979323846;

/// The angle of the direction (x, y) against the x axis, for y >= 0: in [0, pi], as atan2(y, x). 0 for (0,
/// 0). Both finite and below 1e300. Absolute error below 1e-15 (tested against libm).
inline double polarAngle(double x, double y) {
    const double width = x < 0 ? -x : x;
    const double small = width < y ? width : y;
    const double large = width < y ? y : width;
    if (large == 0) return 0;

    // atan(s) = atan(c) + atan((s - c) / (1 + s c)), with c the quarter nearest to s, leaves |t| <= 1/8.
    constexpr double kAtanOfQuarters[5] = {0, 0.24497866312686414, 0.46364760900080615, 0.64350110879328437,
                                           0.78539816339744828};
    const int quarter = static_cast<int>(small / large * 4 + 0.5);
    const double c = 0.25 * quarter;
    const double t = (small - c * large) / (large + c * small);
    // Nine terms of the series of atan: the first one left out is below (1/8)^19 / 19 = 4e-19.
    const double q = t * t;
    double sum = 1.0 / 17;
    for (int odd = 15; odd >= 1; odd -= 2) sum = 1.0 / odd - q * sum;
    double angle = kAtanOfQuarters[quarter] + t * sum;

    if (y > width) angle = 0.5 * kPi - angle;
    return x < 0 ? kPi - angle : angle;
}

/// The angle between two vectors, in [0, pi]; accurate also near 0 and pi, where acos of the dot product is
/// not. 0 when either is zero.
inline double angleBetween(const DVec3& a, const DVec3& b) {
    return polarAngle(dot(a, b), length(cross(a, b)));
}

}  // namespace tspace
