// SPDX-License-Identifier: MIT
// Texture files for tests: KTX2 and DDS containers around arbitrary bytes.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "images/image.h"

namespace tspace::test {

/// Returns a DDS file. `format`: number of a DXGI format. `data`: bytes of all levels.
std::string ddsFile(std::uint32_t format, std::uint32_t width, std::uint32_t height, const std::string& data,
                    std::uint32_t levels = 1);
/// Returns a DDS file with a FourCC instead of a DXGI format.
std::string oldDdsFile(const std::string& code, std::uint32_t width, std::uint32_t height, const std::string& data);
/// Returns a DDS file with masks of red, green, blue and alpha.
std::string maskedDdsFile(std::uint32_t bits, std::vector<std::uint32_t> masks, std::uint32_t width,
                          std::uint32_t height, const std::string& data);

struct Ktx2Parts {
    std::uint32_t format = 0;  ///< number of a Vulkan format
    std::uint32_t width = 0, height = 0;
    std::vector<std::string> levels = {};      ///< as stored; the largest level first
    std::vector<std::uint64_t> unpacked = {};  ///< uncompressed sizes of the levels; empty if they are not compressed
    std::uint32_t scheme = 0;                  ///< 2: Zstandard, 3: zlib
    std::uint8_t model = 1, channel = 0, transfer = 1;
    std::vector<std::pair<std::string, std::string>> values = {};
};
std::string ktx2File(const Ktx2Parts& parts);

/// Returns BC5 blocks of the red and green channels, with the smallest and the largest value of each block as end
/// points.
std::string bc5Blocks(const RgbImage& image);
/// Returns the red and green bytes of each pixel.
std::string redAndGreen(const RgbImage& image);

std::string bytesOfHex(const std::string& hex);
std::string zstdOf(const std::string& data);
std::string zlibOf(const std::string& data);

}  // namespace tspace::test
