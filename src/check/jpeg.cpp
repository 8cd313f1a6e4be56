// SPDX-License-Identifier: MIT
// The one file that holds the code of stb_image, of which only JPEG is compiled.
#include <limits>
#include <memory>

#include "check/image.h"

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 65500
#include <stb_image.h>

namespace tspace {

namespace {

struct FreePixels {
    void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

bool fits(std::span<const std::uint8_t> bytes) {
    return bytes.size() <= static_cast<std::size_t>(std::numeric_limits<int>::max());
}

}  // namespace

bool readJpegSize(std::span<const std::uint8_t> bytes, std::uint32_t& width, std::uint32_t& height) {
    int x = 0, y = 0, channels = 0;
    if (!fits(bytes) || stbi_info_from_memory(bytes.data(), static_cast<int>(bytes.size()), &x, &y, &channels) == 0 ||
        x <= 0 || y <= 0) {
        return false;
    }
    width = static_cast<std::uint32_t>(x);
    height = static_cast<std::uint32_t>(y);
    return true;
}

std::optional<RgbImage> decodeJpeg(std::span<const std::uint8_t> bytes) {
    int x = 0, y = 0, channels = 0;
    if (!fits(bytes)) return {};
    const std::unique_ptr<stbi_uc, FreePixels> pixels(
        stbi_load_from_memory(bytes.data(), static_cast<int>(bytes.size()), &x, &y, &channels, 3));
    if (!pixels || x <= 0 || y <= 0) return {};
    RgbImage image{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), {}};
    image.rgb.assign(pixels.get(), pixels.get() + std::size_t{3} * image.width * image.height);
    return image;
}

}  // namespace tspace
