// SPDX-License-Identifier: MIT
#include "core/base/vec_math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tspace {
namespace {

TEST(PolarAngle, AgreesWithLibmToTheStatedErrorAllTheWayRound) {
    double worst = 0;
    for (int i = 0; i <= 1'000'000; ++i) {
        const double angle = kPi * i / 1'000'000;
        const double radius = 1 + i % 7;
        const double x = radius * std::cos(angle), y = std::fabs(radius * std::sin(angle));
        worst = std::max(worst, std::fabs(polarAngle(x, y) - std::atan2(y, x)));
    }
    EXPECT_LT(worst, 1e-15);
}

TEST(PolarAngle, KeepsItsRelativeErrorForTinyAngles) {
    for (double y = 1; y > 1e-300; y *= 0.3) EXPECT_NEAR(polarAngle(1, y) / std::atan2(y, 1.0), 1, 4e-16);
}

TEST(PolarAngle, IsExactOnTheAxes) {
    EXPECT_EQ(polarAngle(0, 0), 0);
    EXPECT_EQ(polarAngle(3, 0), 0);
    EXPECT_EQ(polarAngle(0, 1e-200), kPi / 2);
    EXPECT_EQ(polarAngle(-1e200, 0), kPi);
}

TEST(AngleBetween, IsAccurateForAnglesTooSmallForTheCosine) {
    EXPECT_NEAR(angleBetween({1, 0, 0}, {1, 1e-12, 0}), 1e-12, 1e-20);
    EXPECT_NEAR(angleBetween({1, 0, 0}, {-1, 1e-12, 0}), kPi - 1e-12, 1e-15);
    EXPECT_EQ(angleBetween({0, 0, 0}, {1, 0, 0}), 0);
}

TEST(SineCosine, AgreesWithLibmToTheStatedError) {
    double worst = 0;
    for (int i = -1'000'000; i <= 1'000'000; ++i) {
        const double angle = i * 1e-4;
        const SineCosine made = sineCosine(angle);
        worst = std::max({worst, std::fabs(made.sine - std::sin(angle)), std::fabs(made.cosine - std::cos(angle))});
    }
    EXPECT_LT(worst, 1e-15);
}

TEST(SineCosine, StaysOnTheUnitCircleForEveryNumber) {
    for (double angle = 1; angle < 1e300; angle *= -3.7e5) {
        const SineCosine made = sineCosine(angle);
        EXPECT_NEAR(made.sine * made.sine + made.cosine * made.cosine, 1, 1e-15) << angle;
    }
    EXPECT_EQ(sineCosine(HUGE_VAL).cosine, 1);
    EXPECT_EQ(sineCosine(std::nan("")).sine, 0);
}

}  // namespace
}  // namespace tspace
