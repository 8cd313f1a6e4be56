// SPDX-License-Identifier: MIT
// Texture files made by hand: KTX2 and DDS around any bytes.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "images/image.h"

namespace tspace::test {

/// `format`: DXGI's number. `data`: of all levels.
std::string ddsFile(std::uint32_t format, std::uint32_t width, std::uint32_t height, const std::string& data,
                    std::uint32_t levels = 1);
/// With a FourCC in place of it.
std::string oldDdsFile(const std::string& code, std::uint32_t width, std::uint32_t height, const std::string& data);
/// With masks of red, green, blue and alpha.
std::string maskedDdsFile(std::uint32_t bits, std::vector<std::uint32_t> masks, std::uint32_t width,
                          std::uint32_t height, const std::string& data);

struct Ktx2Parts {
    std::uint32_t format = 0;  ///< Vulkan's number
    std::uint32_t width = 0, height = 0;
    std::vector<std::string> levels = {};      ///< as stored; the largest first
    std::vector<std::uint64_t> unpacked = {};  ///< bytes of each, where they are packed
    std::uint32_t scheme = 0;                  ///< 2: Zstandard, 3: zlib
    std::uint8_t model = 1, channel = 0, transfer = 1;
    std::vector<std::pair<std::string, std::string>> values = {};
};
std::string ktx2File(const Ktx2Parts& parts);

/// Blocks of BC5 of the red and green channels: ends are the least and the largest value.
std::string bc5Blocks(const RgbImage& image);
/// Red and green of each pixel.
std::string redAndGreen(const RgbImage& image);

std::string bytesOfHex(const std::string& hex);
std::string zstdOf(const std::string& data);
std::string zlibOf(const std::string& data);

}  // namespace tspace::test
