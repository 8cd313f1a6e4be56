// SPDX-License-Identifier: MIT
// A texture of a picture. Textures are many and large, so those of 8 bits stay so.
#pragma once

#include <cstdint>
#include <vector>

#include "maps/texture_sample.h"
#include "tspace/vec.h"

namespace tspace {

struct PictureTexture {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> bytes = {};  ///< three per texel, or
    std::vector<Vec3> texels = {};         ///< one per texel, where 8 bits do not do
    std::vector<float> values = {};        ///< 256: what the bytes stand for
    std::vector<float> alpha = {};         ///< one per texel, or empty: opaque, or not asked for

    [[nodiscard]] Vec3 at(std::size_t texel) const {
        if (bytes.empty()) return texels[texel];
        const std::uint8_t* rgb = bytes.data() + 3 * texel;
        return {values[rgb[0]], values[rgb[1]], values[rgb[2]]};
    }
};

/// The mean of the four texels around a point.
inline Vec3 sampleTexture(const PictureTexture& texture, const TextureShape& shape, Vec2 uv) {
    const BilinearTaps taps = bilinearTaps(shape, uv);
    Vec3 sum{};
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 texel = texture.at(taps.texels[i]);
        const float weight = taps.weights[i];
        sum = {sum.x + weight * texel.x, sum.y + weight * texel.y, sum.z + weight * texel.z};
    }
    return sum;
}

}  // namespace tspace
