// SPDX-License-Identifier: MIT
// Models in pipes, runs that write nothing, and unexpected outputs.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tool/run_tool.h"

namespace tspace::test {
namespace {

/// Writes folded.obj, and plain.glb, which is converted from it and has the tangents of the convention opengl.
void writePlain(const TempFolder& folder) {
    writeFoldedObj(folder, "folded.obj");
    writeBumpMap(folder);
    ASSERT_EQ(runTool(folder, "generate folded.obj -q -o made.glb").exit_code, 0);
    ASSERT_EQ(runTool(folder, "generate made.glb -q --overwrite --convention opengl -o plain.glb").exit_code, 0);
}

TEST(Pipe, GivesTheBytesOfAFile) {
    const TempFolder folder;
    writePlain(folder);
    ASSERT_EQ(runTool(folder, "generate plain.glb -q --overwrite -o file.glb").exit_code, 0);
    const ToolRun run = runTool(folder, "generate - --overwrite -o - < plain.glb");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.out, folder.read("file.glb"));
    EXPECT_NE(run.err.find("- -> -"), std::string::npos) << "the report goes to stderr\n" << run.err;
    EXPECT_EQ(runTool(folder, "generate - --overwrite -q -o - < plain.glb").err, "");
    EXPECT_EQ(runTool(folder, "generate plain.glb --overwrite -q -o -").out, run.out);
    EXPECT_EQ(runTool(folder, "generate folded.obj -q -o -").out, folder.read("made.glb"));
    EXPECT_EQ(runTool(folder, "generate - --overwrite -q -o piped.glb", "cat plain.glb |").exit_code, 0);
    EXPECT_EQ(folder.read("piped.glb"), run.out);
    EXPECT_EQ(runTool(folder, "generate - -o - < made.glb").out, folder.read("made.glb")) << "nothing to change";
    const ToolRun json = runTool(folder, "generate - --overwrite --json -o - < plain.glb");
    EXPECT_EQ(json.out, run.out);
    EXPECT_EQ(nlohmann::json::parse(json.err)["files"][0]["outputFiles"][0], "-");
}

TEST(Pipe, IsReadByTheCommandsThatOnlyRead) {
    const TempFolder folder;
    writePlain(folder);
    std::filesystem::remove(folder.path() / "bump.png");  // because a model in a pipe has no folder with other files
    for (const std::string command : {"inspect", "check", "identify"}) {
        const ToolRun named = runTool(folder, command + " plain.glb");
        const ToolRun piped = runTool(folder, command + " -", "cat plain.glb |");
        EXPECT_EQ(piped.exit_code, named.exit_code) << piped.err;
        if (command == "check") {  // reports whether a map does not exist, or cannot be searched for
            EXPECT_NE(named.out.find("it does not exist"), std::string::npos) << named.out;
            EXPECT_EQ(piped.out.find("it does not exist"), std::string::npos) << piped.out;
            continue;
        }
        EXPECT_EQ(piped.out, "-" + named.out.substr(std::string("plain.glb").size()));
    }
    ASSERT_EQ(runTool(folder, "generate plain.glb -q -o text.gltf").exit_code, 0);
    EXPECT_EQ(runTool(folder, "inspect - < text.gltf").exit_code, 3) << "its buffer is another file";
    EXPECT_NE(runTool(folder, "inspect - < text.gltf").err.find("the model was not read from a file"),
              std::string::npos);
    EXPECT_EQ(runTool(folder, "inspect -", R"(echo ' {"asset":{"version":"2.0"}}' |)").exit_code, 0);
}

TEST(Pipe, WithoutAModelIsBadInputInOneLine) {
    const TempFolder folder;
    writePlain(folder);
    struct Case {
        const char* feed;
        int exit_code;
        const char* says;
    };
    for (const Case& bad : {Case{"cat folded.obj |", 3, "neither a GLB nor a glTF"}, Case{"true |", 3, "is empty"},
                            Case{"yes |", 3, "neither a GLB nor a glTF"}, Case{"head -c 100 plain.glb |", 3, "GLB"}}) {
        const ToolRun run = runTool(folder, "generate - -o -", bad.feed);
        EXPECT_EQ(run.exit_code, bad.exit_code) << run.err;
        EXPECT_EQ(run.out, "") << bad.feed;
        EXPECT_EQ(run.errorLines(), 1) << run.err;
        EXPECT_NE(run.err.find(bad.says), std::string::npos) << run.err;
    }
    EXPECT_EQ(runTool(folder, "check - --memory-limit 64M", "(printf '{\"'; yes) |").exit_code, 3);
    const ToolRun full = runTool(folder, "generate - -o - < plain.glb", kIntoFullDisk);
    EXPECT_EQ(full.exit_code, 4);
    EXPECT_NE(full.err.find("cannot write standard output: No space left on device"), std::string::npos) << full.err;
}

TEST(Pipe, AcceptsNeitherSeveralModelsNorATerminal) {
    const TempFolder folder;
    writePlain(folder);
    for (const char* wrong :
         {"generate plain.glb made.glb -o -", "generate . -o -", "generate - -o out/", "generate - --in-place",
          "generate - -o - --manifest m.jsonl", "generate - -o - --container gltf"}) {
        const ToolRun run = runTool(folder, std::string(wrong) + " < plain.glb");
        EXPECT_EQ(run.exit_code, 2) << wrong;
        EXPECT_EQ(run.out, "");
    }
    if (std::system("command -v script > /dev/null") != 0) GTEST_SKIP() << "script is missing";
    const std::string command = "cd '" + folder.path().string() +
                                "' && script -qec '" TSPACE_TOOL
                                " generate plain.glb -o -; echo code $?' typescript > /dev/null < /dev/null";
    EXPECT_GE(std::system(command.c_str()), 0);
    EXPECT_NE(folder.read("typescript").find("code 2"), std::string::npos) << folder.read("typescript");
    EXPECT_EQ(folder.read("typescript").find("glTF\x02"), std::string::npos);
}

TEST(DryRun, WritesNothingAndReportsWhatItWouldWrite) {
    const TempFolder folder;
    writePlain(folder);
    const std::set<std::string> before = folder.files();
    const std::size_t entries = folder.entryCount();
    const ToolRun wet = runTool(folder, "generate plain.glb --overwrite -o new/out.glb --json");
    std::filesystem::remove_all(folder.path("new"));
    const ToolRun run = runTool(folder, "generate plain.glb --overwrite -o new/out.glb --json --dry-run");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(folder.files(), before);
    EXPECT_EQ(folder.entryCount(), entries) << "no folder either";
    nlohmann::json dry = nlohmann::json::parse(run.out), real = nlohmann::json::parse(wet.out);
    EXPECT_EQ(dry["dryRun"], true);
    EXPECT_EQ(real["dryRun"], false);
    for (const char* field : {"outputFiles", "outputBytes", "primitives", "changed"})
        EXPECT_EQ(dry["files"][0][field], real["files"][0][field]) << field;
    EXPECT_NE(runTool(folder, "generate plain.glb -o x.glb --dry-run").out.find("not written"), std::string::npos);
    EXPECT_NE(runTool(folder, "generate . -o new/ --dry-run").out.find("would be written"), std::string::npos);
    const std::string plain = folder.read("plain.glb");
    EXPECT_EQ(runTool(folder, "generate plain.glb --in-place --overwrite --dry-run").exit_code, 0);
    EXPECT_EQ(folder.read("plain.glb"), plain);
    EXPECT_EQ(runTool(folder, "generate plain.glb --overwrite -o - --dry-run").out, "");
    EXPECT_EQ(folder.files(), before);
}

TEST(OutputThatIsTheInput, NeedsInPlaceUnderAnyName) {
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

TEST(OutputWithoutAnExtension, IsAFileAndIsReported) {
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

TEST(UnreadablePaths, ReportsTheReason) {
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
    // Root may read everything, so the test switches to another user.
    const bool is_root = std::system("test $(id -u) = 0") == 0;
    if (is_root && std::system("command -v setpriv > /dev/null") != 0) GTEST_SKIP() << "setpriv is missing";
    std::filesystem::permissions(folder.path(), std::filesystem::perms::all);
    const ToolRun run = runTool(folder, "inspect file.glb", is_root ? "setpriv --reuid 65534 --clear-groups" : "");
    if (run.exit_code > 125) GTEST_SKIP() << "another user cannot start the tool here: " << run.err;
    EXPECT_NE(run.err.find("cannot open the file"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("Permission denied"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace tspace::test
