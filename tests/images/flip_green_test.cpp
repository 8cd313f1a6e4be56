// SPDX-License-Identifier: MIT
// Inverting green: changed data, preserved data, and rejected input.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <spng.h>
#include <webp/decode.h>

#include <cstdlib>
#include <functional>

#include "images/float_image.h"
#include "images/image.h"
#include "images/images.h"
#include "images/textures.h"
#include "support/temp_folder.h"
#include "tspace/map_files.h"

namespace tspace::test {
namespace {

using Bytes8 = std::vector<std::uint8_t>;
constexpr std::uint8_t kGray = 0, kRgb = 2, kPalette = 3, kRgba = 6;

/// Returns a PNG of raw samples, whose most significant bytes come first. `more`: adds chunks.
Bytes8 makePng(
    spng_ihdr header, const Bytes8& samples, const std::function<void(spng_ctx*)>& more = [](spng_ctx*) {}) {
    spng_ctx* context = spng_ctx_new(SPNG_CTX_ENCODER);
    spng_set_option(context, SPNG_ENCODE_TO_BUFFER, 1);
    spng_set_ihdr(context, &header);
    more(context);
    EXPECT_EQ(spng_encode_image(context, samples.data(), samples.size(), SPNG_FMT_RAW, SPNG_ENCODE_FINALIZE), 0);
    std::size_t size = 0;
    int error = 0;
    auto* data = static_cast<std::uint8_t*>(spng_get_png_buffer(context, &size, &error));
    Bytes8 file(data, data + size);
    std::free(data);
    spng_ctx_free(context);
    return file;
}

struct ReadPng {
    spng_ihdr header{};
    Bytes8 samples = {};
    spng_plte palette{};
    spng_trns transparency{};
    bool has_gamma = false, has_srgb = false;
};

ReadPng readPng(std::span<const std::uint8_t> file) {
    ReadPng png;
    spng_ctx* context = spng_ctx_new(0);
    spng_set_png_buffer(context, file.data(), file.size());
    EXPECT_EQ(spng_get_ihdr(context, &png.header), 0);
    spng_get_plte(context, &png.palette);
    spng_get_trns(context, &png.transparency);
    double gamma = 0;
    std::uint8_t intent = 0;
    png.has_gamma = spng_get_gama(context, &gamma) == 0;
    png.has_srgb = spng_get_srgb(context, &intent) == 0;
    std::size_t size = 0;
    EXPECT_EQ(spng_decoded_image_size(context, SPNG_FMT_RAW, &size), 0);
    png.samples.resize(size);
    EXPECT_EQ(spng_decode_image(context, png.samples.data(), size, SPNG_FMT_RAW, 0), 0);
    spng_ctx_free(context);
    return png;
}

Bytes8 noise(std::size_t count) {
    Bytes8 bytes(count);
    std::uint32_t state = 7;
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>((state = state * 1664525 + 1013904223) >> 24);
    return bytes;
}

Bytes8 flipped(std::span<const std::uint8_t> file, const FlipGreenOptions& options = {}) {
    Result<FlippedImage> result = flipGreen(file, options);
    EXPECT_TRUE(result) << result.error().message;
    return result ? result->bytes : Bytes8{};
}

ErrorCode whyNot(std::span<const std::uint8_t> file, const FlipGreenOptions& options = {}) {
    const Result<FlippedImage> result = flipGreen(file, options);
    return result ? ErrorCode::ok : result.error().code;
}

TEST(FlipGreen, IsExactForEveryKindOfPngAndChangesNothingElse) {
    EXPECT_TRUE(rc::check([] {
        const auto width = *rc::gen::inRange<std::uint32_t>(1, 40), height = *rc::gen::inRange<std::uint32_t>(1, 40);
        const std::uint8_t bits = *rc::gen::element<std::uint8_t>(8, 16), color = *rc::gen::element(kRgb, kRgba);
        const std::size_t channels = color == kRgba ? 4 : 3, sample_bytes = bits / 8;
        const Bytes8 samples = noise(width * height * channels * sample_bytes);
        const Bytes8 file = makePng({width, height, bits, color, 0, 0, 0}, samples);
        const Result<FlippedImage> result = flipGreen(file);
        RC_ASSERT(result.ok());
        RC_ASSERT(result->report.is_exact && result->report.bits == bits && result->report.width == width);
        const ReadPng read = readPng(result->bytes);
        RC_ASSERT(read.header.bit_depth == bits && read.header.color_type == color);
        RC_ASSERT(read.samples.size() == samples.size());
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const bool is_green = i / sample_bytes % channels == 1;
            RC_ASSERT(read.samples[i] == (is_green ? 255 - samples[i] : samples[i]));
        }
        RC_ASSERT(readPng(flipped(result->bytes)).samples == samples);  // inverting twice restores the input
    }));
}

std::optional<FloatImage> floatsOf(std::span<const std::uint8_t> file) {
    std::string why;
    return decodeFloatImage(file, 1 << 22, why);
}

/// Green of all levels of BC5 textures. Other formats are tested with whole files.
TEST(FlipGreen, IsExactInTheBlocksOfATexture) {
    const Bytes8 random = noise(16 * 64);
    const std::string blocks(random.begin(), random.end());
    for (const std::uint32_t format : {83U, 84U}) {
        for (const bool is_small : {false, true}) {
            const std::string large = std::string(16 * 256, '\x55') + blocks;
            const std::string file = is_small ? ddsFile(format, 32, 32, blocks) : ddsFile(format, 64, 64, large, 2);
            const Result<FlippedImage> result = flipGreen(bytesOf(file));
            ASSERT_TRUE(result);
            EXPECT_TRUE(result->report.is_exact);
            EXPECT_EQ(result->report.format, ImageFileFormat::dds);
            Bytes8 after = result->bytes;
            const std::size_t head = 148 + (is_small ? 0 : 16 * 256);
            const std::string level(after.begin() + static_cast<std::ptrdiff_t>(head), after.end());
            const auto before = floatsOf(bytesOf(ddsFile(format, 32, 32, blocks)));
            const auto inverted = floatsOf(bytesOf(ddsFile(format, 32, 32, level)));
            ASSERT_TRUE(before && inverted);
            for (std::size_t i = 0; i < before->texels.size(); ++i) {
                ASSERT_EQ(inverted->texels[i].x, before->texels[i].x);
                ASSERT_NEAR(inverted->texels[i].y, 1 - before->texels[i].y, 1e-7);
            }
        }
    }
}

TEST(FlipGreen, ReportsUnchangedPartsOfATruncatedDds) {
    const std::string blocks(16 * 64, '\x55');
    const Result<FlippedImage> whole = flipGreen(bytesOf(ddsFile(83, 32, 32, blocks + blocks, 2)));
    ASSERT_TRUE(whole);
    EXPECT_TRUE(whole->report.warnings.empty());
    const Result<FlippedImage> cut = flipGreen(bytesOf(ddsFile(83, 32, 32, blocks + "half of a level", 3)));
    ASSERT_TRUE(cut);
    ASSERT_EQ(cut->report.warnings.size(), 1U);
    EXPECT_NE(cut->report.warnings[0].find("the last 2 of 3 mip levels"), std::string::npos) << cut->report.warnings[0];
    EXPECT_EQ(std::string(cut->bytes.end() - 15, cut->bytes.end()), "half of a level");
}

TEST(FlipGreen, IsExactInPlainTextures) {
    const Bytes8 random = noise(16 * 16 * 16);
    for (const auto& [format, bytes] : {std::pair(16U, 2),
                                        {17U, 2},
                                        {23U, 3},
                                        {30U, 3},
                                        {38U, 4},
                                        {44U, 4},
                                        {64U, 4},
                                        {77U, 4},
                                        {78U, 4},
                                        {91U, 8}}) {
        const std::string data(random.begin(), random.begin() + 256 * bytes);
        const std::string file = ktx2File({.format = format, .width = 16, .height = 16, .levels = {data}});
        const Bytes8 after = flipped(bytesOf(file));
        const auto was = floatsOf(bytesOf(file)), is = floatsOf(after);
        ASSERT_TRUE(was && is) << format;
        for (std::size_t i = 0; i < was->texels.size(); ++i) {
            ASSERT_EQ(is->texels[i].x, was->texels[i].x);
            ASSERT_EQ(is->texels[i].z, was->texels[i].z);
            ASSERT_NEAR(is->texels[i].y, 1 - was->texels[i].y, 1e-6) << format;
        }
    }
}

TEST(FlipGreen, InvertsYInAlpha) {
    const RgbImage map = normalMapOf(32, bumps);
    std::string data;
    for (std::size_t i = 0; i < map.rgb.size(); i += 3) {
        const char x = static_cast<char>(map.rgb[i]);
        data += std::string{x, x, x, static_cast<char>(map.rgb[i + 1])};
    }
    const Result<FlippedImage> result = flipGreen(bytesOf(ddsFile(28, 32, 32, data)));
    ASSERT_TRUE(result);
    EXPECT_EQ(result->report.warnings.size(), 1u);
    for (std::size_t i = 0; i < data.size(); ++i) {
        const auto was = static_cast<std::uint8_t>(data[i]), is = result->bytes[148 + i];
        ASSERT_EQ(is, i % 4 == 3 ? 255 - was : was);
    }
}

TEST(FlipGreen, WritesAPngIfTheTextureFormatCannotRepresentIt) {
    const RgbImage map = normalMapOf(32, bumps);
    const std::string data = redAndGreen(map);
    Ktx2Parts parts{.format = 16, .width = 32, .height = 32, .levels = {zstdOf(data)}, .unpacked = {data.size()}};
    parts.scheme = 2;
    const std::string file = ktx2File(parts);
    EXPECT_EQ(whyNot(bytesOf(file)), ErrorCode::unsupportedFile);
    EXPECT_EQ(whyNot(bytesOf(ddsFile(98, 4, 4, std::string(16, 'x')))), ErrorCode::unsupportedFile);
    EXPECT_EQ(whyNot(bytesOf(ddsFile(80, 4, 4, std::string(8, 'x')))), ErrorCode::unsupportedFile) << "gray";
    EXPECT_EQ(whyNot(bytesOf(maskedDdsFile(16, {0xff, 0, 0, 0xff00}, 1, 1, "ab"))), ErrorCode::unsupportedFile);
    EXPECT_EQ(whyNot(bytesOf(file.substr(0, 90))), ErrorCode::invalidFile);
    const Result<FlippedImage> png = flipGreen(bytesOf(file), {.format = ImageFileFormat::png});
    ASSERT_TRUE(png);
    EXPECT_TRUE(png->report.is_exact);
    EXPECT_EQ(png->report.warnings.size(), 1u) << "z was made";
    const auto image = floatsOf(png->bytes);
    ASSERT_TRUE(image);
    for (std::size_t i = 0; i < image->texels.size(); ++i) {
        EXPECT_NEAR(image->texels[i].x, map.rgb[3 * i] / 255.0, 1e-5);
        EXPECT_NEAR(image->texels[i].y, 1 - map.rgb[3 * i + 1] / 255.0, 1e-5);
        EXPECT_NEAR(image->texels[i].z, map.rgb[3 * i + 2] / 255.0, 0.01);
    }
}

TEST(FlipGreen, KeepsThePixelsOfAPaletteAndInvertsItsColors) {
    const Bytes8 samples = {0, 1, 2, 1};
    const Bytes8 file = makePng({2, 2, 8, kPalette, 0, 0, 0}, samples, [](spng_ctx* context) {
        spng_plte palette{3, {}};
        for (std::uint8_t i = 0; i < 3; ++i) palette.entries[i] = {i, static_cast<std::uint8_t>(10 * i), 255, 255};
        spng_set_plte(context, &palette);
    });
    const ReadPng read = readPng(flipped(file));
    EXPECT_EQ(read.samples, samples);
    ASSERT_EQ(read.palette.n_entries, 3u);
    for (std::uint8_t i = 0; i < 3; ++i) {
        EXPECT_EQ(read.palette.entries[i].red, i);
        EXPECT_EQ(read.palette.entries[i].green, 255 - 10 * i);
        EXPECT_EQ(read.palette.entries[i].blue, 255);
    }
}

TEST(FlipGreen, InvertsTheTransparentColorWithTheTexelsThatHaveIt) {
    const Bytes8 file = makePng({1, 1, 8, kRgb, 0, 0, 0}, {1, 2, 3}, [](spng_ctx* context) {
        spng_trns transparency{};
        transparency.red = 1;
        transparency.green = 2;
        transparency.blue = 3;
        spng_set_trns(context, &transparency);
    });
    const ReadPng read = readPng(flipped(file));
    EXPECT_EQ(read.samples, (Bytes8{1, 253, 3}));
    EXPECT_EQ(read.transparency.red, 1);
    EXPECT_EQ(read.transparency.green, 253);
}

TEST(FlipGreen, KeepsColorChunksAndAddsNone) {
    const Bytes8 plain = makePng({2, 2, 8, kRgb, 0, 0, 0}, noise(12));
    EXPECT_FALSE(readPng(flipped(plain)).has_gamma);
    EXPECT_FALSE(readPng(flipped(plain)).has_srgb);
    const Bytes8 tagged =
        makePng({2, 2, 8, kRgb, 0, 0, 0}, noise(12), [](spng_ctx* context) { spng_set_gama(context, 0.45455); });
    EXPECT_TRUE(readPng(flipped(tagged)).has_gamma);
}

TEST(FlipGreen, WritesJpegNearlyExactlyAndKeepsItsMetadata) {
    const RgbImage map = normalMapOf(64, bumps);
    std::string jpeg = jpegFile(map, 95);
    const std::string comment = std::string("\xff\xfe\x00\x07hello", 9);
    jpeg.insert(2 + 18, comment);  // after the start marker and the JFIF segment
    std::string why;
    const std::optional<RgbImage> before = decodeImage(bytesOf(jpeg), 1 << 20, why);
    ASSERT_TRUE(before) << why;
    const Result<FlippedImage> result = flipGreen(bytesOf(jpeg));
    ASSERT_TRUE(result);
    EXPECT_FALSE(result->report.is_exact);
    EXPECT_EQ(result->report.warnings.size(), 1u);
    const std::string out(result->bytes.begin(), result->bytes.end());
    EXPECT_NE(out.find(comment), std::string::npos);
    const std::optional<RgbImage> after = decodeImage(result->bytes, 1 << 20, why);
    ASSERT_TRUE(after) << why;
    double sum = 0;
    for (std::size_t i = 0; i < before->rgb.size(); ++i) {
        const int expected = i % 3 == 1 ? 255 - before->rgb[i] : before->rgb[i];
        sum += std::abs(expected - after->rgb[i]);
    }
    EXPECT_LT(sum / static_cast<double>(before->rgb.size()), 1);
}

TEST(FlipGreen, MakesAnExactPngOfJpegAndWebp) {
    const RgbImage map = normalMapOf(32, bumps);
    for (const std::string& file : {jpegFile(map, 80), webpFile(map, false)}) {
        std::string why;
        const std::optional<RgbImage> before = decodeImage(bytesOf(file), 1 << 20, why);
        const Result<FlippedImage> result = flipGreen(bytesOf(file), {.format = ImageFileFormat::png});
        ASSERT_TRUE(before && result);
        EXPECT_TRUE(result->report.is_exact);
        const ReadPng png = readPng(result->bytes);
        ASSERT_EQ(png.samples.size(), before->rgb.size());
        for (std::size_t i = 0; i < png.samples.size(); ++i) {
            ASSERT_EQ(png.samples[i], i % 3 == 1 ? 255 - before->rgb[i] : before->rgb[i]);
        }
    }
}

TEST(FlipGreen, WritesWebpWithoutLoss) {
    const std::string file = webpFile(normalMapOf(32, bumps), false);
    std::string why;
    const std::optional<RgbImage> before = decodeImage(bytesOf(file), 1 << 20, why);
    const std::optional<RgbImage> after = decodeImage(flipped(bytesOf(file)), 1 << 20, why);
    ASSERT_TRUE(before && after);
    for (std::size_t i = 0; i < before->rgb.size(); ++i) {
        ASSERT_EQ(after->rgb[i], i % 3 == 1 ? 255 - before->rgb[i] : before->rgb[i]);
    }
}

TEST(FlipGreen, RejectsImagesWithoutGreenAndUnreadableOnes) {
    const Bytes8 gray = makePng({2, 2, 8, kGray, 0, 0, 0}, noise(4));
    const Bytes8 color = makePng({8, 8, 8, kRgb, 0, 0, 0}, noise(192));
    EXPECT_EQ(whyNot(gray), ErrorCode::unsupportedFile);
    EXPECT_EQ(whyNot(bytesOf("\xabKTX 20\xbb\r\n\x1a\n")), ErrorCode::invalidFile);
    EXPECT_EQ(whyNot(bytesOf("")), ErrorCode::unsupportedFile);
    EXPECT_EQ(whyNot(std::span(color).first(color.size() / 2)), ErrorCode::invalidFile);
    EXPECT_EQ(whyNot(std::span(color).first(20)), ErrorCode::invalidFile);
    EXPECT_EQ(whyNot(color, {.format = ImageFileFormat::jpeg}), ErrorCode::unsupportedFile);
    EXPECT_EQ(whyNot(color, {.jpeg_quality = 0}), ErrorCode::invalidOption);
    Bytes8 vast = color;
    // Width and height become huge. The image is interlaced, so it would have to be kept in memory completely.
    vast[16] = vast[20] = 0x10;
    vast[28] = 1;
    EXPECT_EQ(whyNot(vast), ErrorCode::tooLarge);
}

TEST(FlipGreen, SurvivesBrokenFiles) {
    const RgbImage map = normalMapOf(24, bumps);
    const std::string png = pngFile(map);
    const std::string files[] = {png, jpegFile(map, 80), webpFile(map, true)};
    EXPECT_TRUE(rc::check([&] {
        std::string file = files[*rc::gen::inRange(0, 3)];
        for (int i = 0; i < *rc::gen::inRange(1, 5); ++i) {
            file[*rc::gen::inRange<std::size_t>(3, file.size())] = *rc::gen::arbitrary<char>();
        }
        if (*rc::gen::inRange(0, 4) == 0) file.resize(*rc::gen::inRange<std::size_t>(0, file.size()));
        const Result<FlippedImage> result = flipGreen(bytesOf(file));
        if (result) RC_ASSERT(!result->bytes.empty());
    }));
}

TEST(FlipGreenFile, WritesTheFormatOfTheNameAtOnceOrNothing) {
    const TempFolder folder;
    const std::string in = folder.write("n.jpg", jpegFile(normalMapOf(16, bumps), 90));
    const Result<FlipGreenReport> report = flipGreenFile(in, folder.path("out.png").string());
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->format, ImageFileFormat::png);
    EXPECT_TRUE(report->is_exact);
    EXPECT_EQ(flipGreenFile(in, folder.path("out.tga").string()).error().code, ErrorCode::invalidOption);
    EXPECT_EQ(flipGreenFile(folder.path("none.png").string(), folder.path("b.png").string()).error().code,
              ErrorCode::cannotRead);
    EXPECT_FALSE(std::filesystem::exists(folder.path("b.png")));
}

/// Returns only the header of a PNG, padded to the given file size.
Bytes8 claimingPng(std::uint32_t width, std::uint32_t height, std::uint8_t bits, std::uint8_t color,
                   std::size_t bytes) {
    Bytes8 file = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0, 0, 0, 13, 'I', 'H', 'D', 'R'};
    for (const std::uint32_t number : {width, height}) {
        for (int shift = 24; shift >= 0; shift -= 8) file.push_back(static_cast<std::uint8_t>(number >> shift));
    }
    file.insert(file.end(), {bits, color, 0, 0, 0});
    file.resize(bytes);
    return file;
}

ErrorCode codeOf(const Bytes8& file, std::uint64_t memory_limit_bytes = 0) {
    const Result<FlippedImage> flipped = flipGreen(file, {.memory_limit_bytes = memory_limit_bytes});
    return flipped ? ErrorCode::ok : flipped.error().code;
}

TEST(FlipGreen, RejectsDeclaredRowsQuickly) {
    constexpr std::uint64_t kGigabyte = std::uint64_t{1} << 30;
    for (const std::uint8_t color : {kRgb, kPalette, kRgba}) {
        const Bytes8 thin = claimingPng(1, 0x7fffffff, 8, color, 194'000);
        EXPECT_EQ(codeOf(thin), ErrorCode::tooLarge);
        EXPECT_EQ(codeOf(thin, kGigabyte), ErrorCode::tooLarge);
        EXPECT_EQ(codeOf(thin, 4 * kGigabyte), ErrorCode::invalidFile) << "looked at, and found to be broken";
    }
    EXPECT_EQ(codeOf(claimingPng(16384, 16384, 8, kRgb, 800'000)), ErrorCode::invalidFile) << "of one color";
    EXPECT_EQ(codeOf(claimingPng(16384, 16384, 8, kPalette, 40'000)), ErrorCode::invalidFile);
    EXPECT_EQ(codeOf(claimingPng(8192, 8192, 16, kRgba, 500'000)), ErrorCode::invalidFile);
    EXPECT_EQ(codeOf(claimingPng(60000, 60000, 8, kRgb, 200'000'000)), ErrorCode::invalidFile);
}

TEST(FlipGreen, AcceptsLargeImagesOfOneColor) {
    constexpr std::uint32_t kSide = 4096;
    spng_ihdr header{};
    header.width = header.height = kSide;
    header.bit_depth = 8;
    header.color_type = kRgb;
    const Bytes8 file = makePng(header, Bytes8(std::size_t{3} * kSide * kSide, 128));
    EXPECT_LT(file.size(), 100'000U);
    EXPECT_EQ(codeOf(file), ErrorCode::ok);
}

}  // namespace
}  // namespace tspace::test
