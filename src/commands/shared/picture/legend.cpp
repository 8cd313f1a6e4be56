// SPDX-License-Identifier: MIT
#include "commands/shared/picture/legend.h"

#include <algorithm>
#include <array>
#include <string>

#include "commands/shared/picture/colors.h"

namespace tspace {

namespace {

constexpr Vec3 kInk{0.15f, 0.16f, 0.18f};
constexpr std::int64_t kDotRows = 7, kDotColumns = 5;

/// Rows from the top, the leftmost dot in the highest of five bits.
constexpr std::array<std::array<std::uint8_t, kDotRows>, 10> kDigits = {{
    {0b01110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110},
    {0b00100, 0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110},
    {0b01110, 0b10001, 0b00001, 0b00110, 0b01000, 0b10000, 0b11111},
    {0b11110, 0b00001, 0b00001, 0b01110, 0b00001, 0b00001, 0b11110},
    {0b00010, 0b00110, 0b01010, 0b10010, 0b11111, 0b00010, 0b00010},
    {0b11111, 0b10000, 0b11110, 0b00001, 0b00001, 0b10001, 0b01110},
    {0b00110, 0b01000, 0b10000, 0b11110, 0b10001, 0b10001, 0b01110},
    {0b11111, 0b00001, 0b00010, 0b00100, 0b00100, 0b01000, 0b01000},
    {0b01110, 0b10001, 0b10001, 0b01110, 0b10001, 0b10001, 0b01110},
    {0b01110, 0b10001, 0b10001, 0b01111, 0b00001, 0b00010, 0b01100},
}};

constexpr std::int64_t kBarRows = 8;  ///< dots

std::int64_t dotOf(std::uint32_t width) { return std::max<std::int64_t>(1, width / 512); }

}  // namespace

void fillRect(RgbImage& image, std::int64_t left, std::int64_t top, std::int64_t width, std::int64_t height,
              const Vec3& color) {
    const std::int64_t right = std::min<std::int64_t>(left + width, image.width),
                       bottom = std::min<std::int64_t>(top + height, image.height);
    for (std::int64_t y = std::max<std::int64_t>(0, top); y < bottom; ++y) {
        for (std::int64_t x = std::max<std::int64_t>(0, left); x < right; ++x) {
            std::uint8_t* pixel =
                image.rgb.data() + 3 * (static_cast<std::size_t>(y) * image.width + static_cast<std::size_t>(x));
            pixel[0] = storedByte(color.x);
            pixel[1] = storedByte(color.y);
            pixel[2] = storedByte(color.z);
        }
    }
}

void drawDigits(RgbImage& image, std::int64_t left, std::int64_t top, std::int64_t dot, std::string_view text,
                const Vec3& color) {
    for (const char c : text) {
        for (std::int64_t row = 0; c >= '0' && c <= '9' && row < kDotRows; ++row) {
            const unsigned dots = kDigits[static_cast<std::size_t>(c - '0')][static_cast<std::size_t>(row)];
            for (std::int64_t column = 0; column < kDotColumns; ++column) {
                if ((dots >> (kDotColumns - 1 - column) & 1U) == 0) continue;
                fillRect(image, left + column * dot, top + row * dot, dot, dot, color);
            }
        }
        left += (kDotColumns + 1) * dot;
    }
}

void drawUvSquare(RgbImage& image, const Camera& camera, std::uint32_t samples) {
    const auto pixel = [&](double sample) {
        const double inside = std::clamp(sample / samples, -1.0, static_cast<double>(image.width) + image.height);
        return static_cast<std::int64_t>(inside);
    };
    const SeenPoint upper_left = camera.see({0, 0, 0}), lower_right = camera.see({1, -1, 0});
    const std::int64_t left = pixel(upper_left.x), top = pixel(upper_left.y), right = pixel(lower_right.x),
                       bottom = pixel(lower_right.y);
    fillRect(image, left, top, right - left, 1, kInk);
    fillRect(image, left, bottom, right - left + 1, 1, kInk);
    fillRect(image, left, top, 1, bottom - top, kInk);
    fillRect(image, right, top, 1, bottom - top, kInk);
}

std::uint32_t heatScaleRows(std::uint32_t width) {
    constexpr std::uint32_t kLeastWidth = 200;
    return width < kLeastWidth ? 0 : static_cast<std::uint32_t>((kBarRows + kDotRows + 6) * dotOf(width));
}

void drawHeatScale(RgbImage& image) {
    const std::int64_t dot = dotOf(image.width), margin = 6 * dot, bar_height = kBarRows * dot;
    const std::int64_t top = std::int64_t{image.height} - heatScaleRows(image.width);
    if (top >= image.height || top < 0) return;
    fillRect(image, 0, top, image.width, image.height, kBackground);
    const auto stops = static_cast<std::int64_t>(kHeatStops.size());
    const std::int64_t step = (std::int64_t{image.width} - 2 * margin - 18 * dot) / (stops - 1);
    for (std::int64_t i = 0; i + 1 < stops; ++i) {
        const HeatStop &from = kHeatStops[static_cast<std::size_t>(i)],
                       &to = kHeatStops[static_cast<std::size_t>(i) + 1];
        for (std::int64_t x = 0; x < step; ++x) {
            const float t = static_cast<float>(x) / static_cast<float>(step);
            fillRect(image, margin + i * step + x, top, 1, bar_height,
                     heatColor(from.degrees + t * (to.degrees - from.degrees)));
        }
    }
    for (std::int64_t i = 0; i < stops; ++i) {
        const std::int64_t x = margin + i * step;
        fillRect(image, x, top, dot, bar_height + dot, kInk);
        drawDigits(image, x, top + bar_height + 2 * dot, dot,
                   std::to_string(static_cast<int>(kHeatStops[static_cast<std::size_t>(i)].degrees)), kInk);
    }
}

}  // namespace tspace
