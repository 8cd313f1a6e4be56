// SPDX-License-Identifier: MIT
// The core's own arc cosine and cosine against the C library's, rounded to float.
#include "core/acos.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "tangents/mikktspace/splits.h"

namespace tspace {
namespace {

TEST(ArcCosine, EqualsTheRoundedDoubleFunction) {
    const std::uint32_t one = std::bit_cast<std::uint32_t>(1.0f);
    for (std::uint32_t word = 0; word <= one; word += word < 0x30000000 ? 99991 : 641) {
        for (const float c : {std::bit_cast<float>(word), -std::bit_cast<float>(word),
                              std::bit_cast<float>(one - word / 4096)}) {
            ASSERT_EQ(arcCosine(c), static_cast<float>(std::acos(static_cast<double>(c)))) << c;
        }
    }
}

TEST(ArcCosine, KnowsItsEnds) {
    EXPECT_EQ(arcCosine(1.0f), 0.0f);
    EXPECT_EQ(arcCosine(-1.0f), 3.14159274f);
    EXPECT_EQ(arcCosine(0.0f), 1.57079637f);
    EXPECT_EQ(arcCosine(0.5f), static_cast<float>(std::acos(0.5)));
    EXPECT_TRUE(std::isnan(arcCosine(std::numeric_limits<float>::quiet_NaN())));
    EXPECT_TRUE(std::isnan(arcCosine(1.5f)));
}

TEST(ThresholdCosine, EqualsTheRoundedDoubleFunction) {
    const auto expected = [](float degrees) {
        return static_cast<float>(std::cos(static_cast<double>((degrees * 3.14159274f) / 180.0f)));
    };
    EXPECT_EQ(mikk::thresholdCosine(180.0f), -1.0f);
    EXPECT_EQ(mikk::thresholdCosine(0.0f), 1.0f);
    for (int i = 0; i <= 36000; ++i) {
        const float degrees = 0.01f * static_cast<float>(i);
        ASSERT_EQ(mikk::thresholdCosine(degrees), expected(degrees)) << degrees;
        ASSERT_EQ(mikk::thresholdCosine(-degrees), expected(degrees)) << degrees;
    }
    const std::uint32_t most = std::bit_cast<std::uint32_t>(1e38f);
    for (std::uint32_t word = 0; word < most; word += 65521) {
        const float degrees = std::bit_cast<float>(word);
        ASSERT_EQ(mikk::thresholdCosine(degrees), expected(degrees)) << degrees;
    }
    EXPECT_TRUE(std::isnan(mikk::thresholdCosine(std::numeric_limits<float>::quiet_NaN())));
    EXPECT_TRUE(std::isnan(mikk::thresholdCosine(std::numeric_limits<float>::infinity())));
}

}  // namespace
}  // namespace tspace
