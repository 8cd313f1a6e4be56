// SPDX-License-Identifier: MIT
// Outputs that would be a surprise, and inputs that cannot be opened.
#include <gtest/gtest.h>

#include "tool/run_tool.h"

namespace tspace::test {
namespace {

/// folded.obj, and plain.glb made of it without tangents.
void writePlain(const TempFolder& folder) {
    writeFoldedObj(folder, "folded.obj");
    writeBumpMap(folder);
    ASSERT_EQ(runTool(folder, "generate folded.obj -q -o made.glb").exit_code, 0);
    ASSERT_EQ(runTool(folder, "generate made.glb -q --overwrite --convention opengl -o plain.glb").exit_code, 0);
}

TEST(OutputThatIsTheInput, NeedsInPlaceUnderWhateverName) {
    const TempFolder folder;
    writePlain(folder);
    std::filesystem::create_symlink("plain.glb", folder.path("symbolic.glb"));
    std::filesystem::create_hard_link(folder.path("plain.glb"), folder.path("hard.glb"));
    std::filesystem::create_directory(folder.path("sub"));
    std::filesystem::create_directory_symlink(".", folder.path("here"));
    const std::string before = folder.read("plain.glb");
    for (const char* output : {"plain.glb", "./plain.glb", "sub/../plain.glb", "symbolic.glb", "hard.glb",
                               "here/plain.glb", ".", "./", "here"}) {
        const ToolRun run = runTool(folder, std::string("generate plain.glb --overwrite -o ") + output);
        EXPECT_EQ(run.exit_code, 2) << output << run.out;
        EXPECT_NE(run.err.find("--in-place"), std::string::npos) << run.err;
        EXPECT_EQ(folder.read("plain.glb"), before) << output;
    }
    EXPECT_EQ(runTool(folder, "generate symbolic.glb --overwrite -o plain.glb").exit_code, 2);
    EXPECT_EQ(runTool(folder, "generate plain.glb --overwrite --in-place").exit_code, 0);
    EXPECT_NE(folder.read("plain.glb"), before);
}

TEST(OutputWithoutAnExtension, IsAFileAndTheToolSaysSo) {
    const TempFolder folder;
    writePlain(folder);
    const ToolRun run = runTool(folder, "generate plain.glb -o foo");
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_EQ(run.errorLines(), 1) << run.err;
    for (const char* said : {"no extension", "foo.glb", "foo/"}) EXPECT_NE(run.err.find(said), std::string::npos);
    EXPECT_TRUE(folder.has("foo.glb"));
    EXPECT_EQ(runTool(folder, "generate plain.glb -o foo -q").err, "");
    EXPECT_EQ(runTool(folder, "generate plain.glb -o foo/").err, "");
    EXPECT_TRUE(folder.has("foo/plain.glb"));
}

TEST(WhatCannotBeOpened, SaysWhy) {
    const TempFolder folder;
    folder.write("file.glb", "x");
    std::filesystem::create_directory(folder.path("folder.glb"));
    std::filesystem::create_symlink("loop.glb", folder.path("loop.glb"));
    struct Case {
        std::string file;
        const char* says;
    };
    for (const Case& bad :
         {Case{"none.glb", "does not exist"}, Case{"file.glb/a.glb", "does not exist"},
          Case{"loop.glb", "Too many levels of symbolic links"}, Case{std::string(300, 'a'), "File name too long"},
          Case{"/dev/null", "not a regular file"}}) {
        const ToolRun run = runTool(folder, "inspect " + bad.file);
        EXPECT_EQ(run.exit_code, 4) << run.err;
        EXPECT_NE(run.err.find(bad.says), std::string::npos) << run.err;
    }
    const ToolRun diff = runTool(folder, "diff folder.glb file.glb");
    EXPECT_NE(diff.err.find("is a folder"), std::string::npos) << diff.err;
    std::filesystem::permissions(folder.path("file.glb"), std::filesystem::perms::none);
    // Root may read everything; another user may not.
    const bool is_root = std::system("test $(id -u) = 0") == 0;
    if (is_root && std::system("command -v setpriv > /dev/null") != 0) GTEST_SKIP() << "setpriv is not there";
    std::filesystem::permissions(folder.path(), std::filesystem::perms::all);
    const ToolRun run = runTool(folder, "inspect file.glb", is_root ? "setpriv --reuid 65534 --clear-groups" : "");
    if (run.exit_code > 125) GTEST_SKIP() << "another user cannot start the tool here: " << run.err;
    EXPECT_NE(run.err.find("cannot open the file"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("Permission denied"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace tspace::test
