// SPDX-License-Identifier: MIT
#include "tangents/estimators/input_scale.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace tspace::estimators {

namespace {

constexpr std::size_t kMostSamples = 1024;
constexpr int kLeastExponent = -149, kMostExponent = 127;

float largestOf(const Vec3& p) { return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}); }
float largestOf(const Vec2& p) { return std::max(std::fabs(p.x), std::fabs(p.y)); }

/// 2^-e, where e is the median of the exponents: one wild vertex does not move it. Even, so that a square
/// root of such a factor is a power of two as well.
template <class T>
float scaleOf(const StridedSpan<const T>& values) {
    std::uint32_t seen[kMostExponent - kLeastExponent + 1] = {};
    std::uint32_t total = 0;
    const std::size_t count = std::min(values.count, kMostSamples);
    for (std::size_t i = 0; i < count; ++i) {
        const float size = largestOf(values[values.count * i / count]);
        if (!(size > 0) || !(size <= FLT_MAX)) continue;
        ++seen[std::ilogb(size) - kLeastExponent];
        ++total;
    }
    int exponent = kLeastExponent;
    for (std::uint32_t below = 0; total != 0; ++exponent) {
        below += seen[exponent - kLeastExponent];
        if (2 * below >= total) break;
    }
    return total == 0 ? 1.0f : std::ldexp(1.0f, std::clamp(-exponent, -126, 126) / 2 * 2);
}

}  // namespace

float InputScale::lengthFactor() const {
    return static_cast<float>(
        std::clamp(static_cast<double>(uvs) / positions, double{FLT_MIN}, double{FLT_MAX}));
}

InputScale inputScale(const StridedSpan<const Vec3>& positions, const StridedSpan<const Vec2>& uvs) {
    return {scaleOf(positions), scaleOf(uvs)};
}

}  // namespace tspace::estimators
