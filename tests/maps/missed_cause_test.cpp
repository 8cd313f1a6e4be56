// SPDX-License-Identifier: MIT
// Causes of missing hits: each cause is created in turn, and must be found.
#include "maps/rays/missed_cause.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <regex>

#include "bake_cases.h"
#include "maps/rays/rays.h"

namespace tspace::test {
namespace {

using bench::HighMesh;
using bench::LowMesh;

class MissedCause : public testing::Test {
  protected:
    void SetUp() override {
        Parallel parallel({});
        const auto rays = RaySurface::make(high_.view().positions, high_.corners, {}, parallel);
        if (!rays) GTEST_SKIP() << rays.error().message;
        // Larger along one axis, so that no rotation is accidentally its own inverse.
        for (Vec3& at : low_.positions) at.x *= 2;
        for (Vec3& normal : low_.normals) normal.x /= 2;
        for (Vec3& at : high_.positions) at.x *= 2;
    }
    static const accuracy::Surface& saddle() {
        for (const accuracy::Surface& surface : accuracy::surfaces()) {
            if (std::strcmp(surface.name, "saddle") == 0) return surface;
        }
        return accuracy::surfaces().front();
    }
    template <class Change>
    [[nodiscard]] HighMesh changed(const Change& change) const {
        HighMesh mesh = high_;
        for (Vec3& at : mesh.positions) at = change(at);
        return mesh;
    }
    [[nodiscard]] std::string causeOf(const HighMesh& high, double reach = 0.05) const {
        Parallel parallel({.thread_count = 2});
        const auto surface = RaySurface::make(high.view().positions, high.corners, {}, parallel);
        return surface ? causeOfMisses(low_.view(), high.view(), **surface, reach) : surface.error().message;
    }
    [[nodiscard]] std::string likelyPlacement(const HighMesh& high) const {
        Parallel parallel({.thread_count = 2});
        const auto surface = RaySurface::make(high.view().positions, high.corners, {}, parallel);
        return surface ? likelyPlacementOf(low_.view(), high.view(), **surface) : surface.error().message;
    }
    LowMesh low_ = bench::makeLow(saddle(), bench::Charts::one);
    HighMesh high_ = bench::makeHigh(saddle(), 64, false);
};

/// Returns a point rotated counter-clockwise about an axis, as the messages describe rotations.
Vec3 turned(const Vec3& at, int degrees, char axis) {
    const auto quarter = [&](const Vec3& v) {
        return axis == 'x' ? Vec3{v.x, -v.z, v.y} : axis == 'y' ? Vec3{v.z, v.y, -v.x} : Vec3{-v.y, v.x, v.z};
    };
    Vec3 result = at;
    for (int i = 0; i < (degrees + 360) / 90 % 4; ++i) result = quarter(result);
    return result;
}

TEST_F(MissedCause, TheReportedRotationRestoresTheHighPoly) {
    int found = 0;
    for (const int first : {0, 90, 180, -90}) {
        for (const char second_axis : {'y', 'z'}) {
            for (const int second : {0, 90, 180, -90}) {
                const auto move = [&](const Vec3& at) { return turned(turned(at, first, 'x'), second, second_axis); };
                const std::string cause = causeOf(changed(move));
                if (cause.find("rotate it") == std::string::npos) continue;
                ++found;
                std::vector<std::pair<int, char>> steps;
                const std::regex step("by (-?[0-9]+) degrees about ([xyz])");
                for (std::sregex_iterator at(cause.begin(), cause.end(), step), end; at != end; ++at)
                    steps.emplace_back(std::stoi((*at)[1]), (*at)[2].str()[0]);
                ASSERT_FALSE(steps.empty()) << cause;
                // A saddle is symmetric under a rotation by 180 degrees about the vertical axis, so x and y may have
                // either sign.
                const Vec3 probe = low_.positions[7];
                Vec3 back = move(probe);
                for (const auto& [degrees, axis] : steps) back = turned(back, degrees, axis);
                EXPECT_NEAR(std::fabs(back.x), std::fabs(probe.x), 1e-5) << cause;
                EXPECT_NEAR(std::fabs(back.y), std::fabs(probe.y), 1e-5) << cause;
                EXPECT_NEAR(back.z, probe.z, 1e-5) << cause;
            }
        }
    }
    EXPECT_GT(found, 12);
}

TEST_F(MissedCause, ReportsDifferentUnits) {
    const std::string cause = causeOf(changed([](const Vec3& at) { return 100.0F * at; }));
    EXPECT_NE(cause.find("scale it by 0.01 "), std::string::npos) << cause;
    const std::string both = causeOf(changed([](const Vec3& at) { return 2.54F * turned(at, 90, 'x'); }));
    EXPECT_NE(both.find("rotate it by -90 degrees about x and scale it by 0.394 "), std::string::npos) << both;
}

TEST_F(MissedCause, ReportsFacesThatPointInward) {
    HighMesh turned_over = high_;
    for (std::size_t i = 0; i < turned_over.corners.size(); i += 3)
        std::swap(turned_over.corners[i], turned_over.corners[i + 1]);
    EXPECT_NE(causeOf(turned_over).find("faces point inward"), std::string::npos) << causeOf(turned_over);
}

TEST_F(MissedCause, ReportsAReachThatIsTooShort) {
    const HighMesh lifted = changed([](const Vec3& at) { return Vec3{at.x, at.y, at.z + 0.1F}; });
    const std::string cause = causeOf(lifted, 0.01);
    EXPECT_NE(cause.find("--reach"), std::string::npos) << cause;
}

TEST_F(MissedCause, ReportsNothingIfNothingHelps) {
    HighMesh scrap = high_;
    scrap.corners.resize(60);
    EXPECT_EQ(causeOf(scrap), "");
    EXPECT_EQ(likelyPlacement(scrap), "");
    EXPECT_EQ(likelyPlacement(high_), "") << "it lies where it should";
}

}  // namespace
}  // namespace tspace::test
