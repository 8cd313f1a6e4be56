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

double bumpsApart(double x, double y) {
    double h = 0;
    for (int i = 0; i < 36; ++i) {
        const double u = x - (i % 6 + 0.5 + 0.3 * std::sin(7.0 * i)) / 6,
                     v = y - (i / 6 + 0.5 + 0.3 * std::cos(5.0 * i)) / 6;
        h += 0.02 * std::exp(-(u * u + v * v) * 400);
    }
    return h;
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

namespace {

template <class Number>
void addNumber(Number number, std::string& file) {
    file.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void addAttribute(const std::string& name, const std::string& type, const std::string& value, std::string& file) {
    file += name + '\0' + type + '\0';
    addNumber(static_cast<std::uint32_t>(value.size()), file);
    file += value;
}

}  // namespace

std::string exrFile(std::uint32_t width, std::uint32_t height, std::vector<ExrChannel> channels) {
    std::sort(channels.begin(), channels.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    std::string list, window, rest, file("\x76\x2f\x31\x01\x02\0\0\0", 8);
    for (const ExrChannel& channel : channels) {
        list += channel.name + '\0';
        for (const std::uint32_t number : {channel.is_whole ? 0U : 2U, 0U, 1U, 1U}) addNumber(number, list);
    }
    for (const std::uint32_t number : {0U, 0U, width - 1, height - 1}) addNumber(number, window);
    addAttribute("channels", "chlist", list + '\0', file);
    addAttribute("compression", "compression", std::string(1, '\0'), file);
    addAttribute("dataWindow", "box2i", window, file);
    addAttribute("displayWindow", "box2i", window, file);
    addAttribute("lineOrder", "lineOrder", std::string(1, '\0'), file);
    addAttribute("pixelAspectRatio", "float", std::string("\0\0\x80\x3f", 4), file);
    addAttribute("screenWindowCenter", "v2f", std::string(8, '\0'), file);
    addAttribute("screenWindowWidth", "float", std::string("\0\0\x80\x3f", 4), file);
    file += '\0';
    const std::size_t row_bytes = channels.size() * width * 4, rows_at = file.size() + std::size_t{height} * 8;
    for (std::uint32_t row = 0; row < height; ++row)
        addNumber(static_cast<std::uint64_t>(rows_at + row * (8 + row_bytes)), file);
    for (std::uint32_t row = 0; row < height; ++row) {
        addNumber(row, file);
        addNumber(static_cast<std::uint32_t>(row_bytes), file);
        for (const ExrChannel& channel : channels) {
            for (std::uint32_t x = 0; x < width; ++x) {
                const float value = channel.values[std::size_t{row} * width + x];
                channel.is_whole ? addNumber(static_cast<std::uint32_t>(value), file) : addNumber(value, file);
            }
        }
    }
    return file;
}

}  // namespace tspace::test
