// SPDX-License-Identifier: MIT
// A cone of directions contains exactly the directions between the added ones.
#include <gtest/gtest.h>

#include "commands/check/direction_cones.h"
#include "commands/check/patch.h"

namespace tspace::test {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

TEST(DirectionCone, OfOneDirectionIsThatDirection) {
    std::vector<double> angles{1.0};
    const DirectionCone cone = coneAround(angles);
    EXPECT_NEAR(cone.distanceTo(1.0), 0, 1e-12);
    EXPECT_NEAR(cone.distanceTo(1.5), 0.5, 1e-12);
    EXPECT_NEAR(cone.distanceTo(0.5), 0.5, 1e-12);
    EXPECT_NEAR(cone.distanceTo(1.0 + kHalfTurn), kHalfTurn, 1e-12);
}

TEST(DirectionCone, UsesTheShorterArc) {
    std::vector<double> angles{3.0, -3.0};
    const DirectionCone cone = coneAround(angles);
    EXPECT_EQ(cone.distanceTo(kHalfTurn), 0);
    EXPECT_NEAR(cone.distanceTo(0), 3.0, 1e-12);
}

TEST(DirectionCone, IsEverythingWhereNoHalfTurnIsFree) {
    std::vector<double> opposite{0.0, kHalfTurn}, three{0.0, 2.0, -2.0};
    EXPECT_EQ(coneAround(opposite).distanceTo(1.2), 0);
    EXPECT_EQ(coneAround(three).distanceTo(-1.2), 0);
    EXPECT_TRUE(coneAround({}).empty());
}

TEST(DirectionCone, ContainsEveryWeightedMeanOfItsDirections) {
    EXPECT_TRUE(rc::check([] {
        const double middle = anyNumber(-3, 3);
        std::vector<double> angles;
        double x = 0, y = 0;
        for (int i = 0; i < anyInt(1, 6); ++i) {
            angles.push_back(middle + anyNumber(-1.5, 1.5));
            const double weight = anyNumber(0.01, 1);
            x += weight * std::cos(angles.back());
            y += weight * std::sin(angles.back());
        }
        RC_ASSERT(coneAround(angles).distanceTo(std::atan2(y, x)) < 1e-9);
    }));
}

TEST(DirectionDistances, EqualTheRotationOfATangent) {
    EXPECT_TRUE(rc::check([] {
        ScenePrimitive patch = goodPatch(Seam::turned);
        const double by = anyNumber(20, 120);
        std::vector<Vec4> tangents(patch.tangents.begin(), patch.tangents.end());
        for (std::size_t v = 0; v < tangents.size(); ++v) tangents[v] = turned(tangents[v], patch.normals[v], by);
        TangentView mesh = viewOf(patch);
        mesh.tangents = tangents;
        for (const float distance : directionDistances(mesh, describeSurface(mesh), 10)) {
            RC_ASSERT(std::fabs(distance - by) < 8);
        }
    }));
}

TEST(DirectionDistances, AreUndefinedWithoutADirection) {
    ScenePrimitive patch = goodPatch();
    edit(patch.uv_sets[0], [](auto& uvs) {
        for (Vec2& uv : uvs) uv = {0.5f, 0.5f};
    });
    const TangentView mesh = viewOf(patch);
    for (const float distance : directionDistances(mesh, describeSurface(mesh), 10))
        EXPECT_EQ(distance, kUnknownDirection);
}

TEST(DescribeSurface, SumsAreasToTheTotal) {
    const ScenePrimitive patch = goodPatch();
    const Surface surface = describeSurface(viewOf(patch));
    double sum = 0;
    for (const double area : surface.vertex_areas) sum += area;
    EXPECT_NEAR(sum, surface.area, 1e-9);
    EXPECT_GT(surface.area, 1);
    for (const SurfaceFrame& face : surface.faces) EXPECT_EQ(face.orientation, -1) << "v runs down";
}

}  // namespace
}  // namespace tspace::test
