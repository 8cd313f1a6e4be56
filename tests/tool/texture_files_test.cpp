// SPDX-License-Identifier: MIT
// KTX2 and DDS files in the commands that read images: results equal those for a PNG with the same values.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "images/float_image.h"
#include "images/images.h"
#include "images/textures.h"
#include "tool/folder_files.h"
#include "tool/run_tool.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;

/// Writes a flat square whose material uses `map`, and a high poly with bumps behind it.
void writeModels(const TempFolder& folder, const std::string& map) {
    folder.write("low.mtl", "newmtl skin\nnorm " + map + "\n");
    folder.write("low.obj",
                 "mtllib low.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
                 "usemtl skin\nf 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n");
    std::string high = "s 1\n";
    constexpr int kCells = 160;
    for (int y = 0; y <= kCells; ++y) {
        for (int x = 0; x <= kCells; ++x) {
            const double u = static_cast<double>(x) / kCells, v = static_cast<double>(y) / kCells;
            high += "v " + std::to_string(u) + " " + std::to_string(v) + " " + std::to_string(bumps(u, v)) + "\n";
        }
    }
    for (int y = 0; y < kCells; ++y) {
        for (int x = 0; x < kCells; ++x) {
            const int a = y * (kCells + 1) + x + 1;
            for (const int vertex : {a, a + 1, a + kCells + 2, a + kCells + 1})
                high += (vertex == a ? "f " : " ") + std::to_string(vertex);
            high += "\n";
        }
    }
    folder.write("high.obj", high);
}

/// Writes a map as a PNG, and its x and y as textures.
void writeMaps(const TempFolder& folder) {
    const RgbImage map = normalMapOf(64, bumps);
    const std::string data = redAndGreen(map);
    folder.write("n.png", pngFile(map));
    folder.write("n.ktx2", ktx2File({.format = 16, .width = 64, .height = 64, .levels = {data}}));
    folder.write("n.dds", ddsFile(49, 64, 64, data));
    folder.write("bc5.dds", ddsFile(83, 64, 64, bc5Blocks(map)));
}

TEST(TextureFiles, ConvertMapReconstructsZ) {
    const TempFolder folder;
    writeMaps(folder);
    const FloatImage png = imageIn(folder, "n.png");
    for (const std::string name : {"n.ktx2", "n.dds", "bc5.dds"}) {
        const ToolRun run = runTool(folder, "convert-map " + name + " -o out.png --json");
        ASSERT_EQ(run.exit_code, 0) << run.err;
        EXPECT_NE(run.out.find("z is reconstructed from them"), std::string::npos) << run.out;
        const FloatImage made = imageIn(folder, "out.png");
        const double most = name == "bc5.dds" ? 1.0 / 14 : 1e-5;
        for (std::size_t i = 0; i < png.texels.size(); ++i) {
            ASSERT_NEAR(made.texels[i].x, png.texels[i].x, most);
            ASSERT_NEAR(made.texels[i].y, png.texels[i].y, most);
            ASSERT_NEAR(made.texels[i].z, png.texels[i].z, most + 0.02);
        }
    }
}

TEST(TextureFiles, MapErrorMeasuresThemAsThePng) {
    const TempFolder folder;
    writeMaps(folder);
    writeModels(folder, "n.png");
    const auto meanOf = [&](const std::string& name) {
        const ToolRun run = runTool(folder, "map-error " + name + " low.obj --high high.obj --json");
        if (run.exit_code == 3 && run.err.find("Embree") != std::string::npos) return -1.0;
        const Json report = Json::parse(run.out);
        EXPECT_TRUE(report["ok"].get<bool>()) << run.out;
        EXPECT_TRUE(report["fits"].get<bool>()) << run.out;
        return report["angles"]["meanDeg"].get<double>();
    };
    const double png = meanOf("n.png");
    if (png < 0) GTEST_SKIP() << "there is no Embree";
    EXPECT_NEAR(meanOf("n.ktx2"), png, 0.1);
    EXPECT_NEAR(meanOf("n.dds"), png, 0.1);
    EXPECT_NEAR(meanOf("bc5.dds"), png, 1);
}

TEST(TextureFiles, RenderShowsThem) {
    const TempFolder folder;
    writeMaps(folder);
    for (const std::string name : {"n.png", "n.ktx2", "n.dds", "bc5.dds"}) {
        writeModels(folder, name);
        const ToolRun run = runTool(folder, "render low.obj -o " + name + ".shown.png --size 64 --json");
        ASSERT_EQ(run.exit_code, 0) << run.err;
        EXPECT_EQ(run.out.find("is not shown"), std::string::npos) << run.out;
    }
    const FloatImage png = imageIn(folder, "n.png.shown.png");
    for (const std::string name : {"n.ktx2", "n.dds", "bc5.dds"}) {
        const FloatImage shown = imageIn(folder, name + ".shown.png");
        double off = 0;
        for (std::size_t i = 0; i < png.texels.size(); ++i) off += std::fabs(shown.texels[i].x - png.texels[i].x);
        EXPECT_LT(off / static_cast<double>(png.texels.size()), 0.01) << name;
    }
}

TEST(TextureFiles, FlipGreenKeepsTheirFormatOrMakesAPng) {
    const TempFolder folder;
    writeMaps(folder);
    for (const std::string name : {"n.ktx2", "n.dds", "bc5.dds"}) {
        const std::string ending = name.substr(name.find('.'));
        ASSERT_EQ(runTool(folder, "flip-green " + name + " -q -o once" + ending).exit_code, 0);
        ASSERT_EQ(runTool(folder, "flip-green once" + ending + " -q -o twice" + ending).exit_code, 0);
        EXPECT_NE(folder.read("once" + ending), folder.read(name));
        EXPECT_EQ(folder.read("twice" + ending), folder.read(name));
        EXPECT_EQ(runTool(folder, "flip-green " + name + " -q -o once.png").exit_code, 0);
        EXPECT_EQ(runTool(folder, "flip-green " + name + " -q -o once.jpg").exit_code, 2);
    }
    folder.write("bc7.dds", ddsFile(98, 4, 4, std::string(16, '\x40')));
    const ToolRun run = runTool(folder, "flip-green bc7.dds -o once.dds");
    EXPECT_EQ(run.exit_code, 3);
    EXPECT_EQ(run.errorLines(), 1);
}

TEST(TextureFiles, AnErrorIsOneLine) {
    const TempFolder folder;
    writeMaps(folder);
    folder.write("cut.dds", folder.read("bc5.dds").substr(0, 1000));
    folder.write("cube.dds", folder.read("n.dds").replace(112, 4, std::string("\0\xfe\0\0", 4)));
    for (const std::string name : {"cut.dds", "cube.dds"}) {
        const ToolRun run = runTool(folder, "convert-map " + name + " -o out.png");
        EXPECT_EQ(run.exit_code, 3);
        EXPECT_EQ(run.errorLines(), 1) << run.err;
    }
}

}  // namespace
}  // namespace tspace::test
