// SPDX-License-Identifier: MIT
#include "commands/check/map_alpha.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "commands/check/texel_statistics.h"

namespace tspace {
namespace {

constexpr std::size_t kColors = 3, kAlpha = 3;

/// Returns whether `channel` equals valueOf(texel) at all texels, except for compression errors.
template <class ValueOf>
bool isCopyOf(std::span<const TexelBytes> texels, std::size_t channel, const ValueOf& valueOf) {
    constexpr double kOfDeviation = 0.15, kOfGentle = 0.5;  // compression errors are large compared with gentle relief
    const Spread apart =
        spreadOf(texels, [&](const TexelBytes& texel) { return static_cast<double>(texel[channel]) - valueOf(texel); });
    const double error = std::hypot(apart.mean, apart.deviation);
    const double deviation = spreadOf(texels, channel).deviation;
    return error <= std::max(kOfDeviation * deviation, std::min(kConstant, kOfGentle * deviation));
}

bool areEqual(std::span<const TexelBytes> texels, std::size_t a, std::size_t b) {
    return isCopyOf(texels, a, [b](const TexelBytes& texel) { return static_cast<double>(texel[b]); });
}

/// Returns whether a channel holds z, as (z + 1) / 2 or as z.
template <class ZOf>
bool isZ(std::span<const TexelBytes> texels, std::size_t channel, const ZOf& zOf) {
    return isCopyOf(texels, channel, [&](const TexelBytes& texel) { return 127.5 * (zOf(texel) + 1); }) ||
           isCopyOf(texels, channel, [&](const TexelBytes& texel) { return 255 * zOf(texel); });
}

/// Returns z of a vector with one of x and y in a channel, and 0 for the other.
double ownZ(const TexelBytes& texel, std::size_t channel) {
    const double value = signedValue(texel[channel]);
    return std::sqrt(std::max(0.0, 1 - value * value));
}

/// Returns whether a component of real vectors can have these values: nearly none is that of a vector in the surface,
/// as in a mask.
bool isComponent(std::span<const TexelBytes> texels, std::size_t channel) {
    constexpr double kFarthest = 0.985, kFew = 0.05;
    return !isConstant(texels, channel) && texelShare(texels, [&](const TexelBytes& texel) {
                                               return std::fabs(signedValue(texel[channel])) > kFarthest;
                                           }) < kFew;
}

/// Returns how the colors support a pair, or nullopt if one of them holds something else.
std::optional<AlphaPair> pairOf(std::span<const TexelBytes> texels, std::size_t color) {
    constexpr double kFarX = 0.9;
    std::size_t copy_count = 0, z_count = 0;
    bool is_red_far = false;
    for (std::size_t other = 0; other < kColors; ++other) {
        if (other == color) continue;
        if (areEqual(texels, other, color)) {
            if (other < color) return {};  // that color is the pair
            ++copy_count;
        } else if (const Spread spread = spreadOf(texels, other); spread.deviation <= kConstant) {
            is_red_far = is_red_far || (other == 0 && std::fabs(spread.mean * kByteStep - 1) > kFarX);
        } else if (isZ(texels, other, [=](const TexelBytes& texel) { return expectedZ(texel, color, kAlpha); })) {
            // It proves the pair only if alpha is needed for it.
            z_count += isZ(texels, other, [=](const TexelBytes& texel) { return ownZ(texel, color); }) ? 0 : 1;
        } else {
            return {};
        }
    }
    // No other map has a z that needs alpha, nor equal green and blue beside a red that cannot be x. But equal red and
    // green may be gentle diagonal ridges, whose z is constant, and gray colors may be heights with a mask in alpha.
    return AlphaPair{.color = static_cast<MapChannel>(color),
                     .is_certain = z_count > 0 || (copy_count == 1 && is_red_far),
                     .is_gray = copy_count == 2};
}

}  // namespace

bool mayHaveXInAlpha(std::span<const TexelBytes> texels) {
    if (texels.empty()) return false;
    for (std::size_t i = 0; i < kColors; ++i) {
        if (isConstant(texels, i) || areEqual(texels, i, (i + 1) % kColors)) return true;
    }
    return false;
}

std::vector<AlphaPair> alphaPairs(std::span<const TexelBytes> texels) {
    std::vector<AlphaPair> pairs;
    if (texels.empty() || !isComponent(texels, kAlpha)) return pairs;
    for (const std::size_t color : {std::size_t{1}, std::size_t{0}, std::size_t{2}}) {
        if (!isComponent(texels, color) || areEqual(texels, color, kAlpha) || !canBeXy(texels, kAlpha, color)) continue;
        if (const std::optional<AlphaPair> pair = pairOf(texels, color)) pairs.push_back(*pair);
    }
    return pairs;
}

}  // namespace tspace
