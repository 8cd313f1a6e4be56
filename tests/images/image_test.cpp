// SPDX-License-Identifier: MIT
// Decoding images that may be corrupt or malicious.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "images/image.h"
#include "images/images.h"
#include "images/textures.h"

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

TEST(DecodeImage, GivesThePixelsOfAPng) {
    const RgbImage image = normalMapOf(33, bumps);
    const std::optional<RgbImage> decoded = decode(pngFile(image));
    ASSERT_TRUE(decoded);
    EXPECT_EQ(decoded->width, 33u);
    EXPECT_EQ(decoded->rgb, image.rgb);
}

TEST(DecodeImage, GivesThePixelsOfAWebp) {
    const RgbImage image = normalMapOf(33, bumps);
    const std::optional<RgbImage> decoded = decode(webpFile(image, true));
    ASSERT_TRUE(decoded);
    EXPECT_EQ(decoded->rgb, image.rgb) << "lossless";
    const std::optional<RgbImage> lossy = decode(webpFile(image, false));
    ASSERT_TRUE(lossy);
    EXPECT_EQ(lossy->height, 33u);
}

TEST(DecodeImage, RejectsWebpThatItCannotTrust) {
    const std::string webp = webpFile(normalMapOf(64, bumps), true);
    EXPECT_EQ(whyNot(webp.substr(0, webp.size() / 2)), "the WebP is damaged");
    EXPECT_EQ(whyNot(webp, 1000), "the image has more pixels than tspace supports");
    // The header of a lossless image contains width - 1 and height - 1 with 14 bits each, after the byte 0x2f.
    std::string claims = webp;
    const std::size_t head = claims.find("VP8L");
    ASSERT_NE(head, std::string::npos);
    for (std::size_t i = 9; i < 12; ++i) claims[head + i] = '\xff';
    claims[head + 12] = '\x0f';
    EXPECT_EQ(whyNot(claims, std::uint64_t{1} << 40),
              "the header of the image declares far more pixels than its data can contain");
    const std::string animated = std::string("RIFF\x20\0\0\0WEBPVP8X\x0a\0\0\0\x02\0\0\0\x0f\0\0\x0f\0\0", 30) +
                                 std::string("ANIM\x06\0\0\0\0\0\0\0\0\0", 14);
    EXPECT_EQ(whyNot(animated), "the WebP is animated, which is not supported");
}

TEST(DecodeImage, ReportsItsMemoryUse) {
    const RgbImage map = normalMapOf(64, bumps);
    for (const std::string& file : {pngFile(map), jpegFile(map, 90), webpFile(map, true), webpFile(map, false)}) {
        EXPECT_EQ(claimedSize(bytesOf(file)).pixels(), 64u * 64u);
        EXPECT_GE(imageWorkBytes(bytesOf(file)), 3u * 64u * 64u);
    }
    EXPECT_EQ(imageWorkBytes(bytesOf("DDS |")), 0u);
}

TEST(DecodeImage, NamesEachFormatThatTheBuildReads) {
    const std::string why = whyNot("");
    for (const ImageFormat format : {ImageFormat::png, ImageFormat::jpeg, ImageFormat::webp, ImageFormat::exr,
                                     ImageFormat::ktx2, ImageFormat::dds, ImageFormat::tga, ImageFormat::avif}) {
        const bool is_named = why.find(formatName(format)) != std::string::npos;
        EXPECT_EQ(is_named, whyNotRead(format) == nullptr) << formatName(format) << why;
    }
}

TEST(DecodeImage, ReportsWhyItDoesNotDecode) {
    const std::string png = pngFile(normalMapOf(64, bumps)), jpeg = jpegFile(normalMapOf(64, bumps), 90);
    EXPECT_EQ(whyNot(png), "");
    EXPECT_EQ(whyNot(png, 1000), "the image has more pixels than tspace supports");
    EXPECT_EQ(whyNot(jpeg, 1000), "the image has more pixels than tspace supports");
    EXPECT_EQ(whyNot("RIFF????WEBP"), "the WebP is damaged");
    EXPECT_EQ(whyNot("\xabKTX 20\xbb\r\n\x1a\n"), "the KTX2 is damaged");
    EXPECT_EQ(whyNot(std::string("sB\x13\0\x4d\0", 6)),
              "the image is a Basis Universal file (.basis), which is not supported");
    EXPECT_EQ(whyNot("DDS |"), "the DDS is damaged");
    EXPECT_EQ(whyNot(png.substr(0, png.size() / 2)), "the PNG is damaged");
    EXPECT_EQ(whyNot(jpeg.substr(0, 10)), "the JPEG is damaged");
    // A JPEG header with four components.
    EXPECT_EQ(whyNot(bytesOfHex("ffd8ffc0001408000800080401110002110003110004110"
                                "0ffda000e0401000200030004000003f000000")),
              "the JPEG is CMYK (for print), which is not supported; convert it to RGB");
}

TEST(DecodeImage, RejectsAFewBytesThatClaimManyPixels) {
    std::string png = pngFile(normalMapOf(64, bumps));
    // Change the width and the height in the header, which also makes its checksum wrong. Either reason for rejection
    // is accepted.
    png[18] = png[22] = 0x20;
    EXPECT_NE(whyNot(png, std::uint64_t{1} << 40), "");
    std::string jpeg = jpegFile(normalMapOf(64, bumps), 90);
    const std::size_t frame = jpeg.find("\xff\xc0");
    ASSERT_NE(frame, std::string::npos);
    jpeg[frame + 5] = jpeg[frame + 7] = 0x60;
    EXPECT_EQ(whyNot(jpeg, std::uint64_t{1} << 40),
              "the header of the image declares far more pixels than its data can contain");
}

/// The table can contain at most 256 codes, but its 16 counts can declare 4080.
TEST(DecodeImage, RejectsAJpegWhoseTableHasTooManyCodes) {
    std::string jpeg = jpegFile(normalMapOf(64, bumps), 90);
    const std::size_t table = jpeg.find("\xff\xc4");
    ASSERT_NE(table, std::string::npos);
    constexpr std::size_t kCountsAt = 5, kCountsFrom9 = 8;  // 255 codes of each length from 9 to 16 bits are possible
    std::fill_n(jpeg.begin() + static_cast<std::ptrdiff_t>(table + kCountsAt + kCountsFrom9), 8, '\xff');
    EXPECT_EQ(whyNot(jpeg), "the JPEG is damaged");
}

TEST(DecodeImage, SurvivesBrokenFiles) {
    const RgbImage map = normalMapOf(24, bumps);
    const std::string files[] = {pngFile(map), jpegFile(map, 80), webpFile(map, true), webpFile(map, false)};
    EXPECT_TRUE(rc::check([&] {
        std::string file = files[*rc::gen::inRange(0, 4)];
        for (int i = 0; i < *rc::gen::inRange(1, 5); ++i) {
            file[*rc::gen::inRange<std::size_t>(3, file.size())] = *rc::gen::arbitrary<char>();
        }
        const std::optional<RgbImage> image = decode(file, 1 << 16);
        if (image) RC_ASSERT(image->rgb.size() == std::size_t{3} * image->width * image->height);
    }));
}

}  // namespace
}  // namespace tspace::test
