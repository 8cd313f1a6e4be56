// SPDX-License-Identifier: MIT
// Images as floats, read from and written to files.
#include "images/float_image.h"
#include "images/image.h"

#include <gtest/gtest.h>

#include "images/images.h"

namespace tspace::test {
namespace {

FloatImage everyNumber(unsigned bits) {
    const unsigned largest = (1u << bits) - 1;
    FloatImage image{256, bits == 8 ? 1u : 256u, bits, {}, {}};
    for (unsigned n = 0; n < image.width * image.height; ++n) {
        const auto part = static_cast<float>(n) / static_cast<float>(largest);
        image.texels.push_back({part, 1 - part, static_cast<float>(n / 2) / static_cast<float>(largest)});
    }
    return image;
}

std::optional<FloatImage> decode(const std::vector<std::uint8_t>& bytes) {
    std::string why;
    return decodeFloatImage(bytes, 1 << 22, why);
}

TEST(FloatImage, EveryIntegerRoundTripsThroughPng) {
    for (const unsigned bits : {8u, 16u}) {
        const FloatImage image = everyNumber(bits);
        const auto file = encodePng(image, bits);
        ASSERT_TRUE(file);
        const auto decoded = decode(*file);
        ASSERT_TRUE(decoded);
        EXPECT_EQ(decoded->bits, bits);
        EXPECT_TRUE(decoded->alpha.empty());
        EXPECT_EQ(*encodePng(*decoded, bits), *file);
        const auto largest = static_cast<float>((1u << bits) - 1);
        for (std::size_t n = 0; n < image.texels.size(); ++n) {
            ASSERT_EQ(std::lround(decoded->texels[n].x * largest), static_cast<long>(n));
            ASSERT_EQ(std::lround((1 - decoded->texels[n].x) * largest), std::lround(largest) - static_cast<long>(n));
        }
    }
}

TEST(FloatImage, KeepsAlpha) {
    FloatImage image = everyNumber(16);
    for (const Vec3& texel : image.texels) image.alpha.push_back(texel.y);
    const auto decoded = decode(*encodePng(image, 16));
    ASSERT_TRUE(decoded);
    ASSERT_EQ(decoded->alpha.size(), image.alpha.size());
    for (std::size_t n = 0; n < image.alpha.size(); ++n) ASSERT_EQ(decoded->alpha[n], decoded->texels[n].y);
}

TEST(FloatImage, ClampsAndRoundsToTheNearest) {
    FloatImage image{2, 1, 8, {{-1, 2, std::nanf("")}, {0.49f / 255, 0.51f / 255, 254.51f / 255}}, {}};
    const auto decoded = decode(*encodePng(image, 8));
    ASSERT_TRUE(decoded);
    EXPECT_EQ(decoded->texels[0], (Vec3{0, 1, 0}));
    EXPECT_EQ(decoded->texels[1], (Vec3{0, 1.0f / 255, 1}));
}

TEST(FloatImage, DoesNotConvertColors) {
    const auto file = encodePng(everyNumber(8), 8);
    const std::string text(file->begin(), file->end());
    for (const char* chunk : {"gAMA", "sRGB", "iCCP", "cHRM"}) EXPECT_EQ(text.find(chunk), std::string::npos) << chunk;
}

TEST(FloatImage, HasTheNumbersOfTheOtherDecoder) {
    const RgbImage map = normalMapOf(33, bumps);
    for (const std::string& file : {pngFile(map), jpegFile(map, 90), webpFile(map, true)}) {
        std::string why;
        const auto bytes = decodeImage(bytesOf(file), 1 << 22, why);
        const auto floats = decodeFloatImage(bytesOf(file), 1 << 22, why);
        ASSERT_TRUE(bytes && floats);
        EXPECT_EQ(floats->bits, 8u);
        for (std::size_t i = 0; i < floats->texels.size(); ++i) {
            ASSERT_EQ(std::lround(floats->texels[i].y * 255), bytes->rgb[3 * i + 1]);
        }
    }
}

TEST(FloatImage, RejectsCorruptAndTooLargeFiles) {
    const std::string png = pngFile(normalMapOf(64, bumps));
    std::string why;
    EXPECT_FALSE(decodeFloatImage(bytesOf(png.substr(0, png.size() / 2)), 1 << 22, why));
    EXPECT_EQ(why, "the PNG is damaged");
    EXPECT_FALSE(decodeFloatImage(bytesOf(png), 1000, why));
    EXPECT_EQ(why, "the image has more pixels than tspace supports");
}

}  // namespace
}  // namespace tspace::test
