// SPDX-License-Identifier: MIT
// tspace compress-map.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "images/float_image.h"
#include "images/images.h"
#include "run_tool.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;

/// A map of gentle waves with 8 and with 16 bits.
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

TEST(CompressMapCommand, GainsByTheBitsOfTheInput) {
    const TempFolder folder;
    writeWaves(folder);
    const Json coarse = reportOf(folder, "n8.png -o a.dds"), fine = reportOf(folder, "n16.png -o b.dds");
    // 0.063; rounding to 8 bits alone is off by more than 0.1 degrees in the mean.
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

TEST(CompressMapCommand, SaysWhatTwoChannelsDoNotHold) {
    const TempFolder folder;
    FloatImage image{8, 8, 8, std::vector<Vec3>(64, Vec3{0.5F, 0.95F, 0.3F}), std::vector<float>(64, 0.5F)};
    const auto file = encodePng(image, 8);
    folder.write("n.png", std::span<const std::uint8_t>(*file));
    const Json report = reportOf(folder, "n.png -o n.dds");
    EXPECT_EQ(report["belowHorizon"], 64);
    EXPECT_EQ(report["warnings"].size(), 2u) << report["warnings"];
    for (const std::string arguments : {"n.png -o n.png", "none.png -o n.dds", "n.png"}) {
        const ToolRun run = runTool(folder, "compress-map " + arguments);
        EXPECT_NE(run.exit_code, 0);
        EXPECT_EQ(run.errorLines(), 1) << run.err;
    }
}

}  // namespace
}  // namespace tspace::test
