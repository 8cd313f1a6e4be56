// SPDX-License-Identifier: MIT
// Creates a small image from the input.
#pragma once

#include <cstdint>
#include <vector>

#include "byte_reader.h"
#include "images/float_image.h"

namespace tspace::fuzz {

/// Creates a random image of up to 12 x 12 texels. Often most of it is blue, as in a normal map.
inline FloatImage makeImage(ByteReader& in) {
    const std::uint32_t width = 1 + in.byte() % 12u, height = 1 + in.byte() % 12u;
    const bool is_blue = in.byte() % 2 == 0;
    FloatImage image{.width = width, .height = height, .bits = in.byte() % 2 == 0 ? 8U : 16U};
    for (std::uint32_t i = 0; i < image.width * image.height; ++i) {
        const float red = static_cast<float>(in.byte()) / 255, green = static_cast<float>(in.byte()) / 255;
        image.texels.push_back({red, green, is_blue ? 1.0F : static_cast<float>(in.byte()) / 255});
    }
    return image;
}

/// Returns a random image as a PNG. Returns no bytes if this build cannot write PNGs.
inline std::vector<std::uint8_t> makePng(ByteReader& in) {
    const FloatImage image = makeImage(in);
    return encodePng(image, image.bits).value_or(std::vector<std::uint8_t>{});
}

}  // namespace tspace::fuzz
