// SPDX-License-Identifier: MIT
// Which way green points, and images that must not be trusted.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "check/images.h"
#include "check/normal_map.h"

namespace tspace::test {
namespace {

std::optional<RgbImage> decode(const std::string& file, std::uint64_t most_pixels = 1 << 22) {
    std::string why;
    return decodeImage(bytesOf(file), most_pixels, why);
}

std::string whyNot(const std::string& file, std::uint64_t most_pixels = 1 << 22) {
    std::string why;
    return decodeImage(bytesOf(file), most_pixels, why) ? "" : why;
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
    rc::check([] {
        const double a = *rc::gen::inRange(5, 60), b = *rc::gen::inRange(5, 60), c = *rc::gen::inRange(-30, 30);
        const auto height = [&](double x, double y) { return 0.3 / a * std::sin(a * x + c * y) * std::cos(b * y); };
        const GreenTest up = testGreen(normalMapOf(128, height)), down = testGreen(normalMapOf(128, height, true));
        RC_ASSERT(up.verdict != GreenVerdict::down);
        RC_ASSERT(down.verdict != GreenVerdict::up);
        RC_ASSERT(up.block_count == down.block_count);
        RC_ASSERT(std::fabs(up.correlation + down.correlation) < 0.02);
    });
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
    // Blue below the middle stands for normals that point into the surface.
    RgbImage picture = normalMapOf(256, bumps, true);
    for (std::size_t i = 2; i < picture.rgb.size(); i += 3) picture.rgb[i] = 60;
    EXPECT_EQ(testGreen(picture).verdict, GreenVerdict::unknown);
}

TEST(GreenTest, SeesThroughJpeg) {
    for (const int quality : {95, 75}) {
        const std::optional<RgbImage> image = decode(jpegFile(normalMapOf(256, bumps, true), quality));
        ASSERT_TRUE(image);
        EXPECT_EQ(testGreen(*image).verdict, GreenVerdict::down) << quality;
    }
}

TEST(DecodeImage, GivesThePixelsOfAPng) {
    const RgbImage image = normalMapOf(33, bumps);
    const std::optional<RgbImage> decoded = decode(pngFile(image));
    ASSERT_TRUE(decoded);
    EXPECT_EQ(decoded->width, 33u);
    EXPECT_EQ(decoded->rgb, image.rgb);
}

TEST(DecodeImage, SaysWhyItDoesNotLook) {
    const std::string png = pngFile(normalMapOf(64, bumps)), jpeg = jpegFile(normalMapOf(64, bumps), 90);
    EXPECT_EQ(whyNot(png), "");
    EXPECT_EQ(whyNot(png, 1000), "it has more pixels than are looked at");
    EXPECT_EQ(whyNot(jpeg, 1000), "it has more pixels than are looked at");
    EXPECT_EQ(whyNot("RIFF????WEBP"), "it is neither PNG nor JPEG");
    EXPECT_EQ(whyNot(""), "it is neither PNG nor JPEG");
    EXPECT_EQ(whyNot(png.substr(0, png.size() / 2)), "it is a broken PNG");
    EXPECT_EQ(whyNot(jpeg.substr(0, 10)), "it is a broken JPEG");
}

TEST(DecodeImage, RefusesAFewBytesThatClaimManyPixels) {
    std::string png = pngFile(normalMapOf(64, bumps));
    // Width and height of the header, which then has a wrong checksum; either reason will do.
    png[18] = png[22] = 0x20;
    EXPECT_NE(whyNot(png, std::uint64_t{1} << 40), "");
    std::string jpeg = jpegFile(normalMapOf(64, bumps), 90);
    const std::size_t frame = jpeg.find("\xff\xc0");
    ASSERT_NE(frame, std::string::npos);
    jpeg[frame + 5] = jpeg[frame + 7] = 0x60;
    EXPECT_EQ(whyNot(jpeg, std::uint64_t{1} << 40), "it claims far more pixels than its bytes can hold");
}

/// A table of codes has 256 at most; its 16 counts may say 4080.
TEST(DecodeImage, RefusesAJpegWhoseTableHasTooManyCodes) {
    std::string jpeg = jpegFile(normalMapOf(64, bumps), 90);
    const std::size_t table = jpeg.find("\xff\xc4");
    ASSERT_NE(table, std::string::npos);
    constexpr std::size_t kCountsAt = 5, kCountsFrom9 = 8;  // 255 each of 9 to 16 bits are codes that there can be
    std::fill_n(jpeg.begin() + static_cast<std::ptrdiff_t>(table + kCountsAt + kCountsFrom9), 8, '\xff');
    EXPECT_EQ(whyNot(jpeg), "it is a broken JPEG");
}

TEST(DecodeImage, SurvivesBrokenFiles) {
    const std::string files[] = {pngFile(normalMapOf(24, bumps)), jpegFile(normalMapOf(24, bumps), 80)};
    rc::check([&] {
        std::string file = files[*rc::gen::inRange(0, 2)];
        for (int i = 0; i < *rc::gen::inRange(1, 5); ++i) {
            file[*rc::gen::inRange<std::size_t>(3, file.size())] = *rc::gen::arbitrary<char>();
        }
        const std::optional<RgbImage> image = decode(file, 1 << 16);
        if (image) RC_ASSERT(image->rgb.size() == std::size_t{3} * image->width * image->height);
    });
}

}  // namespace
}  // namespace tspace::test
