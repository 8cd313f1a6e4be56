// SPDX-License-Identifier: MIT
// tspace check in a build: ignored findings, colors, many files, and SARIF.
#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include <nlohmann/json.hpp>

#include "tool/folder_files.h"
#include "tool/run_tool.h"
#include "tool/sarif_schema.h"
#include "tspace/check.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;

TEST(CheckIgnores, IgnoredCodesAreOmitted) {
    const TempFolder folder;
    writeInverted(folder, "a.glb");
    EXPECT_EQ(runTool(folder, "check a.glb").exit_code, 1);
    const ToolRun run = runTool(folder, "check a.glb folded.obj -v --ignore signsInverted");
    EXPECT_EQ(run.exit_code, 0) << run.out;
    EXPECT_EQ(run.out.find("signsInverted"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("a.glb: nothing found"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("normalsMissing"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("0 errors, 0 warnings, 2 notes"), std::string::npos) << run.out;
    for (const char* both :
         {"--ignore normalsMissing,tangentsMissing", "--ignore normalsMissing --ignore tangentsMissing"}) {
        const ToolRun clean = runTool(folder, std::string("check folded.obj --fail-on note ") + both);
        EXPECT_EQ(clean.exit_code, 0) << clean.out;
        EXPECT_NE(clean.out.find("nothing found"), std::string::npos) << clean.out;
    }
    const Json json = Json::parse(runTool(folder, "check folded.obj --json --ignore normalsMissing").out);
    EXPECT_EQ(json["files"][0]["counts"]["note"], 1);
    EXPECT_EQ(json["files"][0]["findings"].size(), 1U);
}

TEST(CheckIgnores, UnknownCodesAreWrongUsage) {
    const ToolRun run = runTool(TempFolder(), "check a.glb --ignore tangentsUnused,signInverted");
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_NE(run.err.find("did you mean 'signsInverted'"), std::string::npos) << run.err;
    EXPECT_EQ(runTool(TempFolder(), "check a.glb --ignore ''").exit_code, 2);
    EXPECT_EQ(runTool(TempFolder(), "check a.glb --ignore tangentsUnused,").exit_code, 2);
}

TEST(CheckIgnores, FindingsBelowTheSeverityAreOmitted) {
    const TempFolder folder;
    writeInverted(folder, "a.glb");
    const ToolRun errors = runTool(folder, "check a.glb folded.obj -v --severity error");
    EXPECT_NE(errors.out.find("signsInverted"), std::string::npos);
    EXPECT_EQ(errors.out.find("normalsMissing"), std::string::npos) << errors.out;
    EXPECT_NE(errors.out.find("folded.obj: nothing found"), std::string::npos) << errors.out;
    EXPECT_EQ(errors.exit_code, 1);
    EXPECT_EQ(runTool(folder, "check folded.obj --fail-on note").exit_code, 1);
    EXPECT_EQ(runTool(folder, "check folded.obj --fail-on note --severity warning").exit_code, 0);
    EXPECT_EQ(runTool(folder, "check folded.obj --severity fatal").exit_code, 2);
}

TEST(CheckColors, FollowTheUsersSettings) {
    const TempFolder folder;
    writeInverted(folder, "a.glb");
    const auto is_colored = [&](const std::string& options, const std::string& environment = "") {
        return runTool(folder, "check a.glb " + options, environment).out.find("\x1b[") != std::string::npos;
    };
    EXPECT_TRUE(is_colored("--color always"));
    EXPECT_TRUE(is_colored("--color=always", "NO_COLOR=1")) << "an option is nearer than the environment";
    EXPECT_FALSE(is_colored("--color never"));
    EXPECT_FALSE(is_colored("--color auto")) << "stdout is no terminal";
    EXPECT_FALSE(is_colored(""));
    EXPECT_EQ(runTool(folder, "check a.glb --color sometimes").exit_code, 2);
    // The program script provides a terminal.
    if (std::system("command -v script > /dev/null") != 0) GTEST_SKIP() << "script is missing";
    const auto on_terminal = [&](const std::string& environment) {
        const std::string command = "cd '" + folder.path().string() + "' && " + environment +
                                    " TERM=xterm script -qec '" +
                                    TSPACE_TOOL " check a.glb' typescript > /dev/null < /dev/null";
        EXPECT_GE(std::system(command.c_str()), 0);
        return folder.read("typescript").find("\x1b[1;31m") != std::string::npos;
    };
    EXPECT_TRUE(on_terminal(""));
    EXPECT_FALSE(on_terminal("NO_COLOR=1"));
}

TEST(ManyFiles, GetOneLineEachAndASummaryByCode) {
    const TempFolder folder;
    for (int i = 0; i < 12; ++i) writeInverted(folder, "in/m" + std::to_string(i) + ".glb");
    const ToolRun brief = runTool(folder, "check in");
    EXPECT_EQ(std::count(brief.out.begin(), brief.out.end(), '\n'), 12 + 2 + 1) << brief.out;
    EXPECT_NE(brief.out.find("  error    signsInverted            12 findings in 12 files\n"), std::string::npos)
        << brief.out;
    EXPECT_EQ(brief.out.find("fix:"), std::string::npos);
    EXPECT_NE(runTool(folder, "check in --verbose").out.find("fix:"), std::string::npos);
    EXPECT_NE(runTool(folder, "check in/m1.glb").out.find("fix:"), std::string::npos);
    for (const char* command : {"inspect in", "identify in"}) {
        const ToolRun run = runTool(folder, command);
        EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 12) << run.out;
        EXPECT_GT(runTool(folder, std::string(command) + " -v").out.size(), 2 * run.out.size());
    }
    const ToolRun generate = runTool(folder, "generate in -o out --overwrite");
    EXPECT_EQ(std::count(generate.out.begin(), generate.out.end(), '\n'), 12 + 2) << generate.out;
    EXPECT_NE(generate.out.find("in/m3.glb -> out/m3.glb: 1 primitive: 1 replaced; 1 warning (--verbose shows them)\n"),
              std::string::npos)
        << generate.out;
    EXPECT_NE(generate.out.find("\n  12 primitives: 12 replaced\n"), std::string::npos) << generate.out;
    EXPECT_NE(runTool(folder, "generate in -o out2 -v").out.find("  mesh  prim"), std::string::npos);
}

/// Checks that the log conforms to the SARIF schema, and to additional requirements of CI systems.
void expectValidSarif(const Json& log) {
    SarifSchema().expectValid(log);
    ASSERT_EQ(log.at("runs").size(), 1U);
    const Json& driver = log["runs"][0]["tool"]["driver"];
    EXPECT_EQ(driver.at("name"), "tspace");
    std::set<std::string> ids;
    for (const Json& rule : driver.at("rules")) EXPECT_TRUE(ids.insert(rule.at("id")).second) << "ids are unique";
    for (const Json& result : log["runs"][0].at("results")) {
        EXPECT_EQ(driver["rules"].at(result.at("ruleIndex").get<std::size_t>()).at("id"), result.at("ruleId"));
        EXPECT_TRUE(result.at("locations").at(0).at("physicalLocation").contains("region")) << "CI systems want a line";
        EXPECT_FALSE(result.at("message").at("text").get<std::string>().empty());
    }
}

TEST(Sarif, ContainsEveryFindingWithItsLocation) {
    const TempFolder folder;
    writeInverted(folder, "in/a b%\xc3\xa9.glb");
    const ToolRun run = runTool(folder, "check in --sarif out.sarif");
    EXPECT_EQ(run.exit_code, 1) << run.err;
    EXPECT_NE(run.out.find("1 error"), std::string::npos) << "the text stays";
    const Json log = Json::parse(folder.read("out.sarif"));
    expectValidSarif(log);
    const Json& results = log["runs"][0]["results"];
    ASSERT_EQ(results.size(), 1U);
    EXPECT_EQ(results[0]["ruleId"], "signsInverted");
    EXPECT_EQ(results[0]["level"], "error");
    const Json& location = results[0]["locations"][0];
    EXPECT_EQ(location["physicalLocation"]["artifactLocation"]["uri"], "in/a%20b%25%C3%A9.glb");
    EXPECT_EQ(location["logicalLocations"][0]["fullyQualifiedName"], "/meshes/0/primitives/0");
    EXPECT_EQ(log["runs"][0]["invocations"][0]["exitCode"], 1);
    EXPECT_EQ(log["runs"][0]["tool"]["driver"]["rules"].size(), kFindingCodeCount);
    EXPECT_EQ(folder.files().count("out.sarif"), 1U);
    EXPECT_EQ(folder.files().size(), 5U) << "no temporary file stays";
}

TEST(Sarif, LinksToTheRowOfEachCode) {
    TempFolder folder;
    writeFoldedObj(folder, "folded.obj");
    const Json log = Json::parse(runTool(folder, "check folded.obj --sarif -").out);
    std::ifstream file(TSPACE_DOCS_DIR "/reference/check.md");
    const std::string page((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    for (const Json& rule : log["runs"][0]["tool"]["driver"]["rules"]) {
        const auto id = rule["id"].get<std::string>();
        EXPECT_FALSE(rule.contains("helpUri")) << "this build knows no stable address of its documentation";
        EXPECT_NE(page.find("<a id=\"" + id + "\"></a>"), std::string::npos) << id;
    }
}

TEST(Sarif, IsTheOnlyOutputOnStdout) {
    const TempFolder folder;
    writeInverted(folder, "a.glb");
    for (const char* options : {"--sarif -", "--sarif - --quiet", "--sarif - --severity error"}) {
        const Json log = Json::parse(runTool(folder, std::string("check a.glb ") + options).out, nullptr, false);
        ASSERT_FALSE(log.is_discarded()) << options;
        expectValidSarif(log);
    }
    const Json ignored = Json::parse(runTool(folder, "check a.glb --sarif - --ignore signsInverted").out);
    EXPECT_EQ(ignored["runs"][0]["results"].size(), 0U);
    const Json notes = Json::parse(runTool(folder, "check folded.obj --sarif -").out);
    expectValidSarif(notes);
    ASSERT_EQ(notes["runs"][0]["results"].size(), 2U);
    EXPECT_EQ(notes["runs"][0]["results"][0]["level"], "note");
    EXPECT_EQ(runTool(folder, "check a.glb --sarif - --json").exit_code, 2);
}

TEST(Sarif, ListsUnreadableFiles) {
    const TempFolder folder;
    folder.write("bad.glb", "glTF");
    const ToolRun run = runTool(folder, "check bad.glb --sarif -");
    EXPECT_EQ(run.exit_code, 3);
    const Json log = Json::parse(run.out);
    expectValidSarif(log);
    const Json& invocation = log["runs"][0]["invocations"][0];
    EXPECT_EQ(invocation["executionSuccessful"], false);
    ASSERT_EQ(invocation["toolExecutionNotifications"].size(), 1U);
    EXPECT_EQ(invocation["toolExecutionNotifications"][0]["level"], "error");
    EXPECT_EQ(log["runs"][0]["results"].size(), 0U);
}

TEST(SarifSchemaOfTheTests, DetectsViolations) {
    const Json good = Json::parse(R"({"version":"2.1.0","runs":[{"tool":{"driver":{"name":"a"}},"results":[]}]})");
    SarifSchema().expectValid(good);
    for (const auto& [pointer, value] :
         {std::pair("/version", Json("2.0.0")),
          {"/other", Json(1)},
          {"/runs/0/tool/driver/rules", Json::parse(R"([{"id":"a"},{"id":"a"}])")},
          {"/runs/0/results", Json::parse(R"([{"message":{"text":"a"},"level":"bad"}])")},
          {"/runs/0/results", Json::parse(R"([{"level":"note"}])")}}) {
        Json bad = good;
        bad[Json::json_pointer(pointer)] = value;
        testing::TestPartResultArray failures;
        {
            testing::ScopedFakeTestPartResultReporter reporter(&failures);
            SarifSchema().expectValid(bad);
        }
        EXPECT_GT(failures.size(), 0) << pointer;
    }
}

TEST(Sarif, UnwritableSarifIsExitCodeFour) {
    const TempFolder folder;
    writeInverted(folder, "a.glb");
    const ToolRun run = runTool(folder, "check a.glb --sarif a.glb/out.sarif");
    EXPECT_EQ(run.exit_code, 4);
    EXPECT_NE(run.err.find("Not a directory"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace tspace::test
