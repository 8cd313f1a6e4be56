// SPDX-License-Identifier: MIT
// EXR files in the commands that read images: floats from -1 to 1 give the same results as a PNG of the same vectors.
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/vec_math.h"
#include "images/float_image.h"
#include "images/image.h"
#include "images/images.h"
#include "maps/texels/shading.h"
#include "tool/folder_files.h"
#include "tool/run_tool.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;

constexpr std::uint32_t kExrSide = 64;

class ExrFiles : public ::testing::Test {
  protected:
    void SetUp() override {
        if (const char* why = whyNotRead(ImageFormat::exr)) GTEST_SKIP() << why;
        const RgbImage map = normalMapOf(kExrSide, bumps);
        std::vector<float> parts[3];
        for (std::size_t i = 0; i < map.rgb.size(); ++i)
            parts[i % 3].push_back(static_cast<float>(map.rgb[i] / 127.5 - 1));
        folder_.write("n.png", pngFile(map));
        folder_.write("rgb.exr", exrFile(kExrSide, kExrSide, {{"R", parts[0]}, {"G", parts[1]}, {"B", parts[2]}}));
        folder_.write("layer.exr", exrFile(kExrSide, kExrSide,
                                           {{"normal.X", parts[0]}, {"normal.Y", parts[1]}, {"normal.Z", parts[2]}}));
        folder_.write("xy.exr", exrFile(kExrSide, kExrSide, {{"X", parts[0]}, {"Y", parts[1]}}));
    }

    TempFolder folder_;
};

TEST_F(ExrFiles, VectorsAreThoseOfThePng) {
    const FloatImage png = imageIn(folder_, "n.png");
    for (const std::string name : {"rgb.exr", "layer.exr", "xy.exr"}) {
        const ToolRun run = runTool(folder_, "convert-map " + name + " -o out.png --json");
        ASSERT_EQ(run.exit_code, 0) << run.err;
        EXPECT_NE(run.out.find("read as vectors from -1 to 1"), std::string::npos) << run.out;
        const FloatImage made = imageIn(folder_, "out.png");
        for (std::size_t i = 0; i < png.texels.size(); ++i)
            ASSERT_LT(degreesBetween(decodeTexel(made.texels[i], {}), decodeTexel(png.texels[i], {})), 1.0) << name;
        const ToolRun compared = runTool(folder_, "map-error " + name + " --source n.png --json");
        ASSERT_EQ(compared.exit_code, 0) << compared.err;
        EXPECT_LT(Json::parse(compared.out)["maxErrorDeg"], 4.5) << name;
        ASSERT_EQ(runTool(folder_, "compress-map " + name + " -q -o out.dds").exit_code, 0);
        EXPECT_LT(Json::parse(runTool(folder_, "map-error out.dds --source n.png --json").out)["meanErrorDeg"], 1.3);
    }
}

TEST_F(ExrFiles, ModelsShowThemAsThePng) {
    const auto drawn = [&](const std::string& map) {
        folder_.write("a.mtl", "newmtl skin\nnorm " + map + "\n");
        folder_.write("a.obj",
                      "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
                      "usemtl skin\nf 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n");
        EXPECT_EQ(runTool(folder_, "render a.obj -o shown.png --size 64 --json").exit_code, 0) << map;
        EXPECT_EQ(runTool(folder_, "check a.obj --json --severity warning").exit_code, 0) << map;
        return imageIn(folder_, "shown.png");
    };
    const FloatImage png = drawn("n.png"), exr = drawn("rgb.exr");
    for (std::size_t i = 0; i < png.texels.size(); ++i) ASSERT_NEAR(exr.texels[i].x, png.texels[i].x, 0.03);
}

TEST_F(ExrFiles, HeightsOfOneChannelAreThoseOfThePng) {
    FloatImage image{kExrSide, kExrSide, 16, {}, {}};
    std::vector<float> heights;
    for (std::uint32_t i = 0; i < kExrSide * kExrSide; ++i) {
        heights.push_back(static_cast<float>(0.5 + 5 * bumps((i % kExrSide) / 64.0, (i / kExrSide) / 64.0)));
        image.texels.push_back({heights.back(), heights.back(), heights.back()});
    }
    const auto png = encodePng(image, 16);
    ASSERT_TRUE(png);
    folder_.write("h.png", std::string(png->begin(), png->end()));
    folder_.write("y.exr", exrFile(kExrSide, kExrSide, {{"Y", heights}}));
    folder_.write("r.exr", exrFile(kExrSide, kExrSide, {{"R", heights}}));
    ASSERT_EQ(runTool(folder_, "height-to-normal h.png -o h.n.png --strength 9").exit_code, 0);
    const FloatImage wanted = imageIn(folder_, "h.n.png");
    for (const std::string name : {"y", "r"}) {
        const ToolRun run = runTool(folder_, "height-to-normal " + name + ".exr -o out.png --strength 9 --json");
        ASSERT_EQ(run.exit_code, 0) << run.err;
        const FloatImage made = imageIn(folder_, "out.png");
        for (std::size_t i = 0; i < wanted.texels.size(); ++i) ASSERT_NEAR(made.texels[i].x, wanted.texels[i].x, 1e-3);
    }
}

TEST_F(ExrFiles, ValuesThatAreNotFiniteAreCounted) {
    const RgbImage map = normalMapOf(kExrSide, bumps);
    std::vector<float> parts[3];
    for (std::size_t i = 0; i < map.rgb.size(); ++i) parts[i % 3].push_back(static_cast<float>(map.rgb[i] / 127.5 - 1));
    parts[0][70] = std::numeric_limits<float>::quiet_NaN();
    parts[2][900] = std::numeric_limits<float>::infinity();
    const std::string count = "2 texels of the image are NaN or infinite; they were filled";
    folder_.write("n.exr", exrFile(kExrSide, kExrSide, {{"R", parts[0]}, {"G", parts[1]}, {"B", parts[2]}}));
    folder_.write("h.exr", exrFile(kExrSide, kExrSide, {{"Y", parts[0]}}));
    for (const std::string command : {"convert-map n.exr -o out.png", "convert-map n.exr -o out.png --channels grb",
                                      "compress-map n.exr -o out.dds", "map-error n.exr --source n.png"}) {
        const ToolRun run = runTool(folder_, command + " --json");
        EXPECT_EQ(run.exit_code, 0) << run.err;
        EXPECT_NE(run.out.find(count), std::string::npos) << command << run.out;
    }
    const ToolRun heights = runTool(folder_, "height-to-normal h.exr -o out.png --json");
    EXPECT_NE(heights.out.find("1 texel of the image is NaN or infinite; it was filled"), std::string::npos)
        << heights.out;
    const Json report = Json::parse(runTool(folder_, "check n.exr --json").out)["files"][0];
    ASSERT_EQ(report["findings"].size(), 1U) << report;
    const Json& finding = report["findings"][0];
    EXPECT_EQ(finding["code"], "fileRemark");
    EXPECT_EQ(finding["severity"], "warning");
    EXPECT_EQ(finding["count"], 2);
    EXPECT_NE(finding["message"].get<std::string>().find(count), std::string::npos) << finding;
    ASSERT_EQ(runTool(folder_, "convert-map n.exr -q -o OUT.png").exit_code, 0);
    EXPECT_EQ(Json::parse(runTool(folder_, "check OUT.png --json").out)["files"][0]["findings"], Json::array());
}

TEST_F(ExrFiles, LayersThatAreNotReadAreNamed) {
    const RgbImage map = normalMapOf(kExrSide, bumps);
    std::vector<float> parts[3];
    for (std::size_t i = 0; i < map.rgb.size(); ++i) parts[i % 3].push_back(static_cast<float>(map.rgb[i] / 127.5 - 1));
    const std::vector<float> gray(parts[0].size(), 0.25F);
    folder_.write("layers.exr", exrFile(kExrSide, kExrSide,
                                        {{"R", gray},
                                         {"G", gray},
                                         {"B", gray},
                                         {"normal.X", parts[0]},
                                         {"normal.Y", parts[1]},
                                         {"normal.Z", parts[2]}}));
    const std::string text = "the channels normal.X, normal.Y and normal.Z were read, and not those of other layers";
    const ToolRun run = runTool(folder_, "convert-map layers.exr -o out.png --json");
    EXPECT_NE(run.out.find(text), std::string::npos) << run.out;
    const Json report = Json::parse(runTool(folder_, "check layers.exr --json").out)["files"][0];
    EXPECT_EQ(report["image"]["content"], "normals");
    ASSERT_EQ(report["findings"].size(), 1U) << report;
    EXPECT_EQ(report["findings"][0]["code"], "fileRemark");
    EXPECT_NE(report["findings"][0]["message"].get<std::string>().find(text), std::string::npos) << report;
}

}  // namespace
}  // namespace tspace::test
