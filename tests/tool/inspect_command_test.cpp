// SPDX-License-Identifier: MIT
// tspace inspect from a user's point of view.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tool/run_tool.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;

TEST(Inspect, BeginsWithASummaryLine) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    const ToolRun run = runTool(folder, "inspect a.obj");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.out.rfind("a.obj: 1 primitive, 4 triangles, 6 vertices, ", 0), 0U) << run.out;
    EXPECT_NE(run.out.find("1 primitive needs tangents, 1 without"), std::string::npos) << run.out;
    for (const char* text : {"normalTexture", "\"skin\"", "\"folded\"", "POSITION float3", "1 island, 0 mirrored"}) {
        EXPECT_NE(run.out.find(text), std::string::npos) << text << "\n" << run.out;
    }
}

TEST(Inspect, ReportsTheTangentsThatGenerateWrote) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    writeBumpMap(folder);
    ASSERT_EQ(runTool(folder, "generate a.obj -o a.glb").exit_code, 0);
    const ToolRun run = runTool(folder, "inspect a.glb");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("TANGENT float4"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("needed and present"), std::string::npos) << run.out;
}

TEST(Inspect, NamesPackedFrames) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    writeBumpMap(folder);
    ASSERT_EQ(runTool(folder, "generate a.obj -q -o a.glb --pack frame48 --pack-drop all").exit_code, 0);
    const ToolRun run = runTool(folder, "inspect a.glb");
    for (const char* text : {"_FRAME48 uint16x3", "needed, only packed", "frames as frame48"})
        EXPECT_NE(run.out.find(text), std::string::npos) << text << "\n" << run.out;
    const Json json = Json::parse(runTool(folder, "inspect --json a.glb").out);
    EXPECT_EQ(json["files"][0]["primitives"][0]["packedFrames"], Json::array({"frame48"}));
}

TEST(Inspect, OneBadFileDoesNotStopTheOthers) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    folder.write("b.glb", "glTF");
    const ToolRun run = runTool(folder, "inspect b.glb missing.gltf a.obj");
    EXPECT_EQ(run.exit_code, 4);
    EXPECT_EQ(run.errorLines(), 2) << run.err;
    EXPECT_NE(run.out.find("a.obj: 1 primitive"), std::string::npos);
}

TEST(Inspect, ReportsDataIgnoredWhileReading) {
    const TempFolder folder;
    folder.write("a.obj", "mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_NE(runTool(folder, "inspect a.obj").out.find("  warning   cannot find the material library 'none.mtl'\n"),
              std::string::npos);
    const Json json = Json::parse(runTool(folder, "inspect --json a.obj").out);
    EXPECT_EQ(json["files"][0]["warnings"], Json::array({"cannot find the material library 'none.mtl'"}));
    const std::string checked = runTool(folder, "check a.obj").out;
    EXPECT_NE(checked.find("  note     fileRemark\n        cannot find the material library 'none.mtl'\n      fix: "),
              std::string::npos)
        << checked;
}

TEST(Inspect, NamesFromFilesCannotBreakLinesOrTheTerminal) {
    const TempFolder folder;
    folder.write("a.obj",
                 "o evil\x1b[31m\x07\xc2\x9b"
                 "31m caf\xc3\xa9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const ToolRun run = runTool(folder, "inspect a.obj");
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_EQ(run.out.find('\x1b'), std::string::npos);
    EXPECT_EQ(run.out.find('\x07'), std::string::npos);
    EXPECT_EQ(run.out.find("\xc2\x9b"), std::string::npos) << "the escape sequence in one character, U+009B";
    EXPECT_NE(run.out.find("caf\xc3\xa9"), std::string::npos) << run.out;
}

}  // namespace
}  // namespace tspace::test
