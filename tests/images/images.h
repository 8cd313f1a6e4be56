// SPDX-License-Identifier: MIT
// Normal maps computed from heights, and their files.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "images/image.h"

namespace tspace::test {

/// Returns the normal map of a height field. height(x, y): x runs to the right and y upward, both from 0 to 1. Green is
/// up, unless `green_down`.
RgbImage normalMapOf(std::uint32_t size, const std::function<double(double, double)>& height, bool green_down = false);

/// Returns the height of bumps with slopes in all directions.
double bumps(double x, double y);
/// Returns the height of round bumps. They curve along x and along y, so that only one of the two channels fits as x.
double bumpsApart(double x, double y);

std::string pngFile(const RgbImage& image);
std::string jpegFile(const RgbImage& image, int quality);
std::string webpFile(const RgbImage& image, bool lossless);

struct ExrChannel {
    std::string name = {};
    std::vector<float> values = {};  ///< width * height
    bool is_whole = false;           ///< stored as unsigned integers; otherwise as 32-bit floats
};
/// Returns an uncompressed EXR, in which the channels are in alphabetical order.
std::string exrFile(std::uint32_t width, std::uint32_t height, std::vector<ExrChannel> channels);

inline std::span<const std::uint8_t> bytesOf(const std::string& file) {
    return {reinterpret_cast<const std::uint8_t*>(file.data()), file.size()};
}

}  // namespace tspace::test
