// SPDX-License-Identifier: MIT
// What the tool says about itself, and what it says to a wrong command line.
#include <gtest/gtest.h>

#include <vector>

#include "tool/run_tool.h"

namespace tspace::test {
namespace {

TEST(Usage, WrongCommandLinesExitWithTwoAndOneLine) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    writeFoldedObj(folder, "b.obj");
    const std::vector<std::string> wrong = {
        "",
        "nonsense",
        "generate",
        "generate a.obj",
        "generate a.obj -o out.glb --no-such-option",
        "generate a.obj -o out.glb --method nearest",
        "generate a.obj -o out.glb --pairing wrong",
        "generate a.obj -o out.glb --normals smooth",
        "generate a.obj -o out.glb --convention maya",
        "generate a.obj -o out.glb --crease 181",
        "generate a.obj -o out.glb --crease nan",
        "generate a.obj -o out.glb --threshold -1",
        "generate a.obj -o out.glb --threshold 10x",
        "generate a.obj -o out.glb --threads -1",
        "generate a.obj -o out.glb --container fbx",
        "generate a.obj -o out.glb --container gltf",
        "generate a.obj -o out.glb --only-missing --overwrite",
        "generate a.obj -o out.glb --only-missing --repair",
        "generate a.obj -o out.glb --overwrite --repair",
        "generate a.obj -o out.glb --all --strip",
        "generate a.obj -o out.glb --texture-transform rotate",
        "generate a.obj -o out.glb --in-place",
        "generate a.obj -o out.fbx",
        "generate a.obj -o -",
        "generate a.obj b.obj -o out.glb",
        "generate a.obj b.obj -o a.obj",
        "generate . -o out.glb",
        "generate a.obj --in-place",
        "inspect",
        "inspect a.obj -o x",
        "inspect a.obj --memory-limit 1000",
        "inspect a.obj --memory-limit 63M",
        "inspect a.obj --memory-limit -1G",
        "inspect a.obj --memory-limit 1.5G",
        "inspect a.obj --memory-limit 8X",
        "inspect a.obj --memory-limit 8GB",
        "inspect a.obj --memory-limit 99999999999999999999G",
        "inspect a.obj --memory-limit G",
        "inspect a.obj --memory-limit ''",
    };
    for (const std::string& arguments : wrong) {
        const ToolRun run = runTool(folder, arguments);
        EXPECT_EQ(run.exit_code, 2) << arguments << "\n" << run.err;
        EXPECT_EQ(run.errorLines(), 1) << arguments << "\n" << run.err;
        EXPECT_EQ(run.err.rfind("tspace: ", 0), 0U) << run.err;
        EXPECT_EQ(run.out, "") << arguments;
    }
    EXPECT_EQ(folder.files(), (std::set<std::string>{"a.obj", "b.obj", "folded.mtl"}));
}

TEST(Usage, AnOutputIsAskedForInWords) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    const ToolRun run = runTool(folder, "generate a.obj");
    EXPECT_NE(run.err.find("-o OUT"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("--in-place"), std::string::npos) << run.err;
}

TEST(Usage, ACommandThatDoesNotExistIsNamed) {
    for (const std::string name : {"help", "chek", "a.glb"}) {
        EXPECT_EQ(runTool(TempFolder(), name).err, "tspace: there is no command '" + name + "' (see tspace --help)\n");
    }
}

TEST(Usage, VersionIsPrinted) {
    const ToolRun run = runTool(TempFolder(), "--version");
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_EQ(run.out.rfind("tspace ", 0), 0U);
    EXPECT_EQ(run.err, "");
}

TEST(Usage, HelpNamesCommandsAndExitCodes) {
    for (const std::string arguments : {"--help", "generate --help", "inspect --help", "generate -h"}) {
        const ToolRun run = runTool(TempFolder(), arguments);
        EXPECT_EQ(run.exit_code, 0);
        EXPECT_EQ(run.err, "");
        for (const char* text :
             {"Exit codes:", "0  done", "2  wrong usage", "3  bad input", "4  cannot", "5  out of memory"}) {
            EXPECT_NE(run.out.find(text), std::string::npos) << arguments << " lacks " << text;
        }
    }
    const ToolRun run = runTool(TempFolder(), "--help");
    EXPECT_NE(run.out.find("  generate\n"), std::string::npos);
    EXPECT_NE(run.out.find("  inspect\n"), std::string::npos);
}

TEST(Usage, HelpOfGenerateNamesEveryOptionUnitAndDefault) {
    const ToolRun run = runTool(TempFolder(), "generate --help");
    for (const char* text : {"-o, --output OUT",
                             "--in-place",
                             "--container FORMAT",
                             "--allow-external",
                             "--all",
                             "--only-missing",
                             "--overwrite",
                             "--repair",
                             "--strip",
                             "--texture-transform READING",
                             "Default: apply.",
                             "--method NAME",
                             "--pairing NAME",
                             "--frame NAME",
                             "--threshold DEG",
                             "--convention NAME",
                             "--normals NAME",
                             "--crease DEG",
                             "--no-sanitize",
                             "--orthogonalize",
                             "--threads N",
                             "--memory-limit SIZE",
                             "--json",
                             "-q, --quiet",
                             "Default: mikktspace.",
                             "Default: reference.",
                             "Default: 180.",
                             "Default: gltf.",
                             "Default: 0.",
                             "Default: flat",
                             "degrees",
                             "Examples:"}) {
        EXPECT_NE(run.out.find(text), std::string::npos) << "no " << text;
    }
    for (const char* name : {"mikktspace", "lengyel", "uniform", "angle", "area", "flat", "basis", "corrected",
                             "angle-area", "max", "opengl", "directx", "unreal", "unity", "blender", "godot"}) {
        EXPECT_NE(run.out.find(name), std::string::npos) << "no " << name;
    }
}

TEST(Usage, HelpFitsEightyColumns) {
    for (const std::string arguments : {"--help", "generate --help", "inspect --help"}) {
        std::istringstream lines(runTool(TempFolder(), arguments).out);
        for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
    }
}

}  // namespace
}  // namespace tspace::test
