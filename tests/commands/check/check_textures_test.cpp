// SPDX-License-Identifier: MIT
// checkFile: normal maps in KTX2, DDS and WebP files, in other channels, and with lossy compression.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "commands/check/test_model.h"
#include "core/base/vec_math.h"
#include "images/float_image.h"
#include "images/known_blocks.h"
#include "images/textures.h"

namespace tspace::test {
namespace {

using gltf::Json;

TEST(CheckFile, NamesTheFormatOfAnUnsupportedImage) {
    TestModel model;
    model.folder.write("normal.png", "\xabKTX 20\xbb\r\n\x1a\n");
    model.setTextureExtension("KHR_texture_basisu");
    const CheckReport report = model.check();
    ASSERT_EQ(codes(report), CodeCounts{"note normalMapUnreadable"});
    EXPECT_NE(report.findings[0].message.find("the KTX2 is damaged"), std::string::npos);
}

/// Returns a KTX2 file of a map with x, y and z, compressed with Zstandard.
std::string plainKtx2(bool green_down) {
    const RgbImage map = normalMapOf(256, bumps, green_down);
    const std::string data(map.rgb.begin(), map.rgb.end());
    Ktx2Parts parts{.format = 23, .width = 256, .height = 256, .levels = {zstdOf(data)}, .unpacked = {data.size()}};
    parts.scheme = 2;
    return ktx2File(parts);
}

TEST(CheckFile, ReadsKtx2AndDds) {
    TestModel model;
    model.setTextureExtension("KHR_texture_basisu");
    model.folder.write("normal.png", plainKtx2(false));
    EXPECT_EQ(codes(model.check()), CodeCounts{});
    model.folder.write("normal.png", plainKtx2(true));
    EXPECT_EQ(codes(model.check()), CodeCounts{"warning greenFlipped"});
    model.setTextureExtension("MSFT_texture_dds");
    model.folder.write("normal.png", ddsFile(83, 256, 256, bc5Blocks(normalMapOf(256, bumps))));
    const CheckReport report = model.check();
    ASSERT_EQ(codes(report), (CodeCounts{"warning normalMapTwoChannels", "note normalMapLevels"}));
    EXPECT_NE(report.findings[0].message.find("(format: BC5 in a DDS)"), std::string::npos);
    EXPECT_NE(report.findings[0].remedy.find("--fix-maps"), std::string::npos) << report.findings[0].remedy;
    model.folder.write("normal.png", ddsFile(83, 256, 256, bc5Blocks(normalMapOf(256, bumps, true))));
    EXPECT_EQ(codes(model.check()),
              (CodeCounts{"warning normalMapTwoChannels", "warning greenFlipped", "note normalMapLevels"}));
    // If a sampler reads only the largest level, the file needs no other levels.
    model.builder.json()["textures"][0]["sampler"] = 0;
    for (const auto& [filter, reads_levels] : {std::pair(9729, false), std::pair(9987, true)}) {
        model.builder.json()["samplers"] = Json::array({{{"minFilter", filter}}});
        const CodeCounts found = codes(model.check());
        EXPECT_EQ(std::count(found.begin(), found.end(), "note normalMapLevels"), reads_levels ? 1 : 0) << filter;
    }
}

/// Returns the error in degrees that a finding states for the texels.
double degreesIn(const Finding& finding) {
    const std::size_t at = finding.message.find("about ");
    return at == std::string::npos ? 0 : std::atof(finding.message.c_str() + at + 6);
}

/// Returns the RMS angle between the texels of a file and normalMapOf(size, bumps).
double degreesOff(const std::string& file, std::uint32_t size) {
    std::string why;
    const std::optional<RgbImage> packed = decodeImage(bytesOf(file), 1 << 20, why);
    EXPECT_TRUE(packed) << why;
    const RgbImage map = normalMapOf(size, bumps);
    double sum = 0;
    const auto vector = [](const RgbImage& image, std::size_t i) {
        DVec3 normal{image.rgb[i] / 127.5 - 1, image.rgb[i + 1] / 127.5 - 1, image.rgb[i + 2] / 127.5 - 1};
        normalize(normal);
        return normal;
    };
    for (std::size_t i = 0; packed && i < map.rgb.size(); i += 3) {
        const DVec3 a = vector(map, i), b = vector(*packed, i);
        const double angle = std::atan2(length(cross(a, b)), dot(a, b)) * 57.29577951308232;
        sum += angle * angle;
    }
    return std::sqrt(3 * sum / static_cast<double>(map.rgb.size()));
}

TEST(CheckFile, EstimatesTheErrorOfVectorsCompressedAsColors) {
    TestModel model;
    model.setTextureExtension("EXT_texture_webp");
    const RgbImage map = normalMapOf(256, bumps);
    model.folder.write("normal.png", webpFile(map, true));
    EXPECT_EQ(codes(model.check()), CodeCounts{});
    const std::string webp = webpFile(map, false), etc1s = bytesOfHex(kEtc1sNormals);
    model.folder.write("normal.png", webp);
    const CheckReport lossy = model.check();
    ASSERT_EQ(codes(lossy), CodeCounts{"note normalMapLossy"});
    EXPECT_NEAR(degreesIn(lossy.findings[0]) / degreesOff(webp, 256), 0.9, 0.25) << lossy.findings[0].message;
    model.setTextureExtension("KHR_texture_basisu");
    model.folder.write("normal.png", etc1s);
    const CheckReport coarse = model.check();
    ASSERT_EQ(codes(coarse), (CodeCounts{"note normalMapLossy", "note normalMapLevels"}));
    EXPECT_NE(coarse.findings[0].message.find("ETC1S"), std::string::npos);
    EXPECT_NEAR(degreesIn(coarse.findings[0]) / degreesOff(etc1s, 64), 0.9, 0.25) << coarse.findings[0].message;
}

TEST(CheckFile, FindsATextureThatDeclaresLinearNumbersAsSrgb) {
    const RgbImage map = normalMapOf(256, bumps);
    Ktx2Parts parts{.format = 29, .width = 256, .height = 256, .levels = {{map.rgb.begin(), map.rgb.end()}}};
    parts.unpacked = {map.rgb.size()};
    parts.transfer = 2;
    TestModel model;
    model.setTextureExtension("KHR_texture_basisu");
    model.folder.write("normal.png", ktx2File(parts));
    const CheckReport report = model.check();
    ASSERT_EQ(codes(report), CodeCounts{"warning normalMapIsSrgb"});
    EXPECT_NE(report.findings[0].remedy.find("linear"), std::string::npos) << report.findings[0].remedy;
    // If the values are sRGB-encoded too, there is still one finding, which is about the values.
    for (char& byte : parts.levels[0]) {
        const double part = static_cast<unsigned char>(byte) / 255.0;
        const double coded = part <= 0.0031308 ? 12.92 * part : 1.055 * std::pow(part, 1 / 2.4) - 0.055;
        byte = static_cast<char>(static_cast<unsigned char>(255 * coded + 0.5));
    }
    model.folder.write("normal.png", ktx2File(parts));
    EXPECT_EQ(codes(model.check()), CodeCounts{"warning normalMapIsSrgb"});
}

TEST(CheckFile, FindsXAndYInOtherChannelsOfATexture) {
    // Waves along each axis distinguish x from y, whereas products of waves along both do not.
    const RgbImage map = normalMapOf(256, [](double x, double y) {
        return 0.012 * std::sin(50 * x) + 0.01 * std::cos(43 * y) + 0.006 * std::cos(30 * x) * std::sin(31 * y);
    });
    std::string in_colors, in_alpha, in_green;
    for (std::size_t i = 0; i < map.rgb.size(); i += 3) {
        const char x = static_cast<char>(map.rgb[i]), y = static_cast<char>(map.rgb[i + 1]);
        in_colors += std::string{x, x, x, y};
        in_alpha += std::string{y, y, y, x};
        in_green += std::string{'\xff', y, '\xff', x};
    }
    TestModel model;
    for (const auto& [data, says] : {std::pair(in_colors, "x in red and y in alpha"),
                                     {in_alpha, "x in alpha and y in red"},
                                     {in_green, "x in alpha and y in green"}}) {
        model.folder.write("normal.png", ddsFile(28, 256, 256, data));
        const CheckReport report = model.check();
        ASSERT_EQ(codes(report), CodeCounts{"warning normalMapChannels"}) << says;
        EXPECT_NE(report.findings[0].message.find(says), std::string::npos) << report.findings[0].message;
        FloatImage png{256, 256, 8, {}, {}};
        for (std::size_t i = 0; i < data.size(); i += 4) {
            const auto part = [texel = data.data() + i](std::size_t k) {
                return static_cast<float>(static_cast<unsigned char>(texel[k])) / 255.0F;
            };
            png.texels.push_back({part(0), part(1), part(2)});
            png.alpha.push_back(part(3));
        }
        model.folder.write("normal.png", std::span<const std::uint8_t>(*encodePng(png, 8)));
        const CheckReport of_png = model.check();
        ASSERT_EQ(codes(of_png), CodeCounts{"warning normalMapChannels"}) << says;
        EXPECT_NE(of_png.findings[0].message.find(says), std::string::npos) << of_png.findings[0].message;
    }
}

TEST(CheckFile, ReadsWebp) {
    TestModel model;
    model.folder.write("normal.png", webpFile(normalMapOf(256, bumps, true), false));
    model.setTextureExtension("EXT_texture_webp");
    EXPECT_EQ(codes(model.check()), (CodeCounts{"warning greenFlipped", "note normalMapLossy"}));
}

TEST(CheckFile, ExaminesNormalMapsOfUnknownExtensions) {
    TestModel model;
    model.folder.write("normal.png", pngFile(normalMapOf(256, bumps, true)));
    Json& material = model.builder.json()["materials"][0];
    const Json texture = material["normalTexture"];
    material.erase("normalTexture");
    for (const char* member : {"detailNormalTexture", "normalTexture"}) {
        material["extensions"] = {{"EXT_layers", {{"layers", Json::array({{{member, texture}}})}}}};
        const CheckReport report = model.check();
        EXPECT_EQ(report.image_count, 1U);
        const auto found = std::find_if(report.findings.begin(), report.findings.end(), [](const Finding& finding) {
            return finding.code == FindingCode::greenFlipped;
        });
        ASSERT_NE(found, report.findings.end()) << member;
        EXPECT_EQ(found->severity, Severity::note) << "the extension may define another encoding";
        EXPECT_NE(found->message.find(std::string("only ") + member + " of the material extension EXT_layers"),
                  std::string::npos)
            << found->message;
        EXPECT_EQ(found->remedy.find("generate"), std::string::npos) << found->remedy;
    }
    material["extensions"]["EXT_layers"]["layers"][0] = {{"normalTexture", {{"index", 0}, {"texCoord", "x"}}}};
    EXPECT_EQ(model.check().image_count, 0U);
}

}  // namespace
}  // namespace tspace::test
