// SPDX-License-Identifier: MIT
// Normal maps: what their heads claim, and their pixels.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "check/image.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::uint64_t kMostPixels = 1 << 20;
    const std::span<const std::uint8_t> bytes(data, size);
    tspace::imageWorkBytes(bytes);
    std::string why;
    const auto image = tspace::decodeImage(bytes, kMostPixels, why);
    if (image && image->rgb.size() != std::size_t{3} * image->width * image->height) std::abort();
    return 0;
}
