// SPDX-License-Identifier: MIT
// Decoding of images that come out of model files, which may be hostile.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tspace {

/// 8 bits a channel; the first row is the top one.
struct RgbImage {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgb = {};
};

/// About the most memory that decodeImage holds for these bytes; 0 where it decodes nothing.
std::uint64_t imageWorkBytes(std::span<const std::uint8_t> bytes);

/// Decodes PNG and JPEG, told apart by content. Nothing, with the reason in `why` (half a sentence), for other formats,
/// broken files, more than `most_pixels` pixels, and images that are out of proportion to their bytes.
std::optional<RgbImage> decodeImage(std::span<const std::uint8_t> bytes, std::uint64_t most_pixels, std::string& why);

/// The same for bytes that are known to be a JPEG of that size. No image: broken.
std::optional<RgbImage> decodeJpeg(std::span<const std::uint8_t> bytes, std::uint32_t width, std::uint32_t height);
/// Width and height of a JPEG; false: broken.
bool readJpegSize(std::span<const std::uint8_t> bytes, std::uint32_t& width, std::uint32_t& height);

}  // namespace tspace
