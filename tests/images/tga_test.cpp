// SPDX-License-Identifier: MIT
// Written TGA files, byte by byte.
#include "images/tga.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tspace::test {
namespace {

TEST(Tga, HasAValidHeaderAndPixelsFromTheTopInBlueGreenRed) {
    FloatImage image{.width = 2, .height = 3};
    image.texels = {{1, 0.5F, 0}, {0, 0, 1}, {2, -1, std::nanf("")}, {}, {}, {0.2F, 0.4F, 0.6F}};
    const auto file = encodeTga(image);
    ASSERT_TRUE(file);
    ASSERT_EQ(file->size(), 18U + 3 * 6 + 26);
    const std::vector<std::uint8_t> head = {0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 3, 0, 24, 0x20};
    EXPECT_EQ(std::vector<std::uint8_t>(file->begin(), file->begin() + 18), head);
    const std::vector<std::uint8_t> pixels = {0, 128, 255, 255, 0, 0, 0, 0, 255, 0, 0, 0, 0, 0, 0, 153, 102, 51};
    EXPECT_EQ(std::vector<std::uint8_t>(file->begin() + 18, file->begin() + 36), pixels);
    EXPECT_EQ(std::string(file->end() - 18, file->end()), std::string("TRUEVISION-XFILE.\0", 18));
}

TEST(Tga, HasAlphaIfTheImageHasAlpha) {
    FloatImage image{.width = 1, .height = 1, .texels = {{0, 1, 0}}, .alpha = {0.5F}};
    const auto file = encodeTga(image);
    ASSERT_TRUE(file);
    EXPECT_EQ((*file)[16], 32);
    EXPECT_EQ((*file)[17], 0x28);
    EXPECT_EQ((*file)[21], 128);
}

TEST(Tga, DoesNotChangeBytesOfAPicture) {
    const auto file = encodeTga(RgbImage{.width = 1, .height = 1, .rgb = {1, 2, 3}});
    ASSERT_TRUE(file);
    EXPECT_EQ(std::vector<std::uint8_t>(file->begin() + 18, file->begin() + 21), (std::vector<std::uint8_t>{3, 2, 1}));
}

TEST(Tga, RejectsSizesThatItCannotRepresent) {
    EXPECT_FALSE(encodeTga(FloatImage{.width = 65536, .height = 1}));
    EXPECT_FALSE(encodeTga(RgbImage{.width = 1, .height = 65536}));
}

}  // namespace
}  // namespace tspace::test
