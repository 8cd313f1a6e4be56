// SPDX-License-Identifier: MIT
// Texture files: every format compared with its formula or with another decoder, invalid headers, and the channels that
// contain x, y and z.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "images/codecs.h"
#include "images/float_image.h"
#include "images/image.h"
#include "images/images.h"
#include "images/known_blocks.h"
#include "images/textures.h"

namespace tspace::test {
namespace {

std::optional<FloatImage> decode(const std::string& file) {
    std::string why;
    return decodeFloatImage(bytesOf(file), 1 << 22, why);
}

std::string whyNot(const std::string& file, std::uint64_t most_pixels = 1 << 22) {
    std::string why;
    const bool is_read = decodeFloatImage(bytesOf(file), most_pixels, why).has_value();
    std::string why_rounded;
    EXPECT_EQ(decodeImage(bytesOf(file), most_pixels, why_rounded).has_value(), is_read);
    EXPECT_EQ(is_read ? "" : why, is_read ? "" : why_rounded);
    return is_read ? "" : why;
}

std::string randomBytes(std::size_t count, std::uint32_t seed) {
    std::string bytes;
    for (std::uint32_t state = seed; bytes.size() < count; bytes += static_cast<char>(state >> 24))
        state = state * 1664525U + 1013904223U;
    return bytes;
}

std::uint8_t byteAt(const std::string& data, std::size_t at) { return static_cast<std::uint8_t>(data[at]); }

/// Returns one channel of a texel of a BC4 block, by the formula in double precision.
double channelOf(const std::string& block, std::size_t at, std::size_t texel, bool is_signed) {
    const int first = is_signed ? std::bit_cast<std::int8_t>(block[at]) : byteAt(block, at);
    const int second = is_signed ? std::bit_cast<std::int8_t>(block[at + 1]) : byteAt(block, at + 1);
    std::uint64_t codes = 0;
    for (std::size_t i = 0; i < 6; ++i) codes |= std::uint64_t{byteAt(block, at + 2 + i)} << 8 * i;
    const int code = static_cast<int>(codes >> 3 * texel & 7);
    const auto value = [&](int end) { return is_signed ? std::max(end / 127.0, -1.0) : end / 255.0; };
    const double a = value(first), b = value(second);
    if (code < 2) return code == 0 ? a : b;
    if (first > second) return ((8 - code) * a + (code - 1) * b) / 7;
    if (code > 5) return code == 7 ? 1 : is_signed ? -1 : 0;
    return ((6 - code) * a + (code - 1) * b) / 5;
}

/// Returns the number of the block that contains a texel (blocks are in rows), and the number of the texel in the
/// block.
std::pair<std::size_t, std::size_t> placeOf(std::size_t x, std::size_t y, std::size_t width) {
    return {y / 4 * ((width + 3) / 4) + x / 4, y % 4 * 4 + x % 4};
}

TEST(Texture, DecodesBc4AndBc5ByTheirFormulas) {
    constexpr std::uint32_t kWidth = 62, kHeight = 33, kBlocks = 16 * 9;
    for (const bool is_signed : {false, true}) {
        const std::string data = randomBytes(kBlocks * 16, 7);
        const auto image = decode(ddsFile(is_signed ? 84 : 83, kWidth, kHeight, data));
        const auto gray = decode(ddsFile(is_signed ? 81 : 80, kWidth, kHeight, data.substr(0, kBlocks * 8)));
        ASSERT_TRUE(image && gray);
        EXPECT_EQ(image->bits, 16u);
        const auto stored = [&](double value) { return is_signed ? (value + 1) / 2 : value; };
        for (std::size_t y = 0; y < kHeight; ++y) {
            for (std::size_t x = 0; x < kWidth; ++x) {
                const auto [block, texel] = placeOf(x, y, kWidth);
                const Vec3& read = image->texels[y * kWidth + x];
                ASSERT_NEAR(read.x, stored(channelOf(data, 16 * block, texel, is_signed)), 1e-7);
                ASSERT_NEAR(read.y, stored(channelOf(data, 16 * block + 8, texel, is_signed)), 1e-7);
                ASSERT_EQ(read.z, 0);
                const Vec3& one = gray->texels[y * kWidth + x];
                ASSERT_NEAR(one.x, stored(channelOf(data, 8 * block, texel, is_signed)), 1e-7);
                ASSERT_TRUE(one.x == one.y && one.y == one.z);
            }
        }
    }
}

TEST(Texture, DecodesTheExampleOfTheSpecificationOfEac) {
    // The example of the chapter about ETC2 in the Khronos Data Format Specification: base 103, table 13, multiplier 0
    // and code 3 give 818 of 2047.
    std::string block{103, 13};
    std::uint64_t codes = 0;
    for (int i = 0; i < 16; ++i) codes = codes << 3 | 3;
    for (int i = 5; i >= 0; --i) block += static_cast<char>(codes >> 8 * i & 255);
    const auto image = decode(ktx2File({.format = 153, .width = 4, .height = 4, .levels = {block}, .model = 161}));
    ASSERT_TRUE(image);
    for (const Vec3& texel : image->texels) EXPECT_NEAR(texel.x, 818.0 / 2047, 1e-7);
}

TEST(Texture, DecodesEacByItsFormulas) {
    // All blocks use table 13, which the example in the specification uses too.
    constexpr int kTable[] = {-1, -2, -3, -10, 0, 1, 2, 9};
    constexpr std::uint32_t kSize = 64;
    std::string data = randomBytes(16 * 256, 9);
    for (std::size_t at = 1; at < data.size(); at += 8) data[at] = static_cast<char>((byteAt(data, at) & 0xf0) | 13);
    for (const bool is_signed : {false, true}) {
        const auto image = decode(ktx2File(
            {.format = is_signed ? 156U : 155U, .width = kSize, .height = kSize, .levels = {data}, .model = 161}));
        ASSERT_TRUE(image);
        for (std::size_t y = 0; y < kSize; ++y) {
            for (std::size_t x = 0; x < kSize; ++x) {
                const std::size_t at = 16 * placeOf(x, y, kSize).first + 8;  // position of green in the block
                std::uint64_t codes = 0;
                for (std::size_t i = 2; i < 8; ++i) codes = codes << 8 | byteAt(data, at + i);
                const std::size_t column_first = x % 4 * 4 + y % 4;
                const int modifier = kTable[codes >> (45 - 3 * column_first) & 7], wide = byteAt(data, at + 1) >> 4;
                const int by = wide == 0 ? modifier : 8 * wide * modifier;
                const int base = is_signed ? std::max<int>(std::bit_cast<std::int8_t>(data[at]), -127) * 8
                                           : byteAt(data, at) * 8 + 4;
                const double wanted = is_signed ? (std::clamp(base + by, -1023, 1023) / 1023.0 + 1) / 2
                                                : std::clamp(base + by, 0, 2047) / 2047.0;
                ASSERT_NEAR(image->texels[y * kSize + x].y, wanted, 1e-7);
            }
        }
    }
}

void expectKnown(const KnownBlock& known, const std::optional<FloatImage>& image) {
    ASSERT_TRUE(image);
    const std::string texels = bytesOfHex(known.texels);
    for (std::size_t i = 0; i < 16; ++i) {
        const Vec3& texel = image->texels[i];
        const float alpha = image->alpha.empty() ? 1 : image->alpha[i];
        const float parts[] = {texel.x, texel.y, texel.z, alpha};
        for (std::size_t k = 0; k < 4; ++k)
            ASSERT_EQ(parts[k], static_cast<float>(byteAt(texels, 4 * i + k)) / 255.0F) << known.block << " " << i;
    }
}

TEST(Texture, DecodesBc7AsPillowDoes) {
    for (const KnownBlock& known : kBc7Blocks) {
        expectKnown(known, decode(ddsFile(98, 4, 4, bytesOfHex(known.block))));
        expectKnown(known,
                    decode(ktx2File({.format = 145, .width = 4, .height = 4, .levels = {bytesOfHex(known.block)}})));
    }
}

TEST(Texture, DecodesUastcAsBasisuDoes) {
    for (const KnownBlock& known : kUastcBlocks)
        expectKnown(known,
                    decode(ktx2File({.width = 4, .height = 4, .levels = {bytesOfHex(known.block)}, .model = 166})));
}

TEST(Texture, DecodesEtc1sAsTheBasisTranscoderDoes) {
    const std::string file = bytesOfHex(kEtc1sFile), texels = bytesOfHex(kEtc1sTexels);
    const auto image = decode(file);
    ASSERT_TRUE(image);
    EXPECT_EQ(image->texture.name, "ETC1S in a KTX2");
    ASSERT_EQ(texels.size(), 4 * image->texels.size());
    ASSERT_EQ(image->alpha.size(), image->texels.size());
    for (std::size_t i = 0; i < image->texels.size(); ++i) {
        const Vec3& texel = image->texels[i];
        const float parts[] = {texel.x, texel.y, texel.z, image->alpha[i]};
        for (std::size_t k = 0; k < 4; ++k)
            ASSERT_EQ(parts[k], static_cast<float>(byteAt(texels, 4 * i + k)) / 255.0F) << i;
    }
    for (std::size_t size = 0; size < file.size(); ++size) EXPECT_NE(whyNot(file.substr(0, size)), "") << size;
}

TEST(Texture, DecodesAstcOfOneColor) {
    // A block of one color (void extent) without coordinates: the bits 0xdfc, then ones, and four 16-bit numbers.
    const std::string block("\xfc\xfd\xff\xff\xff\xff\xff\xff\x00\x40\x00\x80\xff\xff\xff\xff", 16);
    Ktx2Parts parts{.format = 163, .width = 11, .height = 6};
    for (int i = 0; i < 4; ++i) parts.levels.resize(1), parts.levels[0] += block;
    parts.model = 162;
    std::string why;
    const auto image = decodeFloatImage(bytesOf(ktx2File(parts)), 1 << 20, why);
    if (why.find("astcenc") != std::string::npos) GTEST_SKIP() << why;
    ASSERT_TRUE(image) << why;
    EXPECT_EQ(image->texture.name, "ASTC 6x5 in a KTX2");
    ASSERT_EQ(image->texels.size(), 66u);
    for (const Vec3& texel : image->texels) {
        // The decoder returns half floats, as GPUs do.
        EXPECT_NEAR(texel.x, 0x4000 / 65535.0, 1e-5);
        EXPECT_NEAR(texel.y, 0x8000 / 65535.0, 1e-5);
        EXPECT_EQ(texel.z, 1);
    }
}

TEST(Texture, InvalidBlocksHaveTheSpecifiedErrorColors) {
    const auto bc7 = decode(ddsFile(98, 4, 4, std::string(16, '\0')));
    ASSERT_TRUE(bc7);
    EXPECT_EQ(bc7->texels[5], (Vec3{0, 0, 0}));
    const auto uastc = decode(ktx2File({.width = 4, .height = 4, .levels = {std::string(16, '\x45')}, .model = 166}));
    ASSERT_TRUE(uastc);
    EXPECT_EQ(uastc->texels[5], (Vec3{1, 0, 1}));
}

TEST(Texture, DecodesBc1AndBc3) {
    // The end points are (31, 0, 0), red, and (0, 63, 0), green. The texels have codes 0 to 3. The second block has the
    // same codes, but three colors.
    const std::string full("\x00\xf8\xe0\x07\xe4\xe4\xe4\xe4", 8), cut("\xe0\x07\x00\xf8\xe4\xe4\xe4\xe4", 8);
    const auto image = decode(ddsFile(71, 8, 4, full + cut));
    ASSERT_TRUE(image);
    EXPECT_EQ(image->texels[0], (Vec3{1, 0, 0}));
    EXPECT_EQ(image->texels[1], (Vec3{0, 1, 0}));
    EXPECT_EQ(image->texels[2], (Vec3{2.0F / 3, 1.0F / 3, 0}));
    EXPECT_EQ(image->texels[6], (Vec3{0.5F, 0.5F, 0}));
    ASSERT_FALSE(image->alpha.empty());
    EXPECT_EQ(image->alpha[3], 1);
    EXPECT_EQ(image->alpha[7], 0);
    const std::string alpha("\xff\x00\x88\xc6\xfa\x88\xc6\xfa", 8);
    const auto bc3 = decode(oldDdsFile("DXT5", 4, 4, alpha + cut));
    ASSERT_TRUE(bc3);
    EXPECT_EQ(bc3->texels[2], (Vec3{1.0F / 3, 2.0F / 3, 0})) << "BC3 is never cut";
    EXPECT_EQ(bc3->alpha[0], 1);
    EXPECT_EQ(bc3->alpha[1], 0);
    EXPECT_EQ(bc3->alpha[2], 6.0F / 7);
}

TEST(Texture, DecodesTexelsOfEveryPlainFormat) {
    struct Case {
        std::uint32_t format;
        std::string texel;
        Vec3 wanted;
    };
    const std::string half("\x00\x38\x00\xb4\x00\x3c\x00\x00", 8);  // 0.5, -0.25, 1, 0
    const Case cases[] = {{9, "\x33", {0.2F, 0.2F, 0.2F}},
                          {16, "\x33\x66", {0.2F, 0.4F, 0}},
                          {17, "\x7f\x81", {1, 0, 0}},
                          {17, std::string("\x00\x80", 2), {0.5F, 0, 0}},
                          {23, "\x33\x66\xff", {0.2F, 0.4F, 1}},
                          {30, "\xff\x66\x33", {0.2F, 0.4F, 1}},
                          {37, "\x33\x66\xff\xff", {0.2F, 0.4F, 1}},
                          {44, "\xff\x66\x33\xff", {0.2F, 0.4F, 1}},
                          {64, std::string("\xff\x03\x00\xc0", 4), {1, 0, 0}},
                          {77, std::string("\x33\x33\xff\xff", 4), {0.2F, 1, 0}},
                          {78, std::string("\xff\x7f\x01\x80", 4), {1, 0, 0}},
                          {91, std::string("\x33\x33\xff\xff\x00\x00\xff\xff", 8), {0.2F, 1, 0}},
                          {97, half, {0.75F, 0.375F, 1}},
                          {109, std::string("\0\0\0\x3f\0\0\x80\x3e\0\0\x80\x3f\0\0\x80\x3f", 16), {0.5F, 0.25F, 1}}};
    for (const Case& one : cases) {
        std::string data;
        for (int i = 0; i < 6; ++i) data += one.texel;
        const auto image = decode(ktx2File({.format = one.format, .width = 3, .height = 2, .levels = {data}}));
        ASSERT_TRUE(image) << one.format;
        for (const Vec3& texel : image->texels) EXPECT_EQ(texel, one.wanted) << one.format;
    }
    const auto masked = decode(maskedDdsFile(16, {0xf800, 0x07e0, 0x001f}, 1, 1, std::string("\x1f\xf8", 2)));
    ASSERT_TRUE(masked);
    EXPECT_EQ(masked->texels[0], (Vec3{1, 0, 1}));
    const auto bgra = decode(maskedDdsFile(32, {0xff0000, 0xff00, 0xff, 0xff000000U}, 1, 1, "\xff\x66\x33\x80"));
    ASSERT_TRUE(bgra);
    EXPECT_EQ(bgra->texels[0], (Vec3{0.2F, 0.4F, 1}));
    EXPECT_EQ(bgra->alpha[0], 128.0F / 255);
}

TEST(Texture, FloatsThatAreNotFiniteAreGray) {
    const std::string texels("\x00\x7c\x00\x00\x00\x00\x00\x3c\x00\x38\x00\x38\x00\x38\x00\x3c", 16);
    const auto image = decode(ktx2File({.format = 97, .width = 2, .height = 1, .levels = {texels}}));
    ASSERT_TRUE(image);
    EXPECT_EQ(image->not_finite, 1u);
    EXPECT_EQ(image->texels[0], (Vec3{0.5F, 0.5F, 0.5F}));
}

TEST(Texture, UnpacksZstandardAndZlib) {
    const RgbImage map = normalMapOf(32, bumps);
    const std::string plain = redAndGreen(map);
    const auto wanted = decode(ktx2File({.format = 16, .width = 32, .height = 32, .levels = {plain}}));
    ASSERT_TRUE(wanted);
    for (const std::uint32_t scheme : {2U, 3U}) {
        const std::string packed = scheme == 2 ? zstdOf(plain) : zlibOf(plain);
        Ktx2Parts parts{.format = 16, .width = 32, .height = 32, .levels = {packed}, .unpacked = {plain.size()}};
        parts.scheme = scheme;
        const auto image = decode(ktx2File(parts));
        ASSERT_TRUE(image);
        EXPECT_EQ(image->texels, wanted->texels);
        EXPECT_GE(imageWorkBytes(bytesOf(ktx2File(parts))), plain.size());
        // Data that decompresses to more or fewer bytes than the image needs is corrupt, regardless of the declared
        // size.
        for (const std::string& other : {plain + plain, plain.substr(2)}) {
            parts.levels = {scheme == 2 ? zstdOf(other) : zlibOf(other)};
            EXPECT_EQ(whyNot(ktx2File(parts)), "the KTX2 is damaged");
        }
        parts.levels = {packed.substr(0, packed.size() / 2)};
        EXPECT_EQ(whyNot(ktx2File(parts)), "the KTX2 is damaged");
        parts.levels = {packed};
        parts.unpacked = {plain.size() + 1};
        EXPECT_EQ(whyNot(ktx2File(parts)), "the KTX2 is damaged");
    }
}

TEST(Texture, NamesUnsupportedFormats) {
    const Ktx2Parts plain{.format = 16, .width = 8, .height = 8, .levels = {std::string(128, '\x80')}};
    const std::string file = ktx2File(plain);
    EXPECT_EQ(whyNot(file), "");
    EXPECT_EQ(whyNot(file, 10), "the image has more pixels than tspace supports");
    const auto with = [&](std::size_t at, char value) {
        std::string changed = file;
        changed[at] = value;
        return changed;
    };
    EXPECT_EQ(whyNot(with(12, '\x8f')), "the KTX2 has the Vulkan format 143, which is not supported");
    EXPECT_EQ(whyNot(with(28, 2)), "the KTX2 is three-dimensional, not a single image");
    EXPECT_EQ(whyNot(with(32, 2)), "the KTX2 is an array of several images");
    EXPECT_EQ(whyNot(with(36, 6)), "the KTX2 is a cube map, not a single image");
    EXPECT_EQ(whyNot(with(44, 9)), "the KTX2 uses the supercompression scheme 9, which is not supported");
    Ktx2Parts etc1s{.width = 8, .height = 8, .levels = {"x"}, .unpacked = {0}};
    etc1s.scheme = 2;
    etc1s.model = 163;
    EXPECT_EQ(whyNot(ktx2File(etc1s)), "the KTX2 is damaged") << "ETC1S without BasisLZ";
    const std::string dds = ddsFile(49, 8, 8, std::string(128, '\x80'));
    EXPECT_EQ(whyNot(dds), "");
    EXPECT_EQ(whyNot(ddsFile(95, 8, 8, std::string(64, 'x'))),
              "the DDS has the DXGI format 95, which is not supported");
    EXPECT_EQ(whyNot(oldDdsFile("UYVY", 8, 8, std::string(128, 'x'))),
              "the DDS has the format UYVY, which is not supported");
    EXPECT_EQ(whyNot(dds.substr(0, dds.size() - 1)), "the DDS is damaged");
    EXPECT_EQ(whyNot(dds.substr(0, 100)), "the DDS is damaged");
}

TEST(Texture, RejectsLevelsThatOverlapOrLieOutside) {
    const std::string large(128, '\x80'), small(32, '\x80');
    const std::string file = ktx2File({.format = 16, .width = 8, .height = 8, .levels = {large, small}});
    EXPECT_EQ(whyNot(file), "");
    const auto with = [&](std::size_t at, std::uint64_t number) {
        std::string changed = file;
        for (std::size_t i = 0; i < 8; ++i) changed[at + i] = static_cast<char>(number >> 8 * i & 255);
        return changed;
    };
    std::uint64_t first = 0, second = 0;
    std::memcpy(&first, file.data() + 80, 8);
    std::memcpy(&second, file.data() + 104, 8);
    EXPECT_EQ(whyNot(with(104, first + 16)), "the KTX2 is damaged") << "the second in the first";
    EXPECT_EQ(whyNot(with(80, second)), "the KTX2 is damaged") << "the first over the second";
    EXPECT_EQ(whyNot(with(80, file.size() - 64)), "the KTX2 is damaged");
    EXPECT_EQ(whyNot(with(80, ~std::uint64_t{0} - 8)), "the KTX2 is damaged");
    EXPECT_EQ(whyNot(with(80, 16)), "the KTX2 is damaged") << "in the head";
    EXPECT_EQ(whyNot(with(88, 127)), "the KTX2 is damaged");
    EXPECT_EQ(whyNot(file.substr(0, file.size() - 1)), "the KTX2 is damaged");
}

TEST(Texture, RejectsAFewBytesThatClaimManyPixels) {
    const std::string packed = zstdOf(std::string(1 << 20, '\x80'));
    Ktx2Parts parts{.format = 37, .width = 1 << 15, .height = 1 << 15, .levels = {packed}};
    parts.unpacked = {std::uint64_t{4} << 30};
    parts.scheme = 2;
    EXPECT_EQ(whyNot(ktx2File(parts), std::uint64_t{1} << 40),
              "the header of the image declares far more pixels than its data can contain");
    EXPECT_EQ(whyNot(ddsFile(83, 1 << 20, 1 << 20, std::string(64, 'x')), std::uint64_t{1} << 60),
              "the DDS is damaged");
}

TEST(Texture, SizesWhoseProductWith64BitsWouldBeZeroAreRejected) {
    // The size would be 2^30 * 2^30 texels of 16 bytes (RGBA as floats).
    constexpr std::uint32_t kSide = std::uint32_t{1} << 30;
    constexpr std::uint64_t kAny = ~std::uint64_t{0};
    EXPECT_EQ(whyNot(ddsFile(2, kSide, kSide, ""), kAny), "the DDS is damaged");
    EXPECT_EQ(whyNot(ktx2File({.format = 109, .width = kSide, .height = kSide, .levels = {""}}), kAny),
              "the KTX2 is damaged");
}

TEST(Texture, ReadsTheRequestedLevel) {
    // Red tells the levels apart. They have 4 x 2, 2 x 1 and 1 x 1 texels of two bytes.
    const std::vector<std::string> levels = {std::string(16, '\x10'), std::string(4, '\x20'), std::string(2, '\x30')};
    const std::string ktx2 = ktx2File({.format = 16, .width = 4, .height = 2, .levels = levels});
    for (std::size_t level = 0; level < levels.size(); ++level) {
        std::string why;
        const std::optional<FloatImage> image = decodeFloatTexture(bytesOf(ktx2), 1 << 20, why, level);
        ASSERT_TRUE(image) << why;
        EXPECT_EQ(image->width, 4U >> level);
        EXPECT_EQ(image->height, level == 0 ? 2U : 1U);
        EXPECT_FLOAT_EQ(image->texels.back().x, static_cast<float>(0x10 * (level + 1)) / 255);
    }
    std::string why;
    EXPECT_FALSE(decodeFloatTexture(bytesOf(ktx2), 1 << 20, why, 3));
    EXPECT_EQ(why, "the texture has no mip level 3; its last mip level is 2");
    EXPECT_FALSE(decodeFloatTexture(bytesOf(ktx2), 0, why, 2));
}

TEST(Texture, AppliesOrientationAndSwizzleOfTheFile) {
    const std::string data("\x10\x20\x30\x40\x50\x60\x70\x80", 8);  // 2 x 2 texels with two channels
    Ktx2Parts parts{.format = 16, .width = 2, .height = 2, .levels = {data}};
    const auto plain = decode(ktx2File(parts));
    parts.values = {{"KTXorientation", "ru"}};
    const auto turned = decode(ktx2File(parts));
    ASSERT_TRUE(plain && turned);
    EXPECT_EQ(turned->texels[0], plain->texels[2]);
    EXPECT_EQ(turned->texels[3], plain->texels[1]);
    parts.values = {{"KTXswizzle", "rrrg"}};
    const auto swizzled = decode(ktx2File(parts));
    ASSERT_TRUE(swizzled);
    EXPECT_EQ(swizzled->texels[0], (Vec3{16.0F / 255, 16.0F / 255, 16.0F / 255}));
    EXPECT_EQ(swizzled->alpha[0], 32.0F / 255);
    EXPECT_EQ(swizzled->texture.layout.x.channel, MapChannel::red);
    EXPECT_EQ(swizzled->texture.layout.y.channel, MapChannel::alpha);
}

TEST(Texture, ReportsTheChannelsOfXAndY) {
    const RgbImage map = normalMapOf(32, bumps);
    const auto bc5 = decode(ddsFile(83, 32, 32, bc5Blocks(map)));
    ASSERT_TRUE(bc5);
    EXPECT_EQ(bc5->texture.name, "BC5 in a DDS");
    EXPECT_EQ(bc5->texture.layout.y.channel, MapChannel::green);
    EXPECT_EQ(bc5->texture.layout.z.channel, MapChannel::none);
    EXPECT_FALSE(bc5->texture.is_guessed);
    EXPECT_EQ(textureFacts(bytesOf(ddsFile(83, 32, 32, bc5Blocks(map))))->name, "BC5 in a DDS");
    // Textures with four channels: x in alpha and y in green; x in all colors and y in alpha; x, y and z in red, green
    // and blue.
    std::string alone, in_colors, normal;
    for (std::size_t i = 0; i < map.rgb.size(); i += 3) {
        const char x = static_cast<char>(map.rgb[i]), y = static_cast<char>(map.rgb[i + 1]);
        alone += std::string{'\xff', y, '\xff', x};
        in_colors += std::string{x, x, x, y};
        normal += std::string{x, y, static_cast<char>(map.rgb[i + 2]), '\x7f'};
    }
    const auto dxt5nm = decode(ddsFile(28, 32, 32, alone)), rrrg = decode(ddsFile(28, 32, 32, in_colors));
    const auto plain = decode(ddsFile(28, 32, 32, normal));
    ASSERT_TRUE(dxt5nm && rrrg && plain);
    EXPECT_TRUE(dxt5nm->texture.is_guessed);
    EXPECT_EQ(dxt5nm->texture.layout.x.channel, MapChannel::alpha);
    EXPECT_EQ(dxt5nm->texture.layout.y.channel, MapChannel::green);
    EXPECT_EQ(rrrg->texture.layout.x.channel, MapChannel::red);
    EXPECT_EQ(rrrg->texture.layout.y.channel, MapChannel::alpha);
    EXPECT_EQ(plain->texture.layout, MapLayout{});
    Ktx2Parts uastc{.width = 4, .height = 4, .levels = {bytesOfHex(kUastcBlocks[0].block)}};
    uastc.model = 166;
    uastc.channel = 5;
    EXPECT_EQ(textureFacts(bytesOf(ktx2File(uastc)))->layout.y.channel, MapChannel::alpha);
}

TEST(Texture, RoundsToEightBitsAsTheFloatsDo) {
    const std::string data = randomBytes(16 * 64, 3);
    for (const std::uint32_t format : {71U, 77U, 83U, 84U, 98U}) {
        const std::string file = ddsFile(format, 30, 31, data);
        const auto floats = decode(file);
        std::string why;
        const auto bytes = decodeImage(bytesOf(file), 1 << 20, why);
        ASSERT_TRUE(floats && bytes);
        const std::vector<std::uint8_t> alpha = decodeAlpha(bytesOf(file));
        for (std::size_t i = 0; i < floats->texels.size(); ++i) {
            ASSERT_NEAR(bytes->rgb[3 * i], floats->texels[i].x * 255, 0.5001);
            ASSERT_NEAR(bytes->rgb[3 * i + 2], floats->texels[i].z * 255, 0.5001);
            if (floats->alpha.empty()) continue;
            ASSERT_NEAR(alpha[i], floats->alpha[i] * 255, 0.5001);
        }
    }
}

TEST(Texture, SurvivesBrokenFiles) {
    const RgbImage map = normalMapOf(24, bumps);
    const std::string green = redAndGreen(map), blocks = bc5Blocks(map);
    Ktx2Parts packed{.format = 16, .width = 24, .height = 24, .levels = {zstdOf(green)}, .unpacked = {green.size()}};
    packed.scheme = 2;
    const std::string files[] = {
        bytesOfHex(kEtc1sFile), ktx2File(packed),
        ktx2File({.format = 141, .width = 24, .height = 24, .levels = {blocks, blocks.substr(0, 144)}}),
        ddsFile(83, 24, 24, blocks), oldDdsFile("DXT5", 24, 24, blocks)};
    EXPECT_TRUE(rc::check([&] {
        std::string file = files[*rc::gen::inRange(0, 5)];
        for (int i = 0; i < *rc::gen::inRange(1, 5); ++i)
            file[*rc::gen::inRange<std::size_t>(3, std::min<std::size_t>(file.size(), 256))] =
                *rc::gen::arbitrary<char>();
        std::string why;
        imageWorkBytes(bytesOf(file));
        const std::optional<FloatImage> image = decodeFloatImage(bytesOf(file), 1 << 16, why);
        if (image) RC_ASSERT(image->texels.size() == std::size_t{image->width} * image->height);
        if (!image) RC_ASSERT(!why.empty());
    }));
}

}  // namespace
}  // namespace tspace::test
