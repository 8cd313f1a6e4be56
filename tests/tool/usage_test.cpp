// SPDX-License-Identifier: MIT
// Help of the tool, and messages for invalid command lines.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <utility>
#include <vector>

#include "tool/run_tool.h"

namespace tspace::test {
namespace {

TEST(Usage, WrongCommandLinesExitWithTwoAndOneLine) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    writeFoldedObj(folder, "b.obj");
    const std::vector<std::string> wrong = {
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
        "generate a.obj -o out.glb --refine 3",
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
        "generate a.obj -o - --container gltf",
        "generate a.obj b.obj -o -",
        "generate - --in-place",
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

TEST(Usage, RequestsAMissingOutputInASentence) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    const ToolRun run = runTool(folder, "generate a.obj");
    EXPECT_NE(run.err.find("-o OUT"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("--in-place"), std::string::npos) << run.err;
}

TEST(Usage, ACommandThatDoesNotExistIsNamed) {
    for (const std::string name : {"a.txt", "polish", "x"}) {
        EXPECT_EQ(runTool(TempFolder(), name).err, "tspace: unknown command '" + name + "' (see tspace --help)\n");
    }
}

TEST(Usage, WithoutACommandTheToolListsAllCommands) {
    const ToolRun run = runTool(TempFolder(), "");
    EXPECT_EQ(run.exit_code, 2);
    for (const char* name : {"generate", "check", "identify", "bake"})
        EXPECT_NE(run.out.find(name), std::string::npos) << run.out;
}

TEST(Usage, SuggestsTheCommandLineForWordsOfOtherTools) {
    for (const auto& [word, says] : {std::pair("fix", "generate --repair IN"),
                                     {"repair", "generate --repair IN"},
                                     {"version", "tspace --version"},
                                     {"validate", "check IN"}}) {
        const ToolRun run = runTool(TempFolder(), word);
        EXPECT_EQ(run.exit_code, 2) << word;
        EXPECT_EQ(run.errorLines(), 1) << run.err;
        EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
    }
}

TEST(Usage, SuggestsTheOtherCommandForAnImageInsteadOfAModelAndViceVersa) {
    for (const char* command : {"identify a.png", "inspect a.KTX2", "render a.png -o b.png", "generate a.jpg -o b.glb",
                                "finish a.dds -o b.glb", "diff a.png b.png", "bake a.png --high b.glb -o c.png"}) {
        const ToolRun run = runTool(TempFolder(), command);
        EXPECT_EQ(run.exit_code, 2) << command;
        EXPECT_EQ(run.errorLines(), 1) << run.err;
        EXPECT_NE(run.err.find("tspace check"), std::string::npos) << run.err;
    }
    for (const char* command : {"flip-green a.glb -o b.png", "convert-map a.gltf --mesh a.glb --to-mesh b.glb -o b.png",
                                "compress-map a.obj -o b.ktx2", "height-to-normal a.glb -o b.png"}) {
        const ToolRun run = runTool(TempFolder(), command);
        EXPECT_EQ(run.exit_code, 2) << command;
        EXPECT_NE(run.err.find("tspace generate --flip-green"), std::string::npos) << run.err;
    }
}

TEST(Usage, AWrongExtensionOfAnOutputIsAWrongCommandLineInEveryCommand) {
    const TempFolder folder;
    for (const char* command :
         {"generate a.glb -o b.foo", "finish a.glb -o b.foo", "bake a.glb --high a.glb -o b.foo",
          "bake a.glb --high a.glb -o b.png --out-mesh c.foo", "flip-green a.png -o b.foo",
          "height-to-normal a.png -o b.foo", "convert-map a.png --mesh a.glb --to-mesh b.glb -o b.foo",
          "compress-map a.png -o b.foo", "render a.glb -o b.foo", "check a.glb --html b.pdf",
          "diff a.glb b.glb --html b.pdf", "finish a.glb -o b.glb --html b.pdf", "view a.glb -o b.pdf"}) {
        const ToolRun run = runTool(folder, command);
        EXPECT_EQ(run.exit_code, 2) << command << "\n" << run.err;
        EXPECT_EQ(run.errorLines(), 1) << run.err;
        EXPECT_NE(run.err.find("must end in ."), std::string::npos) << run.err;
    }
}

TEST(Usage, SuggestsTheNearestWordForATypo) {
    struct Case {
        const char* arguments;
        const char* meant;
    };
    const std::vector<Case> cases = {
        {"chek", "'check'"},
        {"ispect a.glb", "'inspect'"},
        {"identfy", "'identify'"},
        {"generaet", "'generate'"},
        {"help gnerate", "'generate'"},
        {"--verison", "'--version'"},
        {"generate a.obj -o out.glb --overwrit", "'--overwrite'"},
        {"generate a.obj -o out.glb --al", "'--all'"},
        {"generate a.obj -o out.glb --texture", "'--texture-transform'"},
        {"generate a.obj -o out.glb --methd lengyel", "'--method'"},
        {"generate a.obj -o out.glb --method mikktspce", "'mikktspace'"},
        {"generate a.obj --outptu=out.glb", "'--output'"},
        {"inspect a.obj -json", "'--json'"},
        {"check a.obj --fail-on warn", "'warning'"},
    };
    for (const Case& wrong : cases) {
        const ToolRun run = runTool(TempFolder(), wrong.arguments);
        EXPECT_EQ(run.exit_code, 2) << wrong.arguments;
        EXPECT_EQ(run.errorLines(), 1) << run.err;
        EXPECT_NE(run.err.find(std::string("did you mean ") + wrong.meant), std::string::npos) << run.err;
    }
    for (const char* far : {"a.glb", "check a.obj -z", "check a.obj --no-such-option", "help x"}) {
        EXPECT_EQ(runTool(TempFolder(), far).err.find("did you mean"), std::string::npos) << far;
    }
}

TEST(Usage, ValuesMayHaveEveryUsualPosition) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    for (const char* spelling : {"-o out.glb", "-oout.glb", "--output out.glb", "--output=out.glb", "-qo out.glb",
                                 "-q -q -o out.glb", "--threads=1 -o out.glb"}) {
        std::filesystem::remove(folder.path() / "out.glb");
        const ToolRun run = runTool(folder, std::string("generate a.obj ") + spelling);
        EXPECT_EQ(run.exit_code, 0) << spelling << "\n" << run.err;
        EXPECT_TRUE(std::filesystem::exists(folder.path() / "out.glb")) << spelling;
    }
    writeFoldedObj(folder, "-a.obj");
    EXPECT_EQ(runTool(folder, "inspect -- -a.obj").exit_code, 0);
    EXPECT_EQ(runTool(folder, "inspect ./-a.obj").exit_code, 0);
}

TEST(Usage, AWrongLineIsExplained) {
    struct Case {
        const char* arguments;
        const char* says;
    };
    const std::vector<Case> cases = {
        {"--json check a.obj", "expected a command"},
        {"inspect", "IN... is missing"},
        {"diff a.obj", "B is missing"},
        {"diff a.obj b.obj c.obj", "'c.obj' is unexpected"},
        {"inspect a.obj --jobs", "--jobs needs a value: N"},
        {"generate a.obj -o --all", "--output needs a value: OUT"},
        {"inspect a.obj --json=yes", "--json takes no value"},
        {"inspect a.obj --jobs 1 --jobs 2", "--jobs is given twice"},
        {"inspect a.obj --jobs 1025", "--jobs 1025: must be an integer from 0 to 1024"},
        {"generate a.obj -o b.glb --resume", "--resume needs --manifest"},
        {"generate a.obj -o b.glb --all --strip", "--strip and --all cannot be used together"},
        {"generate a.obj -o b.glb --crease 1e3", "--crease 1e3: must be a number of degrees from 0 to 180"},
    };
    for (const Case& wrong : cases) {
        const ToolRun run = runTool(TempFolder(), wrong.arguments);
        EXPECT_EQ(run.exit_code, 2) << wrong.arguments;
        EXPECT_NE(run.err.find(wrong.says), std::string::npos) << wrong.arguments << "\n" << run.err;
    }
}

TEST(Usage, NumbersHaveUsualSpellings) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    for (const std::string number : {"60", "+60", "060", "60.", ".5", "0.5e2", "5E+1", "1e-300", "0"}) {
        const ToolRun run = runTool(folder, "generate a.obj -o b.glb --crease " + number);
        EXPECT_EQ(run.exit_code, 0) << number << "\n" << run.err;
    }
    for (const std::string number :
         {"1e400", "60.5.1", ".", "+", "e5", "5e", "+-5", "0x10", "inf", "-1", "1-2", "5,5"}) {
        const ToolRun run = runTool(folder, "generate a.obj -o b.glb --crease " + number);
        EXPECT_EQ(run.exit_code, 2) << number;
    }
}

TEST(Usage, VersionIsPrinted) {
    for (const char* name : {"--version", "-V"}) {
        const ToolRun run = runTool(TempFolder(), name);
        EXPECT_EQ(run.exit_code, 0);
        EXPECT_EQ(run.out.rfind("tspace ", 0), 0U);
        EXPECT_EQ(run.err, "");
    }
}

TEST(Usage, TheHelpCommandPrintsWhatTheHelpOptionPrints) {
    const TempFolder folder;
    EXPECT_EQ(runTool(folder, "help").out, runTool(folder, "--help").out);
    EXPECT_EQ(runTool(folder, "-h").out, runTool(folder, "--help").out);
    for (const std::string command : {"generate", "inspect", "check", "diff", "identify", "help"}) {
        const ToolRun run = runTool(folder, "help " + command);
        EXPECT_EQ(run.exit_code, 0);
        EXPECT_EQ(run.out.rfind("tspace " + command + " - ", 0), 0U) << run.out;
        EXPECT_EQ(run.out, runTool(folder, command + " --help").out);
        EXPECT_EQ(run.out, runTool(folder, command + " --no-such-option -h").out);
    }
    EXPECT_EQ(runTool(folder, "help nonsense").exit_code, 2);
}

TEST(Usage, HelpNamesCommandsAndExitCodes) {
    for (const std::string arguments : {"--help", "generate --help", "inspect --help", "generate -h"}) {
        const ToolRun run = runTool(TempFolder(), arguments);
        EXPECT_EQ(run.exit_code, 0);
        EXPECT_EQ(run.err, "");
        for (const char* text : {"Exit codes:", "0  success", "2  wrong usage", "3  invalid input", "4  a file cannot",
                                 "5  out of memory"}) {
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
                             "mikktspace.",
                             "reference.",
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

/// Returns pairs of an option's long name and the default that the help of a command states for it.
std::vector<std::pair<std::string, std::string>> defaultsInHelp(const std::string& command) {
    std::vector<std::pair<std::string, std::string>> found;
    std::istringstream lines(runTool(TempFolder(), command + " --help").out);
    std::string option;
    for (std::string line; std::getline(lines, line);) {
        std::smatch matched;
        if (std::regex_search(line, matched, std::regex("^  (?:-\\w, )?(--\\S+)"))) option = matched[1];
        if (std::regex_search(line, matched, std::regex("Default: (\\S+)\\.$"))) found.emplace_back(option, matched[1]);
    }
    return found;
}

TEST(Usage, EveryOptionTakesTheDefaultThatHelpGivesForIt) {
    for (const std::string command :
         {"generate", "check", "diff", "identify", "finish", "bake", "compress-map", "render"}) {
        const auto defaults = defaultsInHelp(command);
        EXPECT_GT(defaults.size(), 0U) << command;
        for (const auto& [option, value] : defaults)
            EXPECT_EQ(runTool(TempFolder(), command + " " + option + "=" + value).err.find(option), std::string::npos)
                << command << " refuses " << option << "=" << value;
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
