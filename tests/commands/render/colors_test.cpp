// SPDX-License-Identifier: MIT
// Conversion between linear light and the bytes of pictures.
#include "commands/shared/picture/colors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tspace::test {
namespace {

TEST(Colors, LightBecomesTheNearestByte) {
    constexpr int kSteps = 200000;
    for (int i = 0; i <= kSteps; ++i) {
        const float light = static_cast<float>(i) / kSteps;
        const double stored =
            light <= 0.0031308f ? 12.92 * light : 1.055 * std::pow(static_cast<double>(light), 1 / 2.4) - 0.055;
        ASSERT_NEAR(lightToSrgb(light), 255 * stored, 0.5001) << light;
    }
}

TEST(Colors, BytesComeBackFromTheirLight) {
    const std::vector<float> table = srgbTable(8);
    for (int byte = 0; byte < 256; ++byte) EXPECT_EQ(lightToSrgb(table[static_cast<std::size_t>(byte)]), byte);
}

TEST(Colors, InvalidLightIsBlackOrWhite) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(lightToSrgb(std::nanf("")), 0);
    EXPECT_EQ(lightToSrgb(-1), 0);
    EXPECT_EQ(lightToSrgb(-kInfinity), 0);
    EXPECT_EQ(lightToSrgb(1.5f), 255);
    EXPECT_EQ(lightToSrgb(kInfinity), 255);
}

}  // namespace
}  // namespace tspace::test
