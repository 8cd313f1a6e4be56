// SPDX-License-Identifier: MIT
// Angles in double precision without libm, whose last bits differ between platforms: only + - * / and sqrt.
#pragma once

#include "core/base/vec_math.h"

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

struct SineCosine {
    double sine = 0, cosine = 1;
};

/// Sine and cosine of an angle in radians; absolute error below 1e-15 for |angle| <= 100, and growing with the angle
/// beyond (tested against libm). (0, 1) where the angle is not finite.
inline SineCosine sineCosine(double angle) {
    if (!std::isfinite(angle)) return {};
    // pi / 2 in two parts: the first has few bits, so that its small multiples are exact.
    constexpr double kHalfPiHigh = 1.57079632673412561417e+00;
    constexpr double kHalfPiLow = 6.07710050650619224932e-11;
    const double rest = std::fmod(angle, 2 * kPi * (1 << 20));  // exact, and leaves angles of ordinary size alone
    const double quarters = std::floor(rest / (0.5 * kPi) + 0.5);
    const double x = (rest - quarters * kHalfPiHigh) - quarters * kHalfPiLow;
    // |x| <= pi / 4: the first terms left out are below 0.79^19 / 19! = 1e-19 and 0.79^18 / 18! = 2e-18.
    const double q = x * x;
    double sine = 1, cosine = 1;
    for (int n = 17; n >= 3; n -= 2) sine = 1 - q / (n * (n - 1)) * sine;
    for (int n = 16; n >= 2; n -= 2) cosine = 1 - q / (n * (n - 1)) * cosine;
    sine *= x;
    const unsigned quarter = static_cast<unsigned>(static_cast<int>(std::fmod(quarters, 4))) & 3;
    const SineCosine half = quarter % 2 == 0 ? SineCosine{sine, cosine} : SineCosine{cosine, -sine};
    return quarter < 2 ? half : SineCosine{-half.sine, -half.cosine};
}

/// The angle between two vectors, in [0, pi]; accurate also near 0 and pi, where acos of the dot product is
/// not. 0 when either is zero.
inline double angleBetween(const DVec3& a, const DVec3& b) { return polarAngle(dot(a, b), length(cross(a, b))); }

}  // namespace tspace
