// SPDX-License-Identifier: MIT
// The reference for shading, and sampling of textures.
#include "maps/texels/shading.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "maps/texels/texture_sample.h"
#include "tspace/frame.h"

namespace tspace::test {
namespace {

double partOf() { return *rc::gen::inRange(-1000, 1001) / 1000.0; }
Vec3 anyVector() { return {static_cast<float>(partOf()), static_cast<float>(partOf()), static_cast<float>(partOf())}; }

/// Returns frames like those of a coarse mesh: N is near z and T is near x, their lengths are arbitrary, and all
/// corners have one sign.
CornerFrames anyCorners() {
    CornerFrames corners;
    const float sign = *rc::gen::element(-1.0f, 1.0f);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 lean = anyVector(), turn = anyVector();
        corners.normals[i] = {0.4f * lean.x, 0.4f * lean.y, 1 + 0.3f * lean.z};
        corners.tangents[i] = {1 + 0.3f * turn.x, 0.4f * turn.y, 0.4f * turn.z, sign};
    }
    return corners;
}

MapReading anyReading() {
    return {*rc::gen::element(Green::up, Green::down),
            *rc::gen::element(BitangentPlace::perPixel, BitangentPlace::perVertex), *rc::gen::arbitrary<bool>(),
            *rc::gen::arbitrary<bool>(), *rc::gen::element(1.0f, 0.5f)};
}

std::array<double, 3> anyWeights() {
    const double a = *rc::gen::inRange(0, 1001) / 1000.0, b = (1 - a) * (*rc::gen::inRange(0, 1001) / 1000.0);
    return {a, b, 1 - a - b};
}

TEST(Shading, AgreesWithTheFunctionOfOneFrame) {
    EXPECT_TRUE(rc::check([] {
        const CornerFrames corners = anyCorners();
        const Vec3 texel = anyVector();
        const DVec3 normal = shadedNormal(shadingFrame(corners, {1, 0, 0}, {}), toDouble(texel));
        const Vec3 expected = objectNormalMikktspace(corners.normals[0], corners.tangents[0], texel);
        RC_PRE(length(normal) > 0.5);
        RC_ASSERT(degreesBetween(normal, toDouble(expected)) < 1e-3);
    }));
}

TEST(Shading, EncodedTexelsGiveTheWantedNormal) {
    EXPECT_TRUE(rc::check([] {
        MapReading reading = anyReading();
        if (reading.two_channels) reading.scale = 1;
        const ShadingFrame frame = shadingFrame(anyCorners(), anyWeights(), reading);
        const Vec3 any = anyVector();
        const DVec3 wanted = shadedNormal(frame, {any.x, any.y, 0.3 + std::abs(any.z)});
        const DVec3 texel = encodeTexel(vectorFor(frame, wanted), reading);
        RC_ASSERT(degreesBetween(shadedNormal(frame, decodeTexel(toFloat(texel), reading)), wanted) < 1e-3);
    }));
}

TEST(Shading, InvertedGreenIsOneMinusGreen) {
    EXPECT_TRUE(rc::check([] {
        const DVec3 vector = toDouble(anyVector());
        const DVec3 up = encodeTexel(vector, {}), down = encodeTexel(vector, {.green = Green::down});
        RC_ASSERT(up.x == down.x && up.z == down.z && std::abs(up.y + down.y - 1) < 1e-15);
    }));
}

TEST(Shading, BitangentPerVertexIsAnotherNormalOnCoarseMeshesOnly) {
    const CornerFrames coarse{{Vec3{-0.5f, 0, 1}, Vec3{0.5f, 0.3f, 1}, Vec3{0, 0.5f, 1}},
                              {Vec4{1, 0, 0.5f, 1}, Vec4{1, 0, -0.5f, 1}, Vec4{0.8f, 0.6f, 0, 1}}};
    CornerFrames flat = coarse;
    flat.normals = {coarse.normals[0], coarse.normals[0], coarse.normals[0]};
    flat.tangents = {coarse.tangents[0], coarse.tangents[0], coarse.tangents[0]};
    const DVec3 vector{0.4, 0.5, 0.7};
    const auto differ = [&](const CornerFrames& corners) {
        const std::array<double, 3> middle{1.0 / 3, 1.0 / 3, 1.0 / 3};
        return degreesBetween(
            shadedNormal(shadingFrame(corners, middle, {}), vector),
            shadedNormal(shadingFrame(corners, middle, {.bitangent = BitangentPlace::perVertex}), vector));
    };
    EXPECT_GT(differ(coarse), 0.5);
    EXPECT_LT(differ(flat), 1e-6);
}

TEST(Shading, FramesWithoutVolumeHaveNoVector) {
    const ShadingFrame flat{{1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    EXPECT_EQ(length(vectorFor(flat, {0, 0, 1})), 0);
    EXPECT_EQ(length(shadedNormal({}, {0, 0, 1})), 0);
}

TEST(MapReading, NamesAreThoseOfConventionsAndThree) {
    for (const char* name : {"gltf", "opengl", "directx", "unreal", "unity", "blender", "godot"}) {
        ASSERT_NE(findMapReading(name), nullptr) << name;
        EXPECT_EQ(findMapReading(name)->green, findConvention(name)->green) << name;
    }
    EXPECT_NE(findMapReading("three"), nullptr);
    EXPECT_EQ(findMapReading("quake"), nullptr);
    EXPECT_EQ(findMapReading(nullptr), nullptr);
}

TEST(BilinearTaps, TexelCentersReadTheTexel) {
    const TextureShape shape{4, 2};
    for (std::uint32_t y = 0; y < 2; ++y) {
        for (std::uint32_t x = 0; x < 4; ++x) {
            const Vec2 uv{(static_cast<float>(x) + 0.5f) / 4, (static_cast<float>(y) + 0.5f) / 2};
            const BilinearTaps taps = bilinearTaps(shape, uv);
            EXPECT_EQ(taps.texels[0], y * 4 + x);
            EXPECT_EQ(taps.weights[0], 1);
        }
    }
}

TEST(BilinearTaps, TheWrapModeDeterminesTexelsBeyondTheImage) {
    const auto left = [](TextureWrap wrap, std::int64_t at) { return wrappedTexel(at, 4, wrap); };
    EXPECT_EQ(left(TextureWrap::repeat, -1), 3u);
    EXPECT_EQ(left(TextureWrap::repeat, 9), 1u);
    EXPECT_EQ(left(TextureWrap::clamp, -7), 0u);
    EXPECT_EQ(left(TextureWrap::clamp, 7), 3u);
    EXPECT_EQ(left(TextureWrap::mirror, -1), 0u);
    EXPECT_EQ(left(TextureWrap::mirror, 4), 3u);
    EXPECT_EQ(left(TextureWrap::mirror, 7), 0u);
    EXPECT_EQ(left(TextureWrap::mirror, 8), 0u);
}

TEST(BilinearTaps, AnyUvReadsTexelsOfTheImage) {
    EXPECT_TRUE(rc::check([](float u, float v) {
        for (const TextureWrap wrap : {TextureWrap::repeat, TextureWrap::mirror, TextureWrap::clamp}) {
            const BilinearTaps taps = bilinearTaps({3, 5, wrap, wrap}, {u, v});
            float sum = 0;
            for (std::size_t i = 0; i < 4; ++i) {
                RC_ASSERT(taps.texels[i] < 15u);
                sum += taps.weights[i];
            }
            RC_ASSERT(std::abs(sum - 1) < 1e-6f);
        }
    }));
    EXPECT_EQ(bilinearTaps({3, 5}, {std::nanf(""), 1e30f}).weights[0], 1);
}

}  // namespace
}  // namespace tspace::test
