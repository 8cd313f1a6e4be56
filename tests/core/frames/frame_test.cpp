// SPDX-License-Identifier: MIT
#include "tspace/frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/random_values.h"

namespace tspace {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

void expectNear(const Vec3& a, const Vec3& b, double tolerance = 1e-6) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(FaceFrame, IsTheDerivativeOfPositionByUv) {
    const Vec3 positions[3] = {{1, 1, 1}, {3, 1, 1}, {1, 5, 1}};
    const Vec2 uvs[3] = {{0, 0}, {0.5f, 0}, {0, 2}};
    const FaceFrame frame = faceFrame(positions, uvs);
    EXPECT_EQ(frame.tangent, (Vec3{4, 0, 0}));
    EXPECT_EQ(frame.bitangent, (Vec3{0, 2, 0}));
    EXPECT_EQ(frame.determinant, 1);
}

TEST(FaceFrame, TakesTheMinusSignInTheTangent) {
    // u and v both increase along both edges, so that T would have another direction if t2 E1 - t1 E2 was computed with
    // a plus sign.
    const Vec3 positions[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const Vec2 uvs[3] = {{0, 0}, {1, 0.5f}, {0.5f, 1}};
    const FaceFrame frame = faceFrame(positions, uvs);
    expectNear(frame.tangent, {4.0f / 3, -2.0f / 3, 0});
    expectNear(frame.bitangent, {-2.0f / 3, 4.0f / 3, 0});
}

TEST(FaceFrame, IsZeroWithoutUvArea) {
    const Vec3 positions[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const Vec2 line[3] = {{0.1f, 0.1f}, {0.2f, 0.2f}, {0.4f, 0.4f}};
    const Vec2 broken[3] = {{0, 0}, {kNan, 0}, {0, 1}};
    const Vec2 endless[3] = {{0, 0}, {kInfinity, 0}, {0, 1}};
    for (const Vec2* uvs : {line, broken, endless}) {
        EXPECT_EQ(faceFrame(positions, uvs).tangent, Vec3{});
        EXPECT_EQ(faceFrame(positions, uvs).bitangent, Vec3{});
        EXPECT_EQ(faceFrameFromPath(positions, uvs).tangent, Vec3{});
    }
    EXPECT_EQ(faceFrame(positions, line).determinant, 0);
}

TEST(FaceFrame, DoesNotOverflowOnTheWay) {
    const Vec3 positions[3] = {{0, 0, 0}, {3e38f, 0, 0}, {0, 3e38f, 0}};
    const Vec2 uvs[3] = {{0, 0}, {8, 0}, {0, 8}};
    expectNear(faceFrame(positions, uvs).tangent, {3e38f / 8, 0, 0}, 1e31);
}

TEST(FrameSign, IsTheSignOfTheDeterminant) {
    EXPECT_EQ(frameSign({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 1);
    EXPECT_EQ(frameSign({{1, 0, 0}, {0, -1, 0}, {0, 0, 1}}), -1);
    EXPECT_EQ(frameSign({{1, 0, 0}, {2, 0, 0}, {0, 0, 1}}), 1);
    EXPECT_EQ(determinant({{2, 0, 0}, {0, -3, 0}, {0, 0, 4}}), -24);
}

TEST(FrameSign, DetectsFramesTooSmallForAFloatDeterminant) {
    EXPECT_EQ(frameSign({{1e-20f, 0, 0}, {0, -1e-20f, 0}, {0, 0, 1e-20f}}), -1);
}

TEST(Orthonormalize, RemovesTheNormalComponentOfT) {
    const Frame frame = orthonormalize({{1, 0, 1}, {0, 2, 3}, {0, 0, 4}});
    expectNear(frame.tangent, {1, 0, 0});
    expectNear(frame.bitangent, {0, 1, 0});
    expectNear(frame.normal, {0, 0, 1});
}

TEST(Orthonormalize, KeepsAMirroredFrameMirrored) {
    expectNear(orthonormalize({{1, 0.5f, 0}, {0, -1, 0}, {0, 0, 1}}).bitangent, {0.4472136f, -0.8944272f, 0});
}

TEST(Orthonormalize, ReplacesMissingVectors) {
    const Frame parallel = orthonormalize({{0, 0, 2}, {0, 1, 0}, {0, 0, 1}});
    expectNear(parallel.tangent, basisFromNormal({0, 0, 1}).tangent);
    const Frame no_bitangent = orthonormalize({{1, 0, 0}, {1, 0, 0}, {0, 0, 1}});
    expectNear(no_bitangent.bitangent, {0, 1, 0});
    const Frame no_normal = orthonormalize({{1, 0, 0}, {0, 1, 0}, {0, kNan, 0}});
    EXPECT_EQ(no_normal.normal, (Vec3{0, 0, 1}));
}

TEST(PackTangent, StoresTheSignOfTheOriginalFrame) {
    EXPECT_EQ(packTangent({{2, 0, 0}, {0, -3, 0}, {0, 0, 1}}), (Vec4{1, 0, 0, -1}));
}

TEST(RebuildBitangent, IsSignTimesNCrossT) {
    EXPECT_EQ(rebuildBitangent({0, 0, 1}, {1, 0, 0, 1}), (Vec3{0, 1, 0}));
    EXPECT_EQ(rebuildBitangent({0, 0, 1}, {1, 0, 0, -1}), (Vec3{0, -1, 0}));
}

TEST(BasisFromNormal, TreatsMinusZeroLikeZero) {
    const Frame up = basisFromNormal({1, 0, 0.0f});
    const Frame down = basisFromNormal({1, 0, -0.0f});
    EXPECT_EQ(up.tangent, down.tangent);
    EXPECT_EQ(up.bitangent, down.bitangent);
}

TEST(ObjectToTangent, RejectsSingularFramesAndWritesNothing) {
    Mat3 out{{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}};
    EXPECT_FALSE(objectToTangent({{1, 2, 3}, {2, 4, 6}, {0, 0, 1}}, out));
    EXPECT_FALSE(objectToTangent({{kNan, 2, 3}, {2, 4, 6}, {0, 0, 1}}, out));
    EXPECT_EQ(out.rows[1], (Vec3{4, 5, 6}));
    EXPECT_EQ(toTangentSpace({{1, 2, 3}, {2, 4, 6}, {0, 0, 1}}, {1, 1, 1}), Vec3{});
}

TEST(ObjectToTangent, IsTheGeneralInverseNotTheTranspose) {
    const Frame sheared{{2, 0, 0}, {1, 1, 0}, {0, 0, 1}};
    expectNear(toTangentSpace(sheared, {3, 1, 5}), {1, 1, 5});
    expectNear(toObjectSpace(sheared, {1, 1, 5}), {3, 1, 5});
}

TEST(DecodeNormal, MapsTheUnitCubeToDirections) {
    expectNear(decodeNormal({0.5f, 0.5f, 1}), {0, 0, 1});
    expectNear(decodeNormal({1, 0.5f, 0.5f}), {1, 0, 0});
    expectNear(decodeNormal({0.5f, 1, 0.5f}), {0, 1, 0});
    expectNear(decodeNormal({0.5f, 1, 0.5f}, {.green = Green::down}), {0, -1, 0});
}

TEST(DecodeNormal, ScalesXAndYOnly) {
    const double l = std::sqrt(0.5 * 0.5 + 0.5 * 0.5 + 1);
    expectNear(decodeNormal({1, 1, 1}, {.scale = 0.5f}),
               {static_cast<float>(0.5 / l), static_cast<float>(0.5 / l), static_cast<float>(1 / l)});
}

TEST(DecodeNormal, PointsOutOfTheSurfaceWhenThereIsNoLength) {
    EXPECT_EQ(decodeNormal({0.5f, 0.5f, 0.5f}), (Vec3{0, 0, 1}));
    EXPECT_EQ(decodeNormal({kNan, 0.5f, 0.5f}), (Vec3{0, 0, 1}));
}

TEST(TileUv, WrapsIntoTheUnitSquare) {
    EXPECT_EQ(tileUv({0.25f, 0.75f}, {2, 2}), (Vec2{0.5f, 0.5f}));
    EXPECT_EQ(tileUv({-0.25f, 1}, {1, 1}), (Vec2{0.75f, 0}));
    EXPECT_EQ(tileUv({0.5f, 0.5f}, {1, 1}, {0.75f, -0.75f}), (Vec2{0.25f, 0.75f}));
    EXPECT_EQ(tileUv({-1e-30f, 1e30f}, {1, 1}), (Vec2{0, 0}));
}

TEST(Lambert, IsTheCosineAgainstTheBentNormal) {
    const Frame frame{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
    EXPECT_FLOAT_EQ(lambert(frame, {0, 5, 0}, {0, 0, 1}), 1);
    EXPECT_FLOAT_EQ(lambert(frame, {0, 0, 5}, {1, 0, 0}), 1);
    EXPECT_FLOAT_EQ(lambert(frame, {0, 1, 1}, {0, 0, 1}), std::sqrt(0.5f));
    EXPECT_EQ(lambert(frame, {0, -1, 0}, {0, 0, 1}), 0);
    EXPECT_EQ(lambert(frame, {0, 0, 0}, {0, 0, 1}), 0);
}

TEST(ObjectNormalMikktspace, NormalizesOnlyTheResult) {
    // N has half the length, so the same texel tilts the result more than in the normalized frame.
    const Vec3 texel{0.6f, 0, 0.8f};
    const Vec3 bent = objectNormalMikktspace({0, 0, 0.5f}, {1, 0, 0, 1}, texel);
    expectNear(bent, {0.6f / std::hypot(0.6f, 0.4f), 0, 0.4f / std::hypot(0.6f, 0.4f)});
    expectNear(objectNormal({{1, 0, 0}, {0, 1, 0}, {0, 0, 0.5f}}, texel), texel);
}

TEST(ObjectNormalMikktspace, KeepsTheNormalWhenTheSumVanishes) {
    EXPECT_EQ(objectNormalMikktspace({0, 2, 0}, {1, 0, 0, 1}, {0, 0, 0}), (Vec3{0, 1, 0}));
    EXPECT_EQ(objectNormalMikktspace({0, 0, 0}, {0, 0, 0, 1}, {0, 0, 1}), (Vec3{0, 0, 1}));
}

}  // namespace
}  // namespace tspace
