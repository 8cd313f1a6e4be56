// SPDX-License-Identifier: MIT

#include "commands/shared/picture/colors.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace tspace {
namespace {

/// Returns a^(1/5) for 0 < a <= 1, by Newton's method.
double fifthRoot(double a) {
    double root = 1;
    for (int i = 0; i < 64; ++i) root = (4 * root + a / (root * root * root * root)) / 5;
    return root;
}

/// Table for the conversion of linear light to sRGB bytes: the thresholds between consecutive bytes, and, to reduce
/// comparisons, the byte of the darkest light of each of kSteps intervals.
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
    // x^2.4 is computed as x^2 (x^2)^(1/5).
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

void fillRect(RgbImage& image, std::int64_t left, std::int64_t top, std::int64_t width, std::int64_t height,
              const Vec3& color) {
    const std::int64_t right = std::min<std::int64_t>(left + width, image.width),
                       bottom = std::min<std::int64_t>(top + height, image.height);
    for (std::int64_t y = std::max<std::int64_t>(0, top); y < bottom; ++y) {
        for (std::int64_t x = std::max<std::int64_t>(0, left); x < right; ++x) {
            std::uint8_t* pixel =
                image.rgb.data() + 3 * (static_cast<std::size_t>(y) * image.width + static_cast<std::size_t>(x));
            pixel[0] = roundedChannel(color.x);
            pixel[1] = roundedChannel(color.y);
            pixel[2] = roundedChannel(color.z);
        }
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
    fillRect(image, left, top, right - left, 1, kPictureInk);
    fillRect(image, left, bottom, right - left + 1, 1, kPictureInk);
    fillRect(image, left, top, 1, bottom - top, kPictureInk);
    fillRect(image, right, top, 1, bottom - top, kPictureInk);
}

void drawDividingLine(RgbImage& image) {
    const std::int64_t middle = image.width / 2, half = std::max<std::int64_t>(1, image.width / 1024);
    fillRect(image, middle - 2 * half, 0, 4 * half, image.height, kPictureInk);
    fillRect(image, middle - half, 0, 2 * half, image.height, {1, 1, 1});
}

}  // namespace tspace
