// SPDX-License-Identifier: MIT
// Statistics of the channels of a map, by which its content is detected.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "commands/check/map_texels.h"

namespace tspace {

/// Standard deviation, on a scale from 0 to 255, below which a channel is constant; compression alone may cause this
/// much.
inline constexpr double kConstant = 2.5;
/// Maximum absolute mean of x and of y in a tangent-space map, for callers that know nothing else about the map.
inline constexpr double kMaxMean = 0.25;

struct Spread {
    double mean = 0, deviation = 0;
};

template <class ValueOf>
Spread spreadOf(std::span<const TexelBytes> texels, const ValueOf& valueOf) {
    double sum = 0, squares = 0;
    for (const TexelBytes& texel : texels) {
        const double value = valueOf(texel);
        sum += value;
        squares += value * value;
    }
    const auto count = static_cast<double>(texels.size());
    const double mean = sum / count;
    return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean))};
}

inline Spread spreadOf(std::span<const TexelBytes> texels, std::size_t channel) {
    return spreadOf(texels, [channel](const TexelBytes& texel) { return static_cast<double>(texel[channel]); });
}

inline bool isConstant(std::span<const TexelBytes> texels, std::size_t channel) {
    return spreadOf(texels, channel).deviation <= kConstant;
}

template <class Test>
double texelShare(std::span<const TexelBytes> texels, const Test& test) {
    return static_cast<double>(std::count_if(texels.begin(), texels.end(), test)) / static_cast<double>(texels.size());
}

/// Returns x^2 + y^2 of two channels.
inline double squareOf(const TexelBytes& texel, std::size_t x, std::size_t y) {
    const double a = signedValue(texel[x]), b = signedValue(texel[y]);
    return a * a + b * b;
}

/// Returns z of a unit vector with x and y in two channels.
inline double expectedZ(const TexelBytes& texel, std::size_t x, std::size_t y) {
    return std::sqrt(std::max(0.0, 1 - squareOf(texel, x, y)));
}

/// Returns whether two channels can be x and y of unit vectors: nearly no texel is longer than 1, and both means are
/// near 0.
inline bool canBeXy(std::span<const TexelBytes> texels, std::size_t x, std::size_t y, double max_mean = kMaxMean,
                    double max_long = 0.01) {
    constexpr double kLongest = 1.03;
    const auto meanOf = [&](std::size_t channel) { return spreadOf(texels, channel).mean * kByteStep - 1; };
    return texelShare(texels, [&](const TexelBytes& texel) { return squareOf(texel, x, y) > kLongest; }) < max_long &&
           std::fabs(meanOf(x)) < max_mean && std::fabs(meanOf(y)) < max_mean;
}

}  // namespace tspace
