// SPDX-License-Identifier: MIT
// Normal maps made of heights, and their files.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "images/image.h"

namespace tspace::test {

/// The normal map of a height field; x to the right, y upwards, both 0 to 1. Green up, unless `green_down`.
RgbImage normalMapOf(std::uint32_t size, const std::function<double(double, double)>& height, bool green_down = false);

/// Bumps in every direction.
double bumps(double x, double y);

std::string pngFile(const RgbImage& image);
std::string jpegFile(const RgbImage& image, int quality);
std::string webpFile(const RgbImage& image, bool lossless);

struct ExrChannel {
    std::string name = {};
    std::vector<float> values = {};  ///< width * height
    bool is_whole = false;           ///< stored as an unsigned integer, else as a float of 32 bits
};
/// An EXR that is not packed. Channels are stored in the order of their names.
std::string exrFile(std::uint32_t width, std::uint32_t height, std::vector<ExrChannel> channels);

inline std::span<const std::uint8_t> bytesOf(const std::string& file) {
    return {reinterpret_cast<const std::uint8_t*>(file.data()), file.size()};
}

}  // namespace tspace::test
