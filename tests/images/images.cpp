// SPDX-License-Identifier: MIT
#include "images/images.h"

#include <algorithm>
#include <cmath>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>
#include <webp/encode.h>

namespace tspace::test {

namespace {

void append(void* file, void* data, int size) {
    static_cast<std::string*>(file)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

std::uint8_t stored(double value) {
    return static_cast<std::uint8_t>(std::clamp(std::lround((value + 1) * 127.5), 0L, 255L));
}

}  // namespace

RgbImage normalMapOf(std::uint32_t size, const std::function<double(double, double)>& height, bool green_down) {
    RgbImage image{size, size, {}};
    const double step = 1.0 / size;
    for (std::uint32_t row = 0; row < size; ++row) {
        for (std::uint32_t column = 0; column < size; ++column) {
            const double x = (column + 0.5) * step, y = 1 - (row + 0.5) * step;
            const double p = (height(x + step, y) - height(x - step, y)) / (2 * step);
            const double q = (height(x, y + step) - height(x, y - step)) / (2 * step) * (green_down ? -1 : 1);
            const double scale = 1 / std::sqrt(p * p + q * q + 1);
            for (const double value : {-p * scale, -q * scale, scale}) image.rgb.push_back(stored(value));
        }
    }
    return image;
}

double bumps(double x, double y) {
    return 0.02 * std::sin(20 * x + 3) * std::cos(17 * y) + 0.01 * std::sin(31 * (x + y)) +
           0.01 * std::cos(29 * (x - 2 * y));
}

std::string pngFile(const RgbImage& image) {
    std::string file;
    const auto width = static_cast<int>(image.width);
    stbi_write_png_to_func(append, &file, width, static_cast<int>(image.height), 3, image.rgb.data(), 3 * width);
    return file;
}

std::string jpegFile(const RgbImage& image, int quality) {
    std::string file;
    stbi_write_jpg_to_func(append, &file, static_cast<int>(image.width), static_cast<int>(image.height), 3,
                           image.rgb.data(), quality);
    return file;
}

std::string webpFile(const RgbImage& image, bool lossless) {
    const auto width = static_cast<int>(image.width), height = static_cast<int>(image.height);
    std::uint8_t* data = nullptr;
    const std::size_t size = lossless ? WebPEncodeLosslessRGB(image.rgb.data(), width, height, 3 * width, &data)
                                      : WebPEncodeRGB(image.rgb.data(), width, height, 3 * width, 90, &data);
    std::string file(reinterpret_cast<const char*>(data), size);
    WebPFree(data);
    return file;
}

}  // namespace tspace::test
