// SPDX-License-Identifier: MIT
#include "commands/shared/picture/colors.h"

#include <algorithm>
#include <limits>

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

}  // namespace tspace
