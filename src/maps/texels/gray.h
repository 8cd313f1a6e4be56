// SPDX-License-Identifier: MIT
// Detects gray images in any storage format.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace tspace {

/// Returns the correlations of red with green, green with blue, and blue with red; 0 if one of the channels is
/// constant.
template <class TexelAt>
std::array<double, 3> channelCorrelations(std::size_t count, const TexelAt& texelAt) {
    // maximum RMS deviation of a channel that counts as constant, in units of 1/255: compression adds about as much
    constexpr double kConstant = 2.5;
    std::array<double, 3> sum = {}, squares = {}, products = {};
    for (std::size_t i = 0; i < count; ++i) {
        const std::array<double, 3> texel = texelAt(i);
        for (std::size_t k = 0; k < 3; ++k) {
            sum[k] += texel[k];
            squares[k] += texel[k] * texel[k];
            products[k] += texel[k] * texel[(k + 1) % 3];
        }
    }
    const auto total = static_cast<double>(count);
    const auto variance = [&](std::size_t k) { return squares[k] / total - sum[k] / total * (sum[k] / total); };
    std::array<double, 3> correlations = {};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        if (!(variance(k) > kConstant * kConstant) || !(variance(next) > kConstant * kConstant)) continue;
        correlations[k] =
            (products[k] / total - sum[k] / total * (sum[next] / total)) / std::sqrt(variance(k) * variance(next));
    }
    return correlations;
}

/// Returns whether an image is gray: 98 % of the texels have equal channels within compression errors, or a weak tint
/// with correlated channels. This rejects normal maps with one constant channel, whose other two channels are not
/// correlated. `texelAt(i)`: values from 0 to 255.
template <class TexelAt>
bool isGray(std::size_t count, const TexelAt& texelAt) {
    constexpr double kApart = 4.5, kTintApart = 6.5, kMostTint = 0.1, kMost = 0.98, kLeastCorrelation = 0.95;
    std::size_t gray = 0, tinted = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::array<double, 3> texel = texelAt(i);
        const double most = std::max({texel[0], texel[1], texel[2]});
        const double apart = most - std::min({texel[0], texel[1], texel[2]});
        gray += apart <= kApart;
        tinted += apart <= kTintApart + kMostTint * most;
    }
    const double enough = kMost * static_cast<double>(count);
    if (static_cast<double>(gray) > enough) return true;
    if (!(static_cast<double>(tinted) > enough)) return false;
    const std::array<double, 3> correlations = channelCorrelations(count, texelAt);
    return *std::min_element(correlations.begin(), correlations.end()) >= kLeastCorrelation;
}

}  // namespace tspace
