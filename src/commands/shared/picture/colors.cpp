// SPDX-License-Identifier: MIT

#include "commands/shared/picture/colors.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tspace {
namespace {

/// a^(1/5) for 0 < a <= 1, by Newton's method.
double fifthRoot(double a) {
    double root = 1;
    for (int i = 0; i < 64; ++i) root = (4 * root + a / (root * root * root * root)) / 5;
    return root;
}

/// From light to bytes: the limits between the light of one byte and the next, and, so that few limits are compared, the byte
/// of the darkest light of each of many steps.
struct ByteBorders {
    static constexpr std::size_t kSteps = 4096;
    std::array<float, 256> borders;
    std::array<std::uint8_t, kSteps + 1> first;

    ByteBorders() {
        for (std::size_t i = 0; i < 255; ++i)
            borders[i] = static_cast<float>(srgbToLight((static_cast<double>(i) + 0.5) / 255));
        borders[255] = std::numeric_limits<float>::infinity();
        for (std::size_t step = 0; step <= kSteps; ++step) {
            const float light = static_cast<float>(step) / kSteps;
            first[step] =
                static_cast<std::uint8_t>(std::upper_bound(borders.begin(), borders.end(), light) - borders.begin());
        }
    }
};

}  // namespace

double srgbToLight(double stored) {
    if (stored <= 0.04045) return stored / 12.92;
    // x^2.4 = x^2 (x^2)^(1/5)
    const double x = (stored + 0.055) / 1.055;
    return x * x * fifthRoot(x * x);
}

std::vector<float> srgbTable(unsigned bits) {
    const std::size_t count = std::size_t{1} << bits;
    std::vector<float> table(count);
    for (std::size_t i = 0; i < count; ++i)
        table[i] = static_cast<float>(srgbToLight(static_cast<double>(i) / static_cast<double>(count - 1)));
    return table;
}

std::uint8_t lightToSrgb(float light) {
    static const ByteBorders table;
    const float inside = light > 0 ? std::min(light, 1.0f) : 0.0f;
    std::uint8_t byte = table.first[static_cast<std::size_t>(inside * ByteBorders::kSteps)];
    while (table.borders[byte] <= inside) ++byte;
    return byte;
}

std::uint8_t storedByte(float value) {
    return static_cast<std::uint8_t>(value > 0 ? std::min(value, 1.0f) * 255 + 0.5f : 0.0f);
}

Vec3 heatColor(float degrees) {
    for (std::size_t i = 1; i < kHeatStops.size(); ++i) {
        const HeatStop &from = kHeatStops[i - 1], &to = kHeatStops[i];
        if (degrees > to.degrees && i + 1 < kHeatStops.size()) continue;
        const float t = std::clamp((degrees - from.degrees) / (to.degrees - from.degrees), 0.0f, 1.0f);
        return {from.color.x + t * (to.color.x - from.color.x), from.color.y + t * (to.color.y - from.color.y),
                from.color.z + t * (to.color.z - from.color.z)};
    }
    return kHeatStops[0].color;
}

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

constexpr std::array<std::array<std::uint8_t, kDotRows>, 26> kLetters = {{
    {0b01110, 0b10001, 0b10001, 0b11111, 0b10001, 0b10001, 0b10001},
    {0b11110, 0b10001, 0b10001, 0b11110, 0b10001, 0b10001, 0b11110},
    {0b01110, 0b10001, 0b10000, 0b10000, 0b10000, 0b10001, 0b01110},
    {0b11110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b11110},
    {0b11111, 0b10000, 0b10000, 0b11110, 0b10000, 0b10000, 0b11111},
    {0b11111, 0b10000, 0b10000, 0b11110, 0b10000, 0b10000, 0b10000},
    {0b01110, 0b10001, 0b10000, 0b10111, 0b10001, 0b10001, 0b01110},
    {0b10001, 0b10001, 0b10001, 0b11111, 0b10001, 0b10001, 0b10001},
    {0b01110, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110},
    {0b00111, 0b00010, 0b00010, 0b00010, 0b00010, 0b10010, 0b01100},
    {0b10001, 0b10010, 0b10100, 0b11000, 0b10100, 0b10010, 0b10001},
    {0b10000, 0b10000, 0b10000, 0b10000, 0b10000, 0b10000, 0b11111},
    {0b10001, 0b11011, 0b10101, 0b10101, 0b10001, 0b10001, 0b10001},
    {0b10001, 0b11001, 0b10101, 0b10011, 0b10001, 0b10001, 0b10001},
    {0b01110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110},
    {0b11110, 0b10001, 0b10001, 0b11110, 0b10000, 0b10000, 0b10000},
    {0b01110, 0b10001, 0b10001, 0b10001, 0b10101, 0b10010, 0b01101},
    {0b11110, 0b10001, 0b10001, 0b11110, 0b10100, 0b10010, 0b10001},
    {0b01111, 0b10000, 0b10000, 0b01110, 0b00001, 0b00001, 0b11110},
    {0b11111, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100},
    {0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110},
    {0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01010, 0b00100},
    {0b10001, 0b10001, 0b10001, 0b10101, 0b10101, 0b11011, 0b10001},
    {0b10001, 0b10001, 0b01010, 0b00100, 0b01010, 0b10001, 0b10001},
    {0b10001, 0b10001, 0b01010, 0b00100, 0b00100, 0b00100, 0b00100},
    {0b11111, 0b00001, 0b00010, 0b00100, 0b01000, 0b10000, 0b11111},
}};
constexpr std::array<std::uint8_t, kDotRows> kNoDots{},
    kPlus = {0b00000, 0b00100, 0b00100, 0b11111, 0b00100, 0b00100, 0b00000},
    kMinus = {0b00000, 0b00000, 0b00000, 0b11111, 0b00000, 0b00000, 0b00000},
    kEquals = {0b00000, 0b00000, 0b11111, 0b00000, 0b11111, 0b00000, 0b00000};

const std::array<std::uint8_t, kDotRows>& dotsOf(char c) {
    if (c >= '0' && c <= '9') return kDigits[static_cast<std::size_t>(c - '0')];
    if (c >= 'A' && c <= 'Z') return kLetters[static_cast<std::size_t>(c - 'A')];
    return c == '+' ? kPlus : c == '-' ? kMinus : c == '=' ? kEquals : kNoDots;
}

constexpr std::int64_t kBarRows = 8;  ///< dots

/// An entry of a legend: a colour, perhaps with stripes of another one, and what it means.
struct LegendEntry {
    Vec3 color;
    std::optional<Vec3> stripes;
    std::string_view text;
};

std::vector<LegendEntry> legendOf(RenderShow show) {
    constexpr Vec3 kRed{1, 0.5f, 0.5f}, kGreen{0.5f, 1, 0.5f}, kBlue{0.5f, 0.5f, 1};
    switch (show) {
        case RenderShow::sign:
            return {{kSignPlus, {}, "W = +1"},
                    {kSignMinus, {}, "W = -1"},
                    {kSignMinus, kSignStripes, "UV MIRRORED"},
                    {kSignPlus, kSignWrong, "WRONG SIGN"},
                    {kSignNeither, {}, "NEITHER"}};
        case RenderShow::normals:
        case RenderShow::mapped:
        case RenderShow::tangents:
            return {{kRed, {}, "+X"}, {kGreen, {}, "+Y"}, {kBlue, {}, "+Z"}};
        case RenderShow::uv:
            return {{{0.55f, 0.74f, 0.89f}, {}, "AN ISLAND"},
                    {{0.55f, 0.74f, 0.89f}, Vec3{0.25f, 0.33f, 0.40f}, "MIRRORED"}};
        case RenderShow::both:
            return {{kBackground, {}, "LEFT = STORED FRAMES"}, {kBackground, {}, "RIGHT = COMPUTED"}};
        case RenderShow::lit:
        case RenderShow::surface:
        case RenderShow::error:
            break;
    }
    return {};
}

std::int64_t dotOf(std::uint32_t width) { return std::max<std::int64_t>(1, width / 340); }

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
        const std::array<std::uint8_t, kDotRows>& rows = dotsOf(c);
        for (std::int64_t row = 0; row < kDotRows; ++row) {
            const unsigned dots = rows[static_cast<std::size_t>(row)];
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

std::uint32_t legendRows(RenderShow show, std::uint32_t width) {
    constexpr std::uint32_t kLeastWidth = 400;
    return width < kLeastWidth || legendOf(show).empty() ? 0
                                                         : static_cast<std::uint32_t>((kDotRows + 8) * dotOf(width));
}

void drawLegend(RgbImage& image, RenderShow show) {
    const std::int64_t dot = dotOf(image.width), rows = legendRows(show, image.width);
    const std::int64_t top = std::int64_t{image.height} - rows, side = kDotRows * dot;
    if (rows == 0 || top < 0) return;
    fillRect(image, 0, top, image.width, rows, kBackground);
    std::int64_t left = 6 * dot;
    for (const LegendEntry& entry : legendOf(show)) {
        fillRect(image, left, top + 4 * dot, side, side, entry.color);
        for (std::int64_t k = 0; entry.stripes && k < kDotRows; k += 2)
            fillRect(image, left + k * dot, top + 4 * dot, dot, side, *entry.stripes);
        left += side + 3 * dot;
        drawDigits(image, left, top + 4 * dot, dot, entry.text, kInk);
        left += (static_cast<std::int64_t>(entry.text.size()) * (kDotColumns + 1) + 8) * dot;
    }
}

void drawDividingLine(RgbImage& image) {
    const std::int64_t middle = image.width / 2, half = std::max<std::int64_t>(1, image.width / 1024);
    fillRect(image, middle - 2 * half, 0, 4 * half, image.height, kInk);
    fillRect(image, middle - half, 0, 2 * half, image.height, {1, 1, 1});
}

}  // namespace tspace
