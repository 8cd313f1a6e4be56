// SPDX-License-Identifier: MIT
// Bilinear filtering: the texels and weights of a point of a texture. Texel centers are at (i + 0.5) / size, as in all
// graphics APIs; row 0 is v = 0.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "tspace/maps.h"
#include "tspace/span.h"

namespace tspace {

/// Size and wrap modes of a texture, which decide the texels that a sample reads.
struct TextureShape {
    std::uint32_t width = 0, height = 0;  ///< both at least 1
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
};

/// Returns the texel at column (or row) `at` of a texture that continues infinitely in all directions.
inline std::uint32_t wrappedTexel(std::int64_t at, std::uint32_t size, TextureWrap wrap) {
    const std::int64_t count = size;
    // Fast path for nearly all calls, because a division would dominate the time.
    if (at >= 0 && at < count) return static_cast<std::uint32_t>(at);
    if (wrap == TextureWrap::clamp) return static_cast<std::uint32_t>(at < 0 ? 0 : at < count ? at : count - 1);
    const std::int64_t period = wrap == TextureWrap::mirror ? 2 * count : count;
    std::int64_t inside = at % period;
    if (inside < 0) inside += period;
    return static_cast<std::uint32_t>(inside < count ? inside : period - 1 - inside);
}

/// Returns the index (y * width + x) of the texel that is `dx` columns and `dy` rows from another one.
inline std::size_t texelBeside(const TextureShape& shape, std::size_t texel, int dx, int dy) {
    const auto x = static_cast<std::int64_t>(texel % shape.width), y = static_cast<std::int64_t>(texel / shape.width);
    return std::size_t{wrappedTexel(y + dy, shape.height, shape.wrap_v)} * shape.width +
           wrappedTexel(x + dx, shape.width, shape.wrap_u);
}

/// Calls visit(texel) for the 3 x 3 texels around a texel.
template <class Visit>
void forTexelsAround(const TextureShape& shape, std::size_t texel, const Visit& visit) {
    for (const int dy : {-1, 0, 1}) {
        for (const int dx : {-1, 0, 1}) visit(texelBeside(shape, texel, dx, dy));
    }
}

/// Indices (y * width + x) and weights of the four texels of a bilinear sample; the weights sum to 1.
struct BilinearTaps {
    std::array<std::size_t, 4> texels = {};
    std::array<float, 4> weights = {};
};

/// Returns the four texels of a sample. UVs that are not finite, or 2^40 texels or more away, read the texel at (0, 0).
inline BilinearTaps bilinearTaps(const TextureShape& shape, Vec2 uv) {
    const double x = static_cast<double>(uv.x) * shape.width - 0.5, y = static_cast<double>(uv.y) * shape.height - 0.5;
    constexpr double kFar = 1099511627776.0;
    if (!(std::abs(x) < kFar && std::abs(y) < kFar)) return {{}, {1, 0, 0, 0}};
    const double left = std::floor(x), top = std::floor(y);
    const auto column = [&](int step) {
        return wrappedTexel(static_cast<std::int64_t>(left) + step, shape.width, shape.wrap_u);
    };
    const auto row = [&](int step) {
        return std::size_t{wrappedTexel(static_cast<std::int64_t>(top) + step, shape.height, shape.wrap_v)} *
               shape.width;
    };
    const std::size_t columns[] = {column(0), column(1)}, rows[] = {row(0), row(1)};
    const auto right = static_cast<float>(x - left), below = static_cast<float>(y - top);
    return {{rows[0] + columns[0], rows[0] + columns[1], rows[1] + columns[0], rows[1] + columns[1]},
            {(1 - right) * (1 - below), right * (1 - below), (1 - right) * below, right * below}};
}

/// Samples `texels`, an array of width * height, with bilinear filtering.
inline Vec3 sampleBilinear(const TextureShape& shape, std::span<const Vec3> texels, Vec2 uv) {
    const BilinearTaps taps = bilinearTaps(shape, uv);
    Vec3 sum{};
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3& texel = texels[taps.texels[i]];
        const float weight = taps.weights[i];
        sum = {sum.x + weight * texel.x, sum.y + weight * texel.y, sum.z + weight * texel.z};
    }
    return sum;
}

}  // namespace tspace
