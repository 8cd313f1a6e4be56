// SPDX-License-Identifier: MIT
// Direction of green, in a whole map and in parts of it.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

#include "commands/check/normal_map.h"
#include "images/image.h"
#include "images/images.h"

namespace tspace::test {
namespace {

std::optional<RgbImage> decode(const std::string& file, std::uint64_t most_pixels = 1 << 22) {
    std::string why;
    return decodeImage(bytesOf(file), most_pixels, why);
}

GreenTest testGreen(const RgbImage& image) {
    TexelMask all(image.width, image.height);
    all.fillAll();
    return GreenBlocks(image, all).all();
}

/// Inverts green within a rectangle.
void flip(RgbImage& image, const TexelRect& rect) {
    for (std::size_t y = rect.top; y < rect.bottom; ++y) {
        for (std::size_t x = rect.left; x < rect.right; ++x) image.rgb[3 * (y * image.width + x) + 1] ^= 0xff;
    }
}

TEST(GreenTest, TellsUpFromDown) {
    for (const bool down : {false, true}) {
        const GreenTest test = testGreen(normalMapOf(256, bumps, down));
        EXPECT_EQ(test.verdict, down ? GreenVerdict::down : GreenVerdict::up);
        EXPECT_GT(test.confidence(), 0.9);
        EXPECT_GT(std::fabs(test.correlation), 0.9);
    }
}

TEST(GreenTest, IsTheOppositeForAFlippedGreenChannel) {
    EXPECT_TRUE(rc::check([] {
        const double a = *rc::gen::inRange(5, 60), b = *rc::gen::inRange(5, 60), c = *rc::gen::inRange(-30, 30);
        const auto height = [&](double x, double y) { return 0.3 / a * std::sin(a * x + c * y) * std::cos(b * y); };
        const GreenTest up = testGreen(normalMapOf(128, height)), down = testGreen(normalMapOf(128, height, true));
        RC_ASSERT(up.verdict != GreenVerdict::down);
        RC_ASSERT(down.verdict != GreenVerdict::up);
        RC_ASSERT(up.block_count == down.block_count);
        RC_ASSERT(std::fabs(up.correlation + down.correlation) < 0.02);
    }));
}

TEST(GreenTest, GivesNoVerdictOnFlatMapsAndStripes) {
    const auto flat = [](double, double) { return 0.0; };
    const auto stripes = [](double x, double) { return 0.02 * std::sin(40 * x); };
    EXPECT_EQ(testGreen(normalMapOf(256, flat)).verdict, GreenVerdict::unknown);
    EXPECT_EQ(testGreen(normalMapOf(256, stripes, true)).verdict, GreenVerdict::unknown);
    EXPECT_EQ(testGreen(normalMapOf(1, flat)).verdict, GreenVerdict::unknown);
    EXPECT_EQ(testGreen({}).verdict, GreenVerdict::unknown);
}

TEST(GreenTest, GivesNoVerdictOnNoise) {
    RgbImage noise{256, 256, {}};
    std::uint32_t state = 1;
    for (std::size_t i = 0; i < std::size_t{256} * 256; ++i) {
        for (int channel = 0; channel < 2; ++channel) {
            state = state * 1664525 + 1013904223;
            noise.rgb.push_back(static_cast<std::uint8_t>(64 + (state >> 25)));
        }
        noise.rgb.push_back(230);
    }
    EXPECT_EQ(testGreen(noise).verdict, GreenVerdict::unknown);
}

TEST(GreenTest, GivesNoVerdictOnAColorImage) {
    // Blue below the middle would represent normals that point into the surface.
    RgbImage picture = normalMapOf(256, bumps, true);
    for (std::size_t i = 2; i < picture.rgb.size(); i += 3) picture.rgb[i] = 60;
    EXPECT_EQ(testGreen(picture).verdict, GreenVerdict::unknown);
}

TEST(GreenTest, WorksOnJpeg) {
    for (const int quality : {95, 75}) {
        const std::optional<RgbImage> image = decode(jpegFile(normalMapOf(256, bumps, true), quality));
        ASSERT_TRUE(image);
        EXPECT_EQ(testGreen(*image).verdict, GreenVerdict::down) << quality;
    }
}

TEST(GreenTest, WorksOnNoiseThatAveragingRemoves) {
    // The noise is so strong that single texels have a correlation of 0.05, and means of four texels one of 0.45.
    for (const bool down : {false, true}) {
        RgbImage map = normalMapOf(512, bumps, down);
        std::uint32_t state = 7;
        for (std::size_t i = 0; i < map.rgb.size(); ++i) {
            if (i % 3 == 2) continue;
            state = state * 1664525 + 1013904223;
            map.rgb[i] = static_cast<std::uint8_t>(
                std::clamp(static_cast<int>(map.rgb[i]) + static_cast<int>(state >> 26) - 32, 0, 255));
        }
        EXPECT_EQ(testGreen(map).verdict, down ? GreenVerdict::down : GreenVerdict::up);
        EXPECT_GT(std::fabs(testGreen(map).correlation), 0.3);
    }
}

TEST(GreenTest, ReadsOnlyTexelsInsideTheMask) {
    // Invert a part of the map, like padding whose green differs from that of the islands.
    RgbImage map = normalMapOf(256, bumps);
    flip(map, {0, 0, 256, 160});
    TexelMask lower(256, 256), upper = lower;
    for (std::uint32_t y = 0; y < 256; ++y) (y < 160 ? upper : lower).fill(y, 0, 256);
    EXPECT_EQ(GreenBlocks(map, lower).all().verdict, GreenVerdict::up);
    EXPECT_EQ(GreenBlocks(map, upper).all().verdict, GreenVerdict::down);
    EXPECT_EQ(GreenBlocks(map, TexelMask(256, 256)).all().verdict, GreenVerdict::unknown);
}

TEST(GreenTest, LocatesGreenDownInAMixedMap) {
    RgbImage map = normalMapOf(512, bumps);
    const TexelRect down{64, 128, 288, 352};
    flip(map, down);
    const GreenTest test = testGreen(map);
    ASSERT_EQ(test.verdict, GreenVerdict::mixed);
    EXPECT_NEAR(test.down_part.left, down.left, 32);
    EXPECT_NEAR(test.down_part.right, down.right, 32);
    EXPECT_NEAR(test.down_part.top, down.top, 32);
    EXPECT_NEAR(test.down_part.bottom, down.bottom, 32);
    EXPECT_GT(test.up_part_blocks, test.down_part_blocks);
    EXPECT_GT(test.confidence(), 0.5);
}

TEST(GreenTest, DistinguishesThePartsOfAMixedMap) {
    RgbImage map = normalMapOf(512, bumps);
    flip(map, {0, 0, 256, 512});
    TexelMask all(512, 512), left = all, right = all, corner = all;
    all.fillAll();
    for (std::uint32_t y = 0; y < 512; ++y) {
        left.fill(y, 0, 256);
        right.fill(y, 256, 512);
    }
    for (std::uint32_t y = 0; y < 16; ++y) corner.fill(y, 0, 16);
    const GreenBlocks blocks(map, all);
    EXPECT_EQ(blocks.all().verdict, GreenVerdict::mixed);
    EXPECT_EQ(blocks.within(left).verdict, GreenVerdict::down);
    EXPECT_EQ(blocks.within(right).verdict, GreenVerdict::up);
    EXPECT_EQ(blocks.within(all).verdict, GreenVerdict::mixed);
    EXPECT_EQ(blocks.within(corner).verdict, GreenVerdict::unknown) << "one block, in a map that is not one way";
    const GreenBlocks one_way(normalMapOf(512, bumps), all);
    EXPECT_EQ(one_way.within(corner).verdict, GreenVerdict::up) << "one block, in a map that is";
}

TEST(GreenTest, DoesNotDependOnTheRotationOfIslands) {
    // A map that is rotated as a whole, including its normals: bakers write such maps for a rotated island.
    const auto turned = [](double x, double y) { return bumps(y, 1 - x); };
    const auto mirrored = [](double x, double y) { return bumps(1 - x, y); };
    EXPECT_EQ(testGreen(normalMapOf(256, turned)).verdict, GreenVerdict::up);
    EXPECT_EQ(testGreen(normalMapOf(256, mirrored)).verdict, GreenVerdict::up);
    EXPECT_EQ(testGreen(normalMapOf(256, mirrored, true)).verdict, GreenVerdict::down);
}

}  // namespace
}  // namespace tspace::test
