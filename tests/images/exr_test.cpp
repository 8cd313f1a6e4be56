// SPDX-License-Identifier: MIT
// EXR as numbers: what is written comes back, and what is broken is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "images/codecs.h"
#include "images/float_image.h"

namespace tspace::test {
namespace {

class Exr : public ::testing::Test {
  protected:
    void SetUp() override {
        if (const char* why = whyNotRead(ImageFormat::exr)) GTEST_SKIP() << why;
    }
};

FloatImage waves(std::uint32_t width, std::uint32_t height) {
    FloatImage image{width, height, 32, {}, {}};
    for (std::uint32_t i = 0; i < width * height; ++i) {
        const auto at = static_cast<float>(i);
        image.texels.push_back({0.5F + 0.5F * std::sin(at), 0.5F + 0.4F * std::cos(0.37F * at), 1 / (1 + at)});
    }
    return image;
}

std::optional<FloatImage> decodedExr(const std::vector<std::uint8_t>& bytes, std::string* reason = nullptr) {
    std::string why;
    auto image = decodeFloatImage(bytes, 1 << 22, why);
    if (reason != nullptr) *reason = why;
    return image;
}

TEST_F(Exr, FloatsComeBackBitForBit) {
    for (const auto& [width, height] : {std::pair{1U, 1U}, {17U, 33U}, {64U, 16U}, {3U, 200U}}) {
        FloatImage image = waves(width, height);
        const auto file = encodeExr(image, 32);
        ASSERT_TRUE(file);
        EXPECT_EQ(imageFormat(*file), ImageFormat::exr);
        EXPECT_EQ(claimedSize(*file).pixels(), std::uint64_t{width} * height);
        const auto decoded = decodedExr(*file);
        ASSERT_TRUE(decoded);
        EXPECT_EQ(decoded->bits, 32U);
        EXPECT_TRUE(decoded->texels == image.texels);
        EXPECT_TRUE(decoded->alpha.empty());
        for (const Vec3& texel : image.texels) image.alpha.push_back(texel.y);
        EXPECT_TRUE(decodedExr(*encodeExr(image, 32))->alpha == image.alpha);
    }
}

TEST_F(Exr, HalvesComeBackRounded) {
    const FloatImage image = waves(40, 40);
    const auto decoded = decodedExr(*encodeExr(image, 16));
    ASSERT_TRUE(decoded);
    EXPECT_EQ(decoded->bits, 16U);
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        EXPECT_NEAR(decoded->texels[i].x, image.texels[i].x, 0.0005);
        EXPECT_NEAR(decoded->texels[i].y, image.texels[i].y, 0.0005);
    }
    EXPECT_EQ(encodeExr(*decoded, 16), encodeExr(image, 16));
}

TEST_F(Exr, WhatIsNotFiniteBecomesGrey) {
    FloatImage image = waves(8, 8);
    image.texels[5].y = std::nanf("");
    image.texels[9].x = std::numeric_limits<float>::infinity();
    for (const unsigned bits : {16U, 32U}) {
        const auto decoded = decodedExr(*encodeExr(image, bits));
        ASSERT_TRUE(decoded);
        EXPECT_EQ(decoded->not_finite, 2U);
        EXPECT_EQ(decoded->texels[5], (Vec3{0.5F, 0.5F, 0.5F}));
        EXPECT_EQ(decoded->texels[9], (Vec3{0.5F, 0.5F, 0.5F}));
    }
}

/// The file with another number in the corner of its window: 0 to 3 for the first x and y and the last x and y.
std::vector<std::uint8_t> withCorner(std::vector<std::uint8_t> file, std::size_t corner, std::int32_t value) {
    const std::string name("dataWindow\0box2i\0", 17);
    const auto found = std::search(file.begin(), file.end(), name.begin(), name.end());
    std::memcpy(&*found + name.size() + 4 + 4 * corner, &value, sizeof value);
    return file;
}

TEST_F(Exr, RefusesWhatIsBrokenOrTooLarge) {
    const std::vector<std::uint8_t> file = *encodeExr(waves(20, 20), 32);
    for (std::size_t size = 0; size < file.size(); size += 1 + size / 16)
        EXPECT_FALSE(decodedExr({file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size)})) << size;
    std::string why;
    EXPECT_FALSE(decodedExr(withCorner(file, 2, 65535), &why));
    EXPECT_FALSE(decodedExr(withCorner(withCorner(file, 2, 65535), 3, 65535), &why));
    EXPECT_EQ(why, "it has more pixels than are looked at");
    EXPECT_GT(imageWorkBytes(withCorner(withCorner(file, 2, 65535), 3, 65535)), std::uint64_t{16} << 32);
    EXPECT_FALSE(decodedExr(withCorner(file, 2, -1), &why));
    EXPECT_FALSE(decodedExr(withCorner(file, 2, std::numeric_limits<std::int32_t>::max())));
    EXPECT_FALSE(decodedExr(withCorner(file, 0, std::numeric_limits<std::int32_t>::min())));
    EXPECT_FALSE(decodedExr(withCorner(file, 3, 18), &why));
}

TEST_F(Exr, RoundsWhereEightBitsAreAskedFor) {
    std::string why;
    const auto image = decodeImage(*encodeExr(waves(9, 9), 32), 1 << 20, why);
    ASSERT_TRUE(image) << why;
    EXPECT_EQ(image->rgb[0], 128);
    EXPECT_EQ(image->rgb.size(), 3U * 81);
}

}  // namespace
}  // namespace tspace::test
