// SPDX-License-Identifier: MIT
// Images: headers, pixels with 8 bits and with full precision, and inversion of the green channel.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "images/float_image.h"
#include "images/image.h"
#include "tspace/map_files.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::uint64_t kMostPixels = 1 << 20;
    const std::span<const std::uint8_t> bytes(data, size);
    tspace::imageWorkBytes(bytes);
    std::string why;
    const auto image = tspace::decodeImage(bytes, kMostPixels, why);
    if (image && image->rgb.size() != std::size_t{3} * image->width * image->height) std::abort();
    const auto deep = tspace::decodeFloatImage(bytes, kMostPixels, why);
    if (deep) {
        if (deep->texels.size() != std::size_t{deep->width} * deep->height) std::abort();
        for (const tspace::Vec3& texel : deep->texels) {
            if (!std::isfinite(texel.x) || !std::isfinite(texel.y) || !std::isfinite(texel.z)) std::abort();
        }
    }
    if (tspace::claimedSize(bytes).pixels() > kMostPixels) return 0;
    const auto flipped = tspace::flipGreen(bytes);
    if (flipped && !tspace::decodeImage(flipped->bytes, kMostPixels, why)) std::abort();
    return 0;
}
