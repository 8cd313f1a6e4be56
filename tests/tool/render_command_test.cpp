// SPDX-License-Identifier: MIT
// tspace render.
#include <nlohmann/json.hpp>

#include "images/image.h"
#include "support/scene_file.h"
#include "support/shared_data.h"
#include "tool/run_tool.h"

namespace tspace::test {
namespace {

std::string writeBentSheet(const TempFolder& folder) {
    return writeModel(folder, "sheet.glb", {withTangents(bentSheet(4), Method::mikktspace)});
}

ImageSize sizeOf(const std::string& png) {
    return claimedSize({reinterpret_cast<const std::uint8_t*>(png.data()), png.size()});
}

TEST(RenderCommand, DrawsAPicture) {
    const TempFolder folder;
    writeBentSheet(folder);
    for (const char* show : {"lit", "normals", "tangents", "sign", "error", "uv", "mapped"}) {
        const ToolRun run =
            runTool(folder, std::string("render sheet.glb -o out/") + show + ".png --size 80x40 --show " + show);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        EXPECT_NE(run.out.find(std::string(show) + ", 80 x 40, 32 triangles"), std::string::npos) << run.out;
        const ImageSize size = sizeOf(folder.read(std::string("out/") + show + ".png"));
        EXPECT_EQ(size.width, 80U);
        EXPECT_EQ(size.height, 40U);
    }
    EXPECT_NE(
        runTool(folder, "render sheet.glb -o e.png --size 64 --show error --method flat").out.find("degrees from flat"),
        std::string::npos);
}

TEST(RenderCommand, ReportsAsJson) {
    const TempFolder folder;
    writeBentSheet(folder);
    const auto json =
        nlohmann::json::parse(runTool(folder, "render --json sheet.glb -o a.png --size 64 --show error").out);
    EXPECT_EQ(json["schema"], "tspace.render/1");
    EXPECT_EQ(json["show"], "error");
    EXPECT_EQ(json["triangles"], 32);
    EXPECT_GT(json["tangentError"]["samples"], 0);
    EXPECT_LT(json["tangentError"]["maxDeg"], 0.01);
    const auto failed = nlohmann::json::parse(runTool(folder, "render --json none.glb -o b.png").out);
    EXPECT_EQ(failed["ok"], false);
    EXPECT_EQ(failed["exitCode"], 4);
}

TEST(RenderCommand, DrawsAllInstancesOfANode) {
    TSPACE_NEEDS_SHARED("reports/second/negscale_instance.glb");
    const TempFolder folder;
    const ToolRun run = runTool(
        folder, "render --json '" + shared("reports/second/negscale_instance.glb").string() + "' -o a.png --size 64");
    // Two models of 768 triangles each.
    EXPECT_EQ(nlohmann::json::parse(run.out)["triangles"], 1536) << run.err;
}

TEST(RenderCommand, ReadsAndWritesPipes) {
    const TempFolder folder;
    writeBentSheet(folder);
    ASSERT_EQ(runTool(folder, "render -q sheet.glb -o a.png --size 64").exit_code, 0);
    EXPECT_EQ(runTool(folder, "render -q - -o - --size 64 < sheet.glb").out, folder.read("a.png"));
}

TEST(RenderCommand, NamedViewsAreAngles) {
    const TempFolder folder;
    writeBentSheet(folder);
    runTool(folder, "render -q sheet.glb -o a.png --size 64 --view left --light 0,0");
    runTool(folder, "render -q sheet.glb -o b.png --size 64 --view=-90,0 --light 0,0,2");
    EXPECT_EQ(folder.read("a.png"), folder.read("b.png"));
}

TEST(RenderCommand, ALegendIsDrawnUnlessDisabled) {
    const TempFolder folder;
    writeBentSheet(folder);
    ASSERT_EQ(runTool(folder, "render -q sheet.glb -o with.png --size 400").exit_code, 0);
    ASSERT_EQ(runTool(folder, "render -q sheet.glb -o without.png --size 400 --no-legend").exit_code, 0);
    EXPECT_NE(folder.read("with.png"), folder.read("without.png"));
    EXPECT_EQ(sizeOf(folder.read("with.png")).height, 400U);
}

TEST(RenderCommand, WrongUseIsOneLineAndNoFile) {
    const TempFolder folder;
    writeBentSheet(folder);
    for (const char* arguments :
         {"render sheet.glb", "render sheet.glb -o a.jpg", "render sheet.glb -o a.png --size 8",
          "render sheet.glb -o a.png --view up", "render sheet.glb -o a.png --view 10,91",
          "render sheet.glb -o a.png --light 0,0,0", "render sheet.glb -o a.png --light 1,2,3,4",
          "render sheet.glb -o a.png --samples 0", "render sheet.glb -o a.png --show tangent",
          "render sheet.glb -o a.png --size 8192 --samples 4"}) {
        const ToolRun run = runTool(folder, arguments);
        EXPECT_EQ(run.exit_code, 2) << arguments;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
    EXPECT_EQ(folder.files(), (std::set<std::string>{"sheet.glb"}));
}

}  // namespace
}  // namespace tspace::test
