// SPDX-License-Identifier: MIT
// tspace check from a user's point of view.
#include <gtest/gtest.h>

#include "tool/folder_files.h"
#include "tool/run_tool.h"

namespace tspace::test {
namespace {

void writeGood(const TempFolder& folder, const std::string& name) {
    writeFoldedObj(folder, "folded.obj");
    writeBumpMap(folder);
    ASSERT_EQ(runTool(folder, "generate folded.obj -q -o " + name).exit_code, 0);
}

TEST(CheckCommand, PrintsOneLineForAFileWithoutFindings) {
    const TempFolder folder;
    writeGood(folder, "good.glb");
    const ToolRun run = runTool(folder, "check good.glb");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.out,
              "good.glb: nothing found in 1 primitive, 1 of them with tangents; examined 1 normal map: channel "
              "contents; the direction of green cannot be determined\n");
}

TEST(CheckCommand, BeginsWithASummaryAndEndsEachFindingWithItsRemedy) {
    const TempFolder folder;
    writeInverted(folder, "bad.glb");
    const ToolRun run = runTool(folder, "check bad.glb");
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_EQ(run.err, "");
    EXPECT_EQ(run.out.rfind(
                  "bad.glb: 1 error, 0 warnings, 0 notes in 1 primitive, 1 of them with tangents; examined 1 normal "
                  "map: channel contents; the direction of green cannot be determined\n",
                  0),
              0U)
        << run.out;
    for (const char* text : {"  error    signsInverted\n", "mesh 0 \"folded\", primitive 0, material \"skin\"",
                             "(at /meshes/0/primitives/0)", "every sign is inverted", "first at vertices 0, 1",
                             "fix: Negate the sign (w) of every tangent"}) {
        EXPECT_NE(run.out.find(text), std::string::npos) << text << "\n" << run.out;
    }
    EXPECT_EQ(run.out.find('\x1b'), std::string::npos) << "colors are for terminals";
}

TEST(CheckCommand, ReportsTheErrorOfPackedFramesAndTheRemedyForOutdatedOnes) {
    const TempFolder folder;
    writeGood(folder, "good.glb");
    ASSERT_EQ(runTool(folder, "generate good.glb -q --in-place --pack frame32").exit_code, 0);
    const ToolRun first = runTool(folder, "check good.glb --fail-on note");
    EXPECT_EQ(first.exit_code, 0) << first.out;
    EXPECT_NE(first.out.find("packed frames of 1 primitive in _FRAME32: N within "), std::string::npos) << first.out;
    EXPECT_NE(first.out.find("(0.135 and 0.135 guaranteed), all signs match\n"), std::string::npos) << first.out;

    // The tangents change, but the packed frames do not.
    ASSERT_EQ(runTool(folder, "generate good.glb -q -o other.glb --overwrite --convention opengl").exit_code, 0);
    const ToolRun second = runTool(folder, "check other.glb --convention opengl --fail-on warning");
    EXPECT_EQ(second.exit_code, 1);
    EXPECT_NE(second.out.find("  warning  packedFramesDiffer\n"), std::string::npos) << second.out;
    EXPECT_NE(second.out.find("fix: Pack them again: tspace generate --pack frame32.\n"), std::string::npos)
        << second.out;
    ASSERT_EQ(runTool(folder, "generate other.glb -q --in-place --pack frame32").exit_code, 0);
    EXPECT_EQ(runTool(folder, "check other.glb --convention opengl --fail-on note").exit_code, 0);
}

TEST(CheckCommand, FailsFromTheRequestedSeverityOn) {
    const TempFolder folder;
    writeInverted(folder, "error.glb");
    writeFoldedObj(folder, "note.obj");
    writeGood(folder, "good.glb");
    const auto code = [&](const std::string& arguments) { return runTool(folder, "check " + arguments).exit_code; };
    EXPECT_EQ(code("note.obj"), 0);
    EXPECT_EQ(code("note.obj --fail-on warning"), 0);
    EXPECT_EQ(code("note.obj --fail-on note"), 1);
    for (const char* level : {"note", "warning", "error"}) {
        EXPECT_EQ(code(std::string("error.glb --fail-on ") + level), 1) << level;
        EXPECT_EQ(code(std::string("good.glb --fail-on ") + level), 0) << level;
    }
    EXPECT_EQ(code("error.glb --convention opengl"), 0);
    EXPECT_EQ(code("error.glb --fail-on never"), 2);
}

TEST(CheckCommand, GroupsEqualFindingsOfManyPrimitives) {
    const TempFolder folder;
    folder.write("folded.mtl", "newmtl skin\nmap_Bump bump.png\n");
    std::string obj = "mtllib folded.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl skin\n";
    for (int i = 0; i < 8; ++i) obj += "o part" + std::to_string(i) + "\nf 1/1 2/2 3/3\n";
    folder.write("parts.obj", obj);
    writeBumpMap(folder);
    ASSERT_EQ(runTool(folder, "generate parts.obj -q --convention opengl -o parts.glb").exit_code, 0);
    const ToolRun run = runTool(folder, "check parts.glb");
    EXPECT_NE(run.out.find("signsInverted, 8 places"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("and 3 more"), std::string::npos) << run.out;
    EXPECT_EQ(run.out.find("mend:"), run.out.rfind("mend:")) << "the remedy once\n" << run.out;
}

TEST(CheckCommand, WorksThroughFoldersAndGivesTheWorstCode) {
    const TempFolder folder;
    writeInverted(folder, "in/a.glb");
    writeGood(folder, "in/b.glb");
    folder.write("in/c.glb", "glTF");
    const ToolRun run = runTool(folder, "check in --jobs 2");
    EXPECT_EQ(run.exit_code, 3);
    EXPECT_EQ(run.errorLines(), 1) << run.err;
    EXPECT_NE(run.out.find("\n3 files: 1 error, 0 warnings, 0 notes; 1 without errors, 1 could not be read\n"),
              std::string::npos)
        << run.out;
    EXPECT_EQ(runTool(folder, "check in --jobs 2").out, runTool(folder, "check in").out);
    EXPECT_EQ(runTool(folder, "check in/a.glb in/b.glb -q").out, "");
    EXPECT_EQ(runTool(folder, "check none.glb").exit_code, 4);
}

TEST(CheckCommand, NamesFromFilesCannotBreakLinesOrTheTerminal) {
    const TempFolder folder;
    folder.write("a.mtl", "newmtl evil\x1b[31m\nmap_Bump x\x07.png\n");
    folder.write("a.obj",
                 "mtllib a.mtl\no evil\x1b[31m\x07\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl evil\x1b[31m\nf 1 2 3\n");
    const ToolRun run = runTool(folder, "check a.obj");
    EXPECT_EQ(run.exit_code, 1) << "it has no UVs";
    EXPECT_EQ(run.out.find('\x1b'), std::string::npos);
    EXPECT_EQ(run.out.find('\x07'), std::string::npos);
}

}  // namespace
}  // namespace tspace::test
