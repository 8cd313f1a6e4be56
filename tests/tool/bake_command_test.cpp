// SPDX-License-Identifier: MIT
// tspace bake.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "maps/float_image.h"
#include "maps/images.h"
#include "run_tool.h"

namespace tspace::test {
namespace {

/// A sheet of cells x cells quads over the unit square, lifted by bumps; with UVs or without.
std::string sheet(int cells, double bump, bool with_uvs, const std::string& name = "sheet", double z = 0) {
    std::string text = "o " + name + "\n";
    const auto at = [&](int i) { return static_cast<double>(i) / cells; };
    for (int y = 0; y <= cells; ++y) {
        for (int x = 0; x <= cells; ++x) {
            const double height = z + bump * std::sin(12 * at(x)) * std::sin(9 * at(y));
            text += "v " + std::to_string(at(x)) + " " + std::to_string(at(y)) + " " + std::to_string(height) + "\n";
            if (with_uvs) text += "vt " + std::to_string(at(x)) + " " + std::to_string(at(y)) + "\n";
        }
    }
    text += "s 1\n";
    for (int y = 0; y < cells; ++y) {
        for (int x = 0; x < cells; ++x) {
            const int a = y * (cells + 1) + x + 1;
            text += "f";
            for (const int vertex : {a, a + 1, a + cells + 2, a + cells + 1}) {
                text += " " + std::to_string(vertex);
                if (with_uvs) text += "/" + std::to_string(vertex);
            }
            text += "\n";
        }
    }
    return text;
}

FloatImage imageOf(const TempFolder& folder, const std::string& name) {
    std::string why;
    const std::optional<FloatImage> image = decodeFloatImage(bytesOf(folder.read(name)), 1 << 22, why);
    EXPECT_TRUE(image) << why;
    return image ? *image : FloatImage{};
}

class BakeCommand : public testing::Test {
  protected:
    void SetUp() override {
        folder.write("low.obj", sheet(4, 0, true));
        folder.write("high.obj", sheet(40, 0.02, false));
        const ToolRun run = runTool(folder, "bake low.obj --high high.obj -o first.png --size 32");
        if (run.exit_code == 3 && run.err.find("Embree") != std::string::npos) GTEST_SKIP() << run.err;
        EXPECT_EQ(run.exit_code, 0) << run.err;
    }
    const TempFolder folder;
};

TEST_F(BakeCommand, WritesAMapThatShowsTheHighPoly) {
    const ToolRun run = runTool(folder,
                                "bake low.obj --high high.obj -o out/normal.png --size 64 --bits 16 --report r.json "
                                "--misses misses.png --heat heat.png");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("error"), std::string::npos) << run.out;
    const FloatImage map = imageOf(folder, "out/normal.png");
    ASSERT_EQ(map.width, 64U);
    EXPECT_EQ(map.bits, 16U);
    // The slope of the bumps at the middle of a texel, v downwards.
    const double x = 20.5 / 64, y = 1 - 40.5 / 64;
    const double slope_x = 0.02 * 12 * std::cos(12 * x) * std::sin(9 * y),
                 slope_y = 0.02 * 9 * std::sin(12 * x) * std::cos(9 * y);
    const Vec3& texel = map.texels[40 * 64 + 20];
    const double z = 2.0 * texel.z - 1;
    EXPECT_NEAR((2.0 * texel.x - 1) / z, -slope_x, 0.02);
    EXPECT_NEAR((2.0 * texel.y - 1) / z, -slope_y, 0.02);
    const auto json = nlohmann::json::parse(folder.read("r.json"));
    EXPECT_EQ(json["schema"], "tspace.bake/1");
    EXPECT_LT(json["files"][0]["error"]["meanDeg"], 0.3);
    EXPECT_EQ(json["files"][0]["texels"]["missed"], 0);
    EXPECT_EQ(json["framesMade"], true);
    EXPECT_EQ(imageOf(folder, "misses.png").width, 64U);
    EXPECT_EQ(imageOf(folder, "heat.png").width, 64U);
}

TEST_F(BakeCommand, GivesTheSameBytesForAnyNumberOfThreads) {
    for (const std::string bits : {"8", "16"}) {
        const std::string common = "bake low.obj --high high.obj -q --size 40 --bits " + bits;
        ASSERT_EQ(runTool(folder, common + " -o 1.png --threads 1").exit_code, 0);
        ASSERT_EQ(runTool(folder, common + " -o 2.png --threads 2").exit_code, 0);
        EXPECT_EQ(folder.read("1.png"), folder.read("2.png"));
    }
}

TEST_F(BakeCommand, DirectxIsGreenTurnedRound) {
    const std::string common = "bake low.obj --high high.obj -q --size 32 --fit texel -o ";
    ASSERT_EQ(runTool(folder, common + "gl.png").exit_code, 0);
    ASSERT_EQ(runTool(folder, common + "dx.png --convention directx").exit_code, 0);
    const FloatImage gl = imageOf(folder, "gl.png"), dx = imageOf(folder, "dx.png");
    for (std::size_t i = 0; i < gl.texels.size(); ++i) EXPECT_NEAR(gl.texels[i].y, 1 - dx.texels[i].y, 2e-5F);
}

TEST_F(BakeCommand, MatchesMeshesByName) {
    // Each sheet lies on the detail of the other.
    folder.write("two_low.obj", sheet(4, 0, true, "a_low"));
    std::string high = sheet(40, 0.02, false, "a_high", 0.04);
    folder.write("one_high.obj", high);
    const auto json =
        nlohmann::json::parse(runTool(folder, "bake two_low.obj --high one_high.obj -o n.png --size 16 --json").out);
    EXPECT_EQ(json["matchedByName"], false) << "one mesh needs no name";
}

TEST_F(BakeCommand, WritesAFilePerTile) {
    std::string low = sheet(2, 0, true);
    // The right half lies in the next tile.
    std::string moved;
    std::istringstream lines(low);
    for (std::string line; std::getline(lines, line);) {
        if (line.rfind("vt ", 0) == 0) {
            std::istringstream numbers(line.substr(3));
            double u = 0, v = 0;
            numbers >> u >> v;
            line = "vt " + std::to_string(2 * u) + " " + std::to_string(v);
        }
        moved += line + "\n";
    }
    folder.write("tiles.obj", moved);
    const auto json =
        nlohmann::json::parse(runTool(folder, "bake tiles.obj --high high.obj -o n.png --size 16 --udim --json").out);
    EXPECT_EQ(json["files"].size(), 2U) << json;
    EXPECT_EQ(imageOf(folder, "n.1001.png").width, 16U);
    EXPECT_EQ(imageOf(folder, "n.1002.png").width, 16U);
}

TEST_F(BakeCommand, WhatIsWrongIsOneLineAndNothingIsWritten) {
    folder.write("bare.obj", sheet(4, 0, false));
    folder.write("far.obj", sheet(4, 0, false, "far", 50));
    folder.write("broken.glb", "glTF and no more");
    for (const auto& [arguments, exit_code, says] :
         {std::tuple("bake low.obj --high high.obj -o n.png --size 0", 2, "1 to 16384"),
          {"bake low.obj --high high.obj -o n.png --size 65536", 2, "1 to 16384"},
          {"bake low.obj --high high.obj -o n.png --bits 12 --size 32", 2, "--bits"},
          {"bake low.obj --high high.obj -o n.png --reach 0 --size 32", 2, "above 0"},
          {"bake low.obj -o n.png", 2, "--high"},
          {"bake low.obj --high high.obj", 2, "--output"},
          {"bake low.obj --high high.obj -o n.jpg", 3, ".png"},
          {"bake low.obj --high high.obj -o low.obj", 2, "is an input"},
          {"bake bare.obj --high high.obj -o n.png --size 32", 3, "no UVs"},
          {"bake low.obj --high far.obj -o n.png --size 32", 3, "nowhere near"},
          {"bake low.obj --high broken.glb -o n.png --size 32", 3, ""},
          {"bake low.obj --high none.obj -o n.png", 4, "none.obj"},
          {"bake low.obj --high high.obj -o n.png --cage high.obj --size 32", 3, "cage"},
          {"bake low.obj --high high.obj -o n.png --size 8192 --memory-limit 200M", 3, "limit"},
          {"bake low.obj --high high.obj -o no/such/../n.png --misses /proc/m.png --size 32", 4, ""}}) {
        const ToolRun run = runTool(folder, arguments);
        EXPECT_EQ(run.exit_code, exit_code) << arguments << '\n' << run.err;
        EXPECT_EQ(run.errorLines(), 1) << run.err;
        EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
        EXPECT_FALSE(std::filesystem::exists(folder.path("n.png"))) << arguments;
    }
}

}  // namespace
}  // namespace tspace::test
