// SPDX-License-Identifier: MIT
// The core's own cosine of the threshold compared with the C library's, rounded to float.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "core/tangents/mikktspace/groups.h"

namespace tspace {
namespace {

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
    const std::uint32_t most = std::bit_cast<std::uint32_t>(360.0f);
    for (std::uint32_t word = 0; word < most; word += 4093) {
        const float degrees = std::bit_cast<float>(word);
        ASSERT_EQ(mikk::thresholdCosine(degrees), expected(degrees)) << degrees;
    }
    EXPECT_TRUE(std::isnan(mikk::thresholdCosine(std::numeric_limits<float>::quiet_NaN())));
    for (const float wild : {1e38f, std::numeric_limits<float>::infinity()})
        EXPECT_TRUE(std::isnan(mikk::thresholdCosine(wild)));
}

}  // namespace
}  // namespace tspace
