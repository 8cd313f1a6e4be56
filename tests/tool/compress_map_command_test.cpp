// SPDX-License-Identifier: MIT
// tspace compress-map.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/vec_math.h"
#include "images/float_image.h"
#include "images/images.h"
#include "maps/texels/shading.h"
#include "run_tool.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;

/// Writes a map of gentle waves with 8 and with 16 bits.
void writeWaves(const TempFolder& folder) {
    constexpr std::uint32_t kSize = 96;
    FloatImage image{kSize, kSize, 16, {}, {}};
    for (std::uint32_t i = 0; i < kSize * kSize; ++i) {
        const double u = (i % kSize + 0.5) / kSize, v = (i / kSize + 0.5) / kSize;
        const double x = 0.2 * std::sin(6.2831853 * u), y = 0.15 * std::sin(6.2831853 * (u + v));
        const double z = std::sqrt(1 - x * x - y * y);
        image.texels.push_back(
            {static_cast<float>(0.5 + 0.5 * x), static_cast<float>(0.5 + 0.5 * y), static_cast<float>(0.5 + 0.5 * z)});
    }
    for (const unsigned bits : {8U, 16U}) {
        const auto file = encodePng(image, bits);
        ASSERT_TRUE(file);
        folder.write("n" + std::to_string(bits) + ".png", std::span<const std::uint8_t>(*file));
    }
}

Json reportOf(const TempFolder& folder, const std::string& arguments) {
    const ToolRun run = runTool(folder, "compress-map --json " + arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return Json::parse(run.out);
}

TEST(CompressMapCommand, IsMoreAccurateFor16BitInputs) {
    const TempFolder folder;
    writeWaves(folder);
    const Json coarse = reportOf(folder, "n8.png -o a.dds"), fine = reportOf(folder, "n16.png -o b.dds");
    // The measured error is 0.063 degrees. Rounding to 8 bits alone causes a mean error of more than 0.1 degrees.
    EXPECT_LT(fine["meanErrorDeg"].get<double>(), 0.07);
    EXPECT_EQ(fine["levels"], 7);
    EXPECT_EQ(coarse["bitsBefore"], 8);
    std::string why;
    const auto map = decodeFloatImage(bytesOf(folder.read("n16.png")), 1 << 20, why);
    const auto from = [&](const std::string& name) {
        double sum = 0;
        const auto image = decodeFloatImage(bytesOf(folder.read(name)), 1 << 20, why);
        EXPECT_TRUE(image) << why;
        for (std::size_t i = 0; image && i < map->texels.size(); ++i)
            sum += std::fabs(image->texels[i].x - map->texels[i].x) + std::fabs(image->texels[i].y - map->texels[i].y);
        return sum;
    };
    EXPECT_LT(from("b.dds"), 0.6 * from("a.dds"));
}

/// Returns one channel of a texel of a BC5 block, by the formula in the format's specification.
double bc4(const std::string& file, std::size_t block, std::size_t texel) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(file[block + i])); };
    const std::size_t bit = 3 * texel;
    const unsigned low = byte(2 + bit / 8), high = bit / 8 < 5 ? byte(3 + bit / 8) : 0;
    const unsigned code = ((low | high << 8) >> (bit % 8)) & 7;
    const double a = byte(0), b = byte(1);
    if (code < 2) return (code == 0 ? a : b) / 255;
    if (a > b) return ((8 - code) * a + (code - 1) * b) / 7 / 255;
    return code == 6 ? 0 : code == 7 ? 1 : ((6 - code) * a + (code - 1) * b) / 5 / 255;
}

TEST(CompressMapCommand, TheErrorIsThatOfTheFileAsItIsDecodedAndFiltered) {
    const TempFolder folder;
    writeWaves(folder);
    const Json report = reportOf(folder, "n16.png -o n.dds");
    std::string why;
    const auto map = decodeFloatImage(bytesOf(folder.read("n16.png")), 1 << 20, why);
    ASSERT_TRUE(map) << why;
    const std::string file = folder.read("n.dds");
    constexpr std::size_t kSize = 96, kHead = 148, kPoints = 5;
    const auto truthAt = [&](std::size_t x, std::size_t y) {
        const Vec3& texel = map->texels[y % kSize * kSize + x % kSize];
        DVec3 normal{2.0 * texel.x - 1, 2.0 * texel.y - 1, 2.0 * texel.z - 1};
        normalize(normal);
        return normal;
    };
    const auto packedAt = [&](std::size_t x, std::size_t y) {
        x %= kSize, y %= kSize;
        const std::size_t block = kHead + 16 * (y / 4 * (kSize / 4) + x / 4), texel = y % 4 * 4 + x % 4;
        return DVec3{2 * bc4(file, block, texel) - 1, 2 * bc4(file, block + 8, texel) - 1, 0};
    };
    double sum = 0;
    for (std::size_t i = 0; i < kSize * kSize * kPoints * kPoints; ++i) {
        const std::size_t at = i / (kPoints * kPoints), x = at % kSize, y = at / kSize;
        const double s = (i % kPoints + 0.5) / kPoints, t = (i / kPoints % kPoints + 0.5) / kPoints;
        const auto filtered = [&](const auto& texelAt) {
            return (1 - s) * (1 - t) * texelAt(x, y) + s * (1 - t) * texelAt(x + 1, y) +
                   (1 - s) * t * texelAt(x, y + 1) + s * t * texelAt(x + 1, y + 1);
        };
        const DVec3 shaded = filtered(truthAt);
        DVec3 packed = filtered(packedAt);
        packed.z = std::sqrt(1 - packed.x * packed.x - packed.y * packed.y);
        sum += std::atan2(length(cross(shaded, packed)), dot(shaded, packed)) * 57.29577951308232;
    }
    const double mean = sum / (kSize * kSize * kPoints * kPoints);
    // This test uses other sample points than the tool, so the values may differ by 5 %.
    EXPECT_NEAR(report["meanErrorDeg"].get<double>(), mean, 0.05 * mean);
}

TEST(CompressMapCommand, WritesTheSameBlocksInBothFilesAndForAnyNumberOfThreads) {
    const TempFolder folder;
    writeWaves(folder);
    for (const std::string sign : {"", " --signed"}) {
        reportOf(folder, "n16.png -o a.dds --threads 1" + sign);
        reportOf(folder, "n16.png -o b.dds --threads 5" + sign);
        reportOf(folder, "n16.png -o a.ktx2" + sign);
        EXPECT_EQ(folder.read("a.dds"), folder.read("b.dds"));
        std::string why;
        const auto dds = decodeFloatImage(bytesOf(folder.read("a.dds")), 1 << 20, why);
        const auto ktx2 = decodeFloatImage(bytesOf(folder.read("a.ktx2")), 1 << 20, why);
        ASSERT_TRUE(dds && ktx2);
        EXPECT_EQ(dds->texels, ktx2->texels);
    }
    EXPECT_EQ(reportOf(folder, "n16.png -o c.dds --no-levels")["outputBytes"], 148 + 24 * 24 * 16);
    EXPECT_EQ(runTool(folder, "compress-map n16.png -o - > piped.ktx2").exit_code, 0);
}

TEST(CompressMapCommand, EveryFormatIsReadAgainAsTheMap) {
    const TempFolder folder;
    writeWaves(folder);
    std::string why;
    const auto map = decodeFloatImage(bytesOf(folder.read("n16.png")), 1 << 20, why);
    ASSERT_TRUE(map) << why;
    for (const std::string arguments :
         {"-o n.ktx2", "-o n.ktx2 --format eac-rg11", "-o n.ktx2 --format rg8", "-o n.ktx2 --format rg8 --signed",
          "-o n.ktx2 --format eac-rg11 --signed --quality best", "-o n.ktx2 --quality quick --mips",
          "-o n.dds --format rg8"}) {
        const Json report = reportOf(folder, "n16.png " + arguments);
        const auto image = decodeFloatImage(bytesOf(folder.read(report["output"].get<std::string>())), 1 << 20, why);
        ASSERT_TRUE(image) << why;
        ASSERT_EQ(image->texels.size(), map->texels.size());
        for (std::size_t i = 0; i < map->texels.size(); ++i) {
            ASSERT_NEAR(image->texels[i].x, map->texels[i].x, 0.006) << arguments;
            ASSERT_NEAR(image->texels[i].y, map->texels[i].y, 0.006) << arguments;
        }
        EXPECT_LT(report["meanErrorDeg"], 0.15);
        EXPECT_LE(report["meanErrorDeg"], report["p99ErrorDeg"]);
        EXPECT_LE(report["p99ErrorDeg"], report["maxErrorDeg"]);
        EXPECT_LT(report["maxErrorX"], 97);
    }
}

TEST(CompressMapCommand, CompressesAstcOrReportsTheMissingLibrary) {
    const TempFolder folder;
    writeWaves(folder);
    const ToolRun first = runTool(folder, "compress-map n16.png -o a.ktx2 --format astc-4x4 --threads 1");
    if (first.exit_code != 0) {
        EXPECT_NE(first.err.find("astcenc"), std::string::npos) << first.err;
        EXPECT_EQ(first.errorLines(), 1);
        GTEST_SKIP() << first.err;
    }
    const Json report = reportOf(folder, "n16.png -o b.ktx2 --format astc-4x4 --threads 3");
    EXPECT_EQ(report["format"], "ASTC 4x4");
    EXPECT_EQ(report["levels"], 7);
    EXPECT_EQ(folder.read("a.ktx2"), folder.read("b.ktx2"));
    // The report matches the file as other commands read it.
    const Json error = Json::parse(runTool(folder, "map-error --json b.ktx2 --source n16.png").out);
    EXPECT_EQ(error["makesZ"], true);
    EXPECT_NEAR(report["meanErrorDeg"].get<double>(), error["meanErrorDeg"].get<double>(), 1e-6);
    EXPECT_LT(report["meanErrorDeg"], 0.15);
    const Json best = reportOf(folder, "n16.png -o c.ktx2 --format astc-4x4 --quality best");
    EXPECT_LT(best["meanErrorDeg"], report["meanErrorDeg"]);
    for (const std::string arguments : {"-o d.dds --format astc-4x4", "-o d.ktx2 --format astc-4x4 --signed"})
        EXPECT_EQ(runTool(folder, "compress-map n16.png " + arguments).exit_code, 2) << arguments;
}

TEST(CompressMapCommand, ExplainsWhyUastcIsUnsupported) {
    const TempFolder folder;
    const ToolRun run = runTool(folder, "compress-map n.png -o n.ktx2 --format uastc");
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_EQ(run.errorLines(), 1) << run.err;
    EXPECT_NE(run.err.find("basisu"), std::string::npos) << run.err;
    const ToolRun model = runTool(folder, "generate a.glb -o b.glb --compress-maps uastc");
    EXPECT_EQ(model.exit_code, 2);
    EXPECT_EQ(model.errorLines(), 1) << model.err;
    EXPECT_NE(model.err.find("basisu"), std::string::npos) << model.err;
    const ToolRun other = runTool(folder, "compress-map n.png -o n.ktx2 --format uastk");
    EXPECT_NE(other.err.find("must be one of bc5, eac-rg11, astc-4x4, rg8"), std::string::npos) << other.err;
}

TEST(MapErrorCommand, ReportsTheErrorThatCompressMapReported) {
    const TempFolder folder;
    writeWaves(folder);
    for (const std::string output : {"n.ktx2", "n.dds"}) {
        const Json made = reportOf(folder, "n16.png -o " + output);
        const ToolRun run = runTool(folder, "map-error --json " + output + " --source n16.png");
        ASSERT_EQ(run.exit_code, 0) << run.err;
        const Json report = Json::parse(run.out);
        EXPECT_NEAR(report["meanErrorDeg"].get<double>(), made["meanErrorDeg"].get<double>(), 1e-6);
        EXPECT_NEAR(report["p99ErrorDeg"].get<double>(), made["p99ErrorDeg"].get<double>(), 1e-4);
        EXPECT_EQ(report["makesZ"], true);
    }
    // A PNG with three channels whose values were only rounded.
    const Json rounded = Json::parse(runTool(folder, "map-error --json n8.png --source n16.png").out);
    EXPECT_EQ(rounded["makesZ"], false);
    EXPECT_LT(rounded["meanErrorDeg"], 0.2);
    for (const std::string arguments : {"n.dds", "n.dds --source none.png", "n.dds n16.png --source n16.png"})
        EXPECT_NE(runTool(folder, "map-error " + arguments).exit_code, 0) << arguments;
}

TEST(MapErrorCommand, ExplainsWhatTheErrorOfATextureExcludes) {
    const TempFolder folder;
    writeWaves(folder);
    const auto beside = [&](const std::string& arguments) {
        const ToolRun run = runTool(folder, "map-error --json " + arguments + " --source n16.png");
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return Json::parse(run.out);
    };
    std::string why;
    const auto map = decodeFloatImage(bytesOf(folder.read("n8.png")), 1 << 20, why);
    FloatImage flat_blue = *map, gray = *map;
    for (Vec3& texel : flat_blue.texels) texel.z = 0;
    for (Vec3& texel : gray.texels) texel = {texel.x, texel.x, texel.x};
    folder.write("rg.png", std::span<const std::uint8_t>(*encodePng(flat_blue, 8)));
    folder.write("r.png", std::span<const std::uint8_t>(*encodePng(gray, 8)));
    EXPECT_GT(beside("rg.png")["meanErrorDeg"], 90);
    const Json made = beside("rg.png --two-channels");
    EXPECT_LT(made["meanErrorDeg"], 0.2);
    EXPECT_EQ(made["makesZ"], true);
    EXPECT_EQ(beside("n8.png")["warnings"].size(), 0u);
    ASSERT_EQ(beside("r.png")["warnings"].size(), 1u);
    EXPECT_NE(beside("r.png")["warnings"][0].get<std::string>().find("not a normal map"), std::string::npos);
    // Options without an effect are rejected, and errors name a file once.
    for (const std::string arguments : {"--heat h.png", "--space object", "--material A", "--convention unreal"}) {
        const ToolRun run = runTool(folder, "map-error n8.png --source n16.png " + arguments);
        EXPECT_EQ(run.exit_code, 2) << arguments;
        EXPECT_EQ(run.errorLines(), 1) << run.err;
    }
    folder.write("broken.dds", "DDS ");
    EXPECT_EQ(runTool(folder, "map-error broken.dds --source n16.png").err, "tspace: broken.dds: the DDS is damaged\n");
    EXPECT_NE(runTool(folder, "map-error n8.png --source broken.dds").err.find("the source 'broken.dds'"),
              std::string::npos);
}

/// Returns a normal map of a sphere. Alpha is 1 inside and 0 outside, where texels are black; with `alpha_is_height`,
/// alpha contains heights everywhere. `has_edge`: the sphere is surrounded by texels with alpha 0.5, whose colors are
/// multiplied by alpha.
FloatImage sphereSprite(bool alpha_is_height, bool has_edge) {
    constexpr std::uint32_t kSize = 64;
    FloatImage image{kSize, kSize, 16, {}, {}};
    for (std::uint32_t i = 0; i < kSize * kSize; ++i) {
        const double x = (i % kSize + 0.5) / 30 - 64.0 / 60, y = 64.0 / 60 - (i / kSize + 0.5) / 30;
        const double square = x * x + y * y, z = std::sqrt(std::max(0.0, 1 - square));
        const bool is_inside = square < 0.8, is_edge = has_edge && square > 0.75;
        const float alpha = !is_inside ? 0.0F : is_edge ? 0.5F : 1.0F;
        Vec3 texel{static_cast<float>(0.5 + 0.5 * x), static_cast<float>(0.5 + 0.5 * y),
                   static_cast<float>(0.5 + 0.5 * z)};
        if (alpha_is_height && !is_inside) texel = {0.5F, 0.5F, 1.0F};
        image.texels.push_back(alpha_is_height ? texel : alpha * texel);
        image.alpha.push_back(alpha_is_height && is_inside ? static_cast<float>(z) : alpha);
    }
    return image;
}

/// Returns the largest angle, in degrees, between the texels of a level and the covered part of the sphere.
double mostOff(const TempFolder& folder, unsigned level) {
    std::string why;
    const auto image = decodeFloatImage(bytesOf(folder.read("out/s." + std::to_string(level) + ".png")), 1 << 20, why);
    if (!image) return 180;
    const FloatImage sprite = sphereSprite(false, false);
    double most = 0;
    for (std::uint32_t i = 0; i < image->texels.size(); ++i) {
        DVec3 mean{};
        for (std::uint32_t y = 0; y < 1U << level; ++y) {
            for (std::uint32_t x = 0; x < 1U << level; ++x) {
                const std::size_t at =
                    (std::size_t{i / image->width << level} + y) * 64 + (i % image->width << level) + x;
                const Vec3& t = sprite.texels[at];
                if (sprite.alpha[at] > 0) mean = mean + DVec3{2 * t.x - 1.0, 2 * t.y - 1.0, 2 * t.z - 1.0};
            }
        }
        if (length(mean) < 0.5) continue;
        const Vec3& t = image->texels[i];
        most = std::max(most, degreesBetween({2 * t.x - 1.0, 2 * t.y - 1.0, 2 * t.z - 1.0}, mean));
    }
    return most;
}

TEST(CompressMapCommand, DetectsAlphaThatIsCoverage) {
    const TempFolder folder;
    const auto write = [&](const FloatImage& image) {
        const auto file = encodePng(image, 16);
        ASSERT_TRUE(file);
        folder.write("s.png", std::span<const std::uint8_t>(*file));
    };
    write(sphereSprite(false, false));
    const Json report = reportOf(folder, "s.png -o out/");
    EXPECT_NE(report["warnings"].dump().find("alpha is read as coverage"), std::string::npos) << report;
    for (const unsigned level : {0U, 1U, 2U, 3U}) EXPECT_LT(mostOff(folder, level), 0.1) << level;
    reportOf(folder, "s.png -o out/ --alpha data");
    EXPECT_GT(mostOff(folder, 2), 20);
    // The colors at the edge were multiplied by alpha.
    write(sphereSprite(false, true));
    EXPECT_NE(reportOf(folder, "s.png -o out/")["warnings"].dump().find("divided by it"), std::string::npos);
    for (const unsigned level : {0U, 1U, 2U}) EXPECT_LT(mostOff(folder, level), 4) << level;
    ASSERT_EQ(runTool(folder, "convert-map s.png -q -o c.dds").exit_code, 0);
    reportOf(folder, "s.png -o d.dds");
    EXPECT_EQ(folder.read("c.dds").size(), folder.read("d.dds").size());
    EXPECT_LT(Json::parse(runTool(folder, "map-error c.dds --source d.dds --json").out)["meanErrorDeg"], 0.6);
    // Alpha contains heights, which must not affect the result.
    write(sphereSprite(true, false));
    const Json heights = reportOf(folder, "s.png -o e.dds");
    EXPECT_NE(heights["warnings"].dump().find("set the option alpha to coverage"), std::string::npos) << heights;
    FloatImage opaque = sphereSprite(true, false);
    opaque.alpha.clear();
    write(opaque);
    reportOf(folder, "s.png -o f.dds");
    EXPECT_EQ(folder.read("e.dds"), folder.read("f.dds"));
    EXPECT_NE(reportOf(folder, "s.png -o f.dds --alpha coverage")["warnings"].dump().find("has no alpha"),
              std::string::npos);
}

TEST(ConvertMapCommand, WritesTheSameBlocksAsCompressMapDoes) {
    const TempFolder folder;
    writeWaves(folder);
    const double made = reportOf(folder, "n16.png -o n.dds")["meanErrorDeg"];
    for (const std::string output : {"c.ktx2", "c.dds"}) {
        ASSERT_EQ(runTool(folder, "convert-map n16.png --flip-green -o " + output).exit_code, 0);
        ASSERT_EQ(runTool(folder, "flip-green " + output + " -o turned-" + output).exit_code, 0);
        const ToolRun run = runTool(folder, "map-error --json turned-" + output + " --source n16.png");
        EXPECT_NEAR(Json::parse(run.out)["meanErrorDeg"].get<double>(), made, 0.02 * made);
    }
    EXPECT_NE(runTool(folder, "convert-map n16.png --from object --to object -o c.dds").exit_code, 0);
}

TEST(CompressMapCommand, WritesHeadersOfOlderReaders) {
    const TempFolder folder;
    writeWaves(folder);
    reportOf(folder, "n8.png -o new.dds");
    const std::string blocks = folder.read("new.dds").substr(148);
    for (const auto& [option, code] : {std::pair{"legacy", "ATI2"}, {"bc5u", "BC5U"}, {"legacy --signed", "BC5S"}}) {
        reportOf(folder, std::string("n8.png -o old.dds --dds-header ") + option);
        const std::string file = folder.read("old.dds");
        EXPECT_EQ(file.substr(84, 4), code);
        EXPECT_EQ(file.substr(128) == blocks, std::string(code) != "BC5S");
        EXPECT_LT(Json::parse(runTool(folder, "map-error old.dds --source n8.png --json").out)["meanErrorDeg"], 0.5);
        ASSERT_EQ(runTool(folder, "convert-map n8.png -q -o c.dds --dds-header legacy").exit_code, 0);
        EXPECT_EQ(folder.read("c.dds").substr(84, 4), "ATI2");
    }
    EXPECT_EQ(runTool(folder, "compress-map n8.png -o a.ktx2 --dds-header legacy").exit_code, 2);
    EXPECT_EQ(runTool(folder, "convert-map n8.png -o a.png --dds-header legacy").exit_code, 2);
}

TEST(CompressMapCommand, SupercompressesLevels) {
    const TempFolder folder;
    writeWaves(folder);
    const Json plain = reportOf(folder, "n8.png -o plain.ktx2"),
               packed = reportOf(folder, "n8.png -o packed.ktx2 --zstd 19");
    EXPECT_LT(packed["outputBytes"], plain["outputBytes"]);
    std::string why;
    const auto from_plain = decodeFloatImage(bytesOf(folder.read("plain.ktx2")), 1 << 20, why);
    const auto from_packed = decodeFloatImage(bytesOf(folder.read("packed.ktx2")), 1 << 20, why);
    ASSERT_TRUE(from_plain && from_packed) << why;
    EXPECT_EQ(from_plain->texels, from_packed->texels);
}

/// Writes a map of rows that are tilted up and down in alternation, and a uniform roughness map.
void writeCorrugated(const TempFolder& folder, std::uint32_t size, std::uint32_t roughness_size) {
    FloatImage map{size, size, 16, {}, {}}, orm{roughness_size, roughness_size, 8, {}, {}};
    for (std::uint32_t i = 0; i < size * size; ++i)
        map.texels.push_back({0.5F, i / size % 2 == 0 ? 0.65F : 0.35F, 0.976970F});
    orm.texels.assign(std::size_t{roughness_size} * roughness_size, Vec3{1, 0.4F, 0});
    folder.write("n.png", std::span<const std::uint8_t>(*encodePng(map, 16)));
    folder.write("orm.png", std::span<const std::uint8_t>(*encodePng(orm, 8)));
}

TEST(CompressMapCommand, AddsTheSpreadOfNormalsToTheRoughnessOfTheSameLevel) {
    const TempFolder folder;
    writeCorrugated(folder, 16, 16);
    const Json report = reportOf(folder, "n.png -o levels/ --roughness orm.png -o2 levels/");
    EXPECT_EQ(report["levels"], 5);
    EXPECT_NEAR(report["meanRoughness"].get<double>(), 0.4, 1e-6);
    std::string why;
    const double wanted = std::pow(std::pow(0.4, 4) + 0.3 * 0.3, 0.25);
    for (int level = 0; level < 5; ++level) {
        const std::string number = std::to_string(level);
        const auto normals = decodeFloatImage(bytesOf(folder.read("levels/n." + number + ".png")), 1 << 20, why);
        const auto orm = decodeFloatImage(bytesOf(folder.read("levels/orm." + number + ".png")), 1 << 20, why);
        ASSERT_TRUE(normals && orm) << why;
        EXPECT_EQ(normals->width, 16u >> level);
        EXPECT_EQ(orm->width, 16u >> level);
        for (const Vec3& texel : orm->texels) EXPECT_NEAR(texel.y, level == 0 ? 0.4 : wanted, 0.003);
        for (const Vec3& texel : normals->texels) EXPECT_NEAR(texel.z, level == 0 ? 0.97697 : 1, 1e-4);
    }
    reportOf(folder, "n.png -o n.ktx2 --roughness orm.png -o2 orm.ktx2");
    const auto orm = decodeFloatImage(bytesOf(folder.read("orm.ktx2")), 1 << 20, why);
    ASSERT_TRUE(orm) << why;
    EXPECT_NEAR(orm->texels[0].y, 0.4, 0.003);
}

TEST(CompressMapCommand, RejectsConflictingOptions) {
    const TempFolder folder;
    writeCorrugated(folder, 16, 12);
    for (const std::string arguments :
         {"-o n.ktx2 --roughness orm.png -o2 o.ktx2", "-o n.ktx2 --roughness n.png", "-o n.dds --format eac-rg11",
          "-o n.dds --zstd 3", "-o n.ktx2 --zstd 23", "-o n.ktx2 --bits 9", "-o n.ktx2 --format bc4"}) {
        const ToolRun run = runTool(folder, "compress-map n.png " + arguments);
        EXPECT_NE(run.exit_code, 0) << arguments;
        EXPECT_EQ(run.errorLines(), 1) << run.err;
    }
    EXPECT_FALSE(folder.has("n.ktx2"));
}

TEST(CompressMapCommand, ReportsTexelsThatTwoChannelsCannotRepresent) {
    const TempFolder folder;
    FloatImage image{8, 8, 8, std::vector<Vec3>(64, Vec3{0.5F, 0.95F, 0.3F}), std::vector<float>(64, 0.5F)};
    const auto file = encodePng(image, 8);
    folder.write("n.png", std::span<const std::uint8_t>(*file));
    const Json report = reportOf(folder, "n.png -o n.dds");
    EXPECT_EQ(report["belowHorizon"], 64);
    EXPECT_EQ(report["warnings"].size(), 2u) << report["warnings"];
    // As in map-error, the error is relative to the original map, not to texels that were clamped to the horizon.
    EXPECT_NEAR(report["meanErrorDeg"].get<double>(), std::atan2(0.4, 0.9) * 57.29577951308232, 0.5);
    const Json beside = Json::parse(runTool(folder, "map-error --json n.dds --source n.png").out);
    EXPECT_NEAR(beside["meanErrorDeg"].get<double>(), report["meanErrorDeg"].get<double>(), 1e-6);
    // PNGs have three channels, which can represent directions below the horizon.
    const Json of_pngs = reportOf(folder, "n.png -o levels/");
    EXPECT_EQ(of_pngs["belowHorizon"], 64);
    EXPECT_EQ(of_pngs["warnings"].size(), 1u) << of_pngs["warnings"];
    EXPECT_LT(of_pngs["meanErrorDeg"], 0.01);
    std::string why;
    const auto level = decodeFloatImage(bytesOf(folder.read("levels/n.2.png")), 1 << 20, why);
    ASSERT_TRUE(level) << why;
    EXPECT_LT(level->texels[0].z, 0.4);
    for (const std::string arguments : {"n.png -o n.png", "none.png -o n.dds", "n.png"}) {
        const ToolRun run = runTool(folder, "compress-map " + arguments);
        EXPECT_NE(run.exit_code, 0);
        EXPECT_EQ(run.errorLines(), 1) << run.err;
    }
}

/// Returns a PNG of vectors tilted in all directions. The vectors' lengths alternate between the two `sizes`.
std::string vectorsOfSizes(std::array<double, 2> sizes) {
    FloatImage image{64, 64, 8, {}, {}};
    for (std::uint32_t i = 0; i < 64 * 64; ++i) {
        const double x = 0.4 * std::sin(0.3 * (i % 64)), y = 0.3 * std::sin(0.2 * (i / 64)), size = sizes[i % 2];
        image.texels.push_back({static_cast<float>(0.5 + 0.5 * size * x), static_cast<float>(0.5 + 0.5 * size * y),
                                static_cast<float>(0.5 + 0.5 * size * std::sqrt(1 - x * x - y * y))});
    }
    const auto file = encodePng(image, 8);
    return {file->begin(), file->end()};
}

TEST(CompressMapCommand, WarnsAboutVectorsThatNoNormalMapHas) {
    const TempFolder folder;
    folder.write("free.png", vectorsOfSizes({0.7, 1.1}));
    folder.write("other.png", vectorsOfSizes({0.5, 1}));
    const Json of_ours = reportOf(folder, "free.png -o n.dds"), of_other = reportOf(folder, "other.png -o n.dds");
    EXPECT_GT(of_ours["notUnit"], 1000);
    EXPECT_TRUE(of_ours["warnings"].empty()) << of_ours["warnings"];
    ASSERT_EQ(of_other["warnings"].size(), 1u);
    EXPECT_NE(of_other["warnings"][0].get<std::string>().find("2048 of 4096 texels are not unit vectors"),
              std::string::npos)
        << of_other["warnings"];
}

}  // namespace
}  // namespace tspace::test
