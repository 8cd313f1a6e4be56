// SPDX-License-Identifier: MIT
// tspace diff and tspace identify from a user's point of view.
#include <gtest/gtest.h>

#include "tool/run_tool.h"

namespace tspace::test {
namespace {

void writePair(const TempFolder& folder) {
    writeFoldedObj(folder, "a.obj");
    ASSERT_EQ(runTool(folder, "generate a.obj -o a.glb").exit_code, 0);
    ASSERT_EQ(runTool(folder, "generate a.obj -o b.glb --convention opengl").exit_code, 0);
}

TEST(DiffCommand, ExitsWithZeroForEqualFramesAndOneForOthers) {
    const TempFolder folder;
    writePair(folder);
    const ToolRun same = runTool(folder, "diff a.glb a.glb");
    EXPECT_EQ(same.exit_code, 0);
    EXPECT_EQ(same.out.rfind("a.glb against a.glb: equal frames at all 12 corners\n", 0), 0U) << same.out;
    const ToolRun other = runTool(folder, "diff a.glb b.glb");
    EXPECT_EQ(other.exit_code, 1);
    EXPECT_NE(other.out.find("12 of 12 signs differ"), std::string::npos) << other.out;
    EXPECT_EQ(runTool(folder, "diff a.glb b.glb --quiet").out, "");
}

TEST(DiffCommand, NamesTheFileThatCannotBeRead) {
    const TempFolder folder;
    writePair(folder);
    const ToolRun run = runTool(folder, "diff a.glb none.glb");
    EXPECT_EQ(run.exit_code, 4);
    EXPECT_EQ(run.err.rfind("tspace: none.glb: ", 0), 0U) << run.err;
    EXPECT_EQ(run.errorLines(), 1);
    EXPECT_EQ(run.out, "");
}

TEST(DiffCommand, NeedsTwoFiles) {
    const TempFolder folder;
    writePair(folder);
    EXPECT_EQ(runTool(folder, "diff a.glb").exit_code, 2);
    EXPECT_EQ(runTool(folder, "diff a.glb a.glb a.glb").exit_code, 2);
}

TEST(IdentifyCommand, BeginsWithTheVerdict) {
    const TempFolder folder;
    writePair(folder);
    const ToolRun run = runTool(folder, "identify a.glb b.glb --jobs 2");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.out.rfind("a.glb: Made by mikktspace", 0), 0U) << run.out;
    EXPECT_NE(run.out.find("The signs follow glTF."), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("\nb.glb: Made by mikktspace"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("Every sign is inverted"), std::string::npos) << run.out;
}

TEST(IdentifyCommand, OneBadFileDoesNotStopTheOthers) {
    const TempFolder folder;
    writePair(folder);
    folder.write("bad.glb", "no glTF");
    const ToolRun run = runTool(folder, "identify bad.glb a.glb");
    EXPECT_EQ(run.exit_code, 3);
    EXPECT_EQ(run.errorLines(), 1);
    EXPECT_NE(run.out.find("a.glb: Made by"), std::string::npos);
}

}  // namespace
}  // namespace tspace::test
