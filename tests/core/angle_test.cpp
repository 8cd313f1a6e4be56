// SPDX-License-Identifier: MIT
#include "core/angle.h"

#include <gtest/gtest.h>

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

TEST(AngleBetween, SeesAnglesThatTheCosineCannot) {
    EXPECT_NEAR(angleBetween({1, 0, 0}, {1, 1e-12, 0}), 1e-12, 1e-20);
    EXPECT_NEAR(angleBetween({1, 0, 0}, {-1, 1e-12, 0}), kPi - 1e-12, 1e-15);
    EXPECT_EQ(angleBetween({0, 0, 0}, {1, 0, 0}), 0);
}

}  // namespace
}  // namespace tspace
