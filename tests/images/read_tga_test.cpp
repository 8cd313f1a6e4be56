// SPDX-License-Identifier: MIT
// Reading TGA files: those of the tool, those of other programs, and invalid ones.
#include <gtest/gtest.h>

#include <string>

#include "images.h"
#include "images/float_image.h"
#include "images/image.h"
#include "images/tga.h"
#include "tspace/map_files.h"

namespace tspace::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kFromTheTop = 0x20, kFromTheRight = 0x10;

/// Returns the header of a TGA without ID and palette.
Bytes head(std::uint8_t type, std::uint8_t width, std::uint8_t height, std::uint8_t bits, std::uint8_t descriptor) {
    return {0, 0, type, 0, 0, 0, 0, 0, 0, 0, 0, 0, width, 0, height, 0, bits, descriptor};
}

Bytes operator+(Bytes bytes, const Bytes& more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
    return bytes;
}

Bytes rgbOf(const Bytes& file) {
    std::string why;
    const auto image = decodeImage(file, 1 << 20, why);
    return image ? image->rgb : Bytes();
}

std::string whyNot(ByteSpan file) {
    std::string why;
    return decodeImage(file, 1 << 20, why) ? "" : why;
}

constexpr const char* kUnknown = "the image is neither PNG, JPEG, WebP, EXR, KTX2, DDS nor TGA";
constexpr const char* kBroken = "the TGA is damaged";

/// Two rows of two texels: red and green; blue and gray.
const Bytes kFourTexels = {255, 0, 0, 0, 255, 0, 0, 0, 255, 10, 20, 30};
const Bytes kFourStored = {0, 0, 255, 0, 255, 0, 255, 0, 0, 30, 20, 10};

TEST(ReadTga, RoundTrips) {
    const RgbImage map = normalMapOf(33, bumps);
    const auto of_bytes = encodeTga(map);
    ASSERT_TRUE(of_bytes);
    EXPECT_EQ(imageFormat(*of_bytes), ImageFormat::tga);
    EXPECT_EQ(rgbOf(*of_bytes), map.rgb);
    EXPECT_EQ(claimedSize(*of_bytes).pixels(), 33U * 33U);
    EXPECT_GE(imageWorkBytes(*of_bytes), 3U * 33U * 33U);

    FloatImage image{.width = 2, .height = 2};
    image.texels = {{1, 0, 0.2F}, {0, 1, 0.4F}, {0.6F, 0.8F, 1}, {0.2F, 0.2F, 0.2F}};
    image.alpha = {0, 0.2F, 0.4F, 1};
    const auto file = encodeTga(image);
    ASSERT_TRUE(file);
    std::string why;
    const auto read = decodeFloatImage(*file, 1 << 20, why);
    ASSERT_TRUE(read) << why;
    EXPECT_EQ(read->bits, 8U);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(read->texels[i].x, image.texels[i].x) << i;
        EXPECT_EQ(read->texels[i].y, image.texels[i].y) << i;
        EXPECT_EQ(read->texels[i].z, image.texels[i].z) << i;
        EXPECT_EQ(read->alpha[i], image.alpha[i]) << i;
    }
    EXPECT_EQ(decodeAlpha(*file), (Bytes{0, 51, 102, 255}));
    EXPECT_EQ(encodeTga(*read), file);
}

TEST(ReadTga, BeginsAtAnyCorner) {
    const Bytes swapped_rows = {255, 0, 0, 30, 20, 10, 0, 0, 255, 0, 255, 0};
    const Bytes swapped_columns = {0, 255, 0, 0, 0, 255, 30, 20, 10, 255, 0, 0};
    const Bytes both = {30, 20, 10, 255, 0, 0, 0, 255, 0, 0, 0, 255};
    EXPECT_EQ(rgbOf(head(2, 2, 2, 24, kFromTheTop) + kFourStored), kFourTexels);
    EXPECT_EQ(rgbOf(head(2, 2, 2, 24, 0) + swapped_rows), kFourTexels);
    EXPECT_EQ(rgbOf(head(2, 2, 2, 24, kFromTheTop | kFromTheRight) + swapped_columns), kFourTexels);
    EXPECT_EQ(rgbOf(head(2, 2, 2, 24, kFromTheRight) + both), kFourTexels);
}

TEST(ReadTga, SkipsAnIdAndWhatFollowsThePixels) {
    Bytes file = head(2, 2, 2, 24, kFromTheTop) + Bytes{'i', 'd', '!'} + kFourStored + Bytes(40, 7);
    file[0] = 3;
    EXPECT_EQ(rgbOf(file), kFourTexels);
}

TEST(ReadTga, DecodesRunsAndLiterals) {
    const Bytes packed = head(10, 3, 2, 24, kFromTheTop) + Bytes{0x83, 1, 2, 3, 0x01, 4, 5, 6, 7, 8, 9};
    EXPECT_EQ(rgbOf(packed), (Bytes{3, 2, 1, 3, 2, 1, 3, 2, 1, 3, 2, 1, 6, 5, 4, 9, 8, 7}))
        << "runs go on in the next row";
    const Bytes gray = head(11, 4, 1, 8, 0) + Bytes{0x82, 9, 0x00, 200};
    EXPECT_EQ(rgbOf(gray), (Bytes{9, 9, 9, 9, 9, 9, 9, 9, 9, 200, 200, 200}));
    const Bytes with_alpha = head(10, 2, 1, 32, 8) + Bytes{0x81, 1, 2, 3, 77};
    EXPECT_EQ(decodeAlpha(with_alpha), (Bytes{77, 77}));
}

TEST(ReadTga, ReadsGrayWithAlphaAndFiveBits) {
    const Bytes gray = head(3, 2, 1, 16, 8) + Bytes{10, 20, 30, 40};
    EXPECT_EQ(rgbOf(gray), (Bytes{10, 10, 10, 30, 30, 30}));
    EXPECT_EQ(decodeAlpha(gray), (Bytes{20, 40}));
    // A 16-bit word with red 31, green 16 and blue 1, of 31 each.
    constexpr unsigned kWord = 31U << 10 | 16U << 5 | 1U;
    const Bytes word = {kWord & 0xff, kWord >> 8, kWord & 0xff, kWord >> 8 | 0x80};
    EXPECT_EQ(rgbOf(head(2, 2, 1, 16, 1) + word), (Bytes{255, 132, 8, 255, 132, 8}));
    EXPECT_EQ(decodeAlpha(head(2, 2, 1, 16, 1) + word), (Bytes{0, 255}));
    EXPECT_EQ(decodeAlpha(head(2, 2, 1, 16, 0) + word), Bytes());
}

TEST(ReadTga, ReadsAPalette) {
    Bytes file = head(1, 3, 1, 8, 0) + Bytes{1, 2, 3, 4, 5, 6} + Bytes{5, 6, 5};
    file[1] = 1;
    file[3] = 5;
    file[5] = 2;
    file[7] = 24;
    EXPECT_EQ(rgbOf(file), (Bytes{3, 2, 1, 6, 5, 4, 3, 2, 1}));
    for (const std::uint8_t index : {4, 7, 255}) {
        file.back() = index;
        EXPECT_EQ(whyNot(file), kBroken) << "the palette has no entry " << int{index};
    }
}

/// If the header declares no alpha, fourth bytes that are all zero are not alpha. Others are, because many writers do
/// not declare alpha.
TEST(ReadTga, TreatsAFourthByteAsAlphaUnlessUndeclaredAndZero) {
    EXPECT_EQ(decodeAlpha(head(2, 2, 1, 32, 0) + Bytes{1, 2, 3, 0, 4, 5, 6, 0}), Bytes());
    EXPECT_EQ(decodeAlpha(head(2, 2, 1, 32, 8) + Bytes{1, 2, 3, 0, 4, 5, 6, 0}), (Bytes{0, 0}));
    EXPECT_EQ(decodeAlpha(head(2, 2, 1, 32, 0) + Bytes{1, 2, 3, 9, 4, 5, 6, 0}), (Bytes{9, 0}));
}

TEST(ReadTga, IsDetectedOnlyByAValidHeader) {
    const Bytes right = head(2, 2, 2, 24, kFromTheTop) + kFourStored;
    ASSERT_EQ(imageFormat(right), ImageFormat::tga);
    const auto with = [&](std::size_t at, std::uint8_t byte) {
        Bytes file = right;
        file[at] = byte;
        return file;
    };
    for (const auto& [at, byte] : {std::pair<std::size_t, std::uint8_t>{1, 1},
                                   {1, 2},
                                   {2, 0},
                                   {2, 1},
                                   {2, 4},
                                   {2, 12},
                                   {2, 18},
                                   {3, 1},
                                   {4, 1},
                                   {5, 1},
                                   {6, 1},
                                   {7, 24},
                                   {12, 0},
                                   {14, 0},
                                   {16, 0},
                                   {16, 15},
                                   {16, 8},
                                   {16, 25},
                                   {16, 64},
                                   {17, 0x60},
                                   {17, 0xa0},
                                   {17, 0x24}})
        EXPECT_EQ(whyNot(with(at, byte)), kUnknown) << at << ": " << int{byte};
    EXPECT_EQ(whyNot(Bytes(64)), kUnknown);
    EXPECT_EQ(whyNot(bytesOf("a text that is longer than the head of a TGA is")), kUnknown);
    // A Windows cursor, whose first bytes equal those of a TGA of type 2.
    EXPECT_EQ(whyNot(Bytes{0, 0, 2, 0, 1, 0, 16, 16, 0, 0, 1, 0, 1, 0, 1, 0, 24, 0} + Bytes(64)), kUnknown);
}

TEST(ReadTga, IsRejectedAtEachShorterLength) {
    const Bytes plain = head(2, 2, 2, 24, kFromTheTop) + kFourStored;
    for (std::size_t size = 0; size < plain.size(); ++size)
        EXPECT_EQ(whyNot(ByteSpan(plain).first(size)), kUnknown) << size;
    const Bytes packed = head(10, 3, 2, 32, 8) + Bytes{0x82, 1, 2, 3, 4, 0x02, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    ASSERT_EQ(whyNot(packed), "");
    for (std::size_t size = 0; size < packed.size(); ++size) {
        const std::string why = whyNot(ByteSpan(packed).first(size));
        EXPECT_EQ(why, size < 18 + 5 ? kUnknown : kBroken) << size;
    }
}

TEST(ReadTga, RejectsRunsThatGoBeyondItsPixels) {
    EXPECT_EQ(whyNot(head(10, 2, 1, 24, 0) + Bytes{0x82, 1, 2, 3}), kBroken);
    EXPECT_EQ(whyNot(head(10, 2, 1, 24, 0) + Bytes{0x00, 1, 2, 3, 0x81, 1, 2, 3}), kBroken);
    EXPECT_EQ(whyNot(head(11, 2, 1, 8, 0) + Bytes{0x02, 1, 2, 3}), kBroken);
}

TEST(ReadTga, RejectsMorePixelsThanItsBytesCanRepresent) {
    Bytes huge = head(2, 0, 0, 32, 8) + Bytes(1000);
    huge[12] = huge[13] = huge[14] = huge[15] = 255;
    EXPECT_EQ(imageFormat(huge), ImageFormat::unknown);
    huge[2] = 10;
    EXPECT_EQ(imageFormat(huge), ImageFormat::unknown);
    EXPECT_EQ(imageWorkBytes(huge), 0U);
    // Runs compress best with 128 pixels in 2 bytes.
    Bytes runs = head(11, 0, 0, 8, 0);
    runs[13] = runs[15] = 4;  // 1024 x 1024
    for (std::size_t i = 0; i < (std::size_t{1} << 20) / 128; ++i) runs = std::move(runs) + Bytes{0xff, 9};
    EXPECT_EQ(whyNot(runs), "");
    std::string why;
    EXPECT_FALSE(decodeImage(runs, 1000, why));
    EXPECT_EQ(why, "the image has more pixels than tspace supports");
    runs.pop_back();
    EXPECT_EQ(imageFormat(runs), ImageFormat::unknown);
}

TEST(ReadTga, CanOnlyBeInvertedIntoAPng) {
    const Bytes file = head(2, 2, 1, 32, 8) + Bytes{1, 2, 3, 4, 5, 6, 7, 8};
    EXPECT_FALSE(flipGreen(file));
    const auto flipped = flipGreen(file, {.format = ImageFileFormat::png});
    ASSERT_TRUE(flipped);
    EXPECT_EQ(rgbOf(flipped->bytes), (Bytes{3, 253, 1, 7, 249, 5}));
    EXPECT_EQ(decodeAlpha(flipped->bytes), (Bytes{4, 8}));
    EXPECT_TRUE(flipped->report.is_exact);
    EXPECT_FALSE(flipGreen(head(3, 1, 1, 8, 0) + Bytes{9}, {.format = ImageFileFormat::png})) << "gray";
    EXPECT_FALSE(flipGreen(head(10, 3, 1, 24, 0) + Bytes{0x81, 1, 2, 3}, {.format = ImageFileFormat::png})) << "broken";
}

}  // namespace
}  // namespace tspace::test
