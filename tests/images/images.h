// SPDX-License-Identifier: MIT
// Normal maps computed from heights, and their files.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "images/image.h"

namespace tspace::test {

/// Returns the normal map of a height field; x to the right, y upward, both 0 to 1. Green up, unless `green_down`.
RgbImage normalMapOf(std::uint32_t size, const std::function<double(double, double)>& height, bool green_down = false);

/// Bumps in every direction.
double bumps(double x, double y);

std::string pngFile(const RgbImage& image);
std::string jpegFile(const RgbImage& image, int quality);
std::string webpFile(const RgbImage& image, bool lossless);

struct ExrChannel {
    std::string name = {};
    std::vector<float> values = {};  ///< width * height
    bool is_whole = false;           ///< stored as an unsigned integer; otherwise as a 32-bit float
};
/// Returns an uncompressed EXR. Channels are stored in alphabetical order.
std::string exrFile(std::uint32_t width, std::uint32_t height, std::vector<ExrChannel> channels);

inline std::span<const std::uint8_t> bytesOf(const std::string& file) {
    return {reinterpret_cast<const std::uint8_t*>(file.data()), file.size()};
}

}  // namespace tspace::test
