// SPDX-License-Identifier: MIT
// The arc cosine of a float, rounded to float: the same bits on every platform, and those of the C library's
// double acos rounded to float (compared for every float in [-1, 1]). Straight-line code, so that loops over
// it vectorise.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace tspace {

/// acos(c) in radians for c in [-1, 1]; NaN for anything else.
///
/// For |c| <= 1/2: pi/2 - asin(c). Above: acos(c) = 2 asin(s), s = sqrt((1 - |c|) / 2), and pi minus that for
/// negative c. asin(s) = s + s*y*P(y) with y = s*s <= 1/4; P is the minimax polynomial of degree 13 (absolute
/// error of y*P(y) below 2^-58). The rounding error of the square root is carried along in `rest`, and pi/2
/// has two parts, so the double result is good to about 0.6 units in its last place before it is rounded to
/// float.
inline float arcCosine(float c) {
    constexpr double kHalfPi = 0x1.921fb54442d18p+0;
    constexpr double kHalfPiRest = 0x1.1a62633145c07p-54;
    const double x = c;
    const double a = std::fabs(x);
    const bool steep = a > 0.5;
    const double y = steep ? 0.5 * (1.0 - a) : a * a;  // exact in double either way
    const double s = steep ? std::sqrt(y) : a;
    double p = 0x1.e529c6fce9bb4p-6;
    p = p * y - 0x1.3b416bb7d9257p-6;
    p = p * y + 0x1.406192d124629p-6;
    p = p * y + 0x1.8f193743418ffp-9;
    p = p * y + 0x1.31622469ce5adp-7;
    p = p * y + 0x1.3b49de7121487p-7;
    p = p * y + 0x1.7b027ee1dd585p-7;
    p = p * y + 0x1.c990ad3d8fdcap-7;
    p = p * y + 0x1.1c4efce23019fp-6;
    p = p * y + 0x1.6e8ba123e494cp-6;
    p = p * y + 0x1.f1c71c7a52ba3p-6;
    p = p * y + 0x1.6db6db6dac1e0p-5;
    p = p * y + 0x1.3333333333388p-4;
    p = p * y + 0x1.5555555555555p-3;
    // The upper half of s has few enough bits for its square to be exact, so y - head*head is s's rounding
    // error. 1e-300 keeps 0/0 away when c is 1.
    const double upper = std::bit_cast<double>(std::bit_cast<std::uint64_t>(s) & 0xfffffffff8000000u);
    const double head = steep ? upper : a;
    const double rest = steep ? (y - upper * upper) / (s + upper + 1e-300) : 0.0;
    const double tail = s * y * p + rest;
    const double below = kHalfPi - (head + (tail - kHalfPiRest));
    const double above = kHalfPi + (head + (tail + kHalfPiRest));
    const double positive = steep ? 2.0 * (head + tail) : below;
    const double negative = steep ? 2.0 * below : above;
    return static_cast<float>(x < 0.0 ? negative : positive);
}

}  // namespace tspace
