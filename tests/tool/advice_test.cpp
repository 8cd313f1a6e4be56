// SPDX-License-Identifier: MIT
// What `mend:` says to run is run, as a user would, on every model: the finding is gone then, and there is no new one.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <utility>

#include "model/model_files.h"
#include "tool/run_tool.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;
using Places = std::set<std::pair<std::string, std::string>>;  // code, place

std::string quoted(const std::string& path) { return "'" + path + "'"; }

/// The findings of a file; fails the test where the tool does.
Json findingsOf(const TempFolder& folder, const std::string& file) {
    const ToolRun run = runTool(folder, "check --json --fail-on error " + quoted(file));
    EXPECT_LE(run.exit_code, 1) << run.err;
    const Json report = Json::parse(run.out, nullptr, false);
    return report.is_object() ? report["files"][0]["findings"] : Json::array();
}

/// What follows `tspace` in each command that the text names.
std::set<std::string> commandsIn(const std::string& text) {
    static const std::regex pattern("tspace (generate(?: --[a-z-]+(?: [a-z0-9]+(?=[ .,;:]))?)*)");
    std::set<std::string> commands;
    for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at) commands.insert((*at)[1]);
    return commands;
}

Places placesOf(const Json& findings) {
    Places places;
    for (const Json& finding : findings) places.emplace(finding["code"], finding["place"]);
    return places;
}

class Advice : public testing::TestWithParam<std::string> {};

TEST_P(Advice, MendsTheFindingThatItStandsBelowAndMakesNoNewOne) {
    if (GetParam().empty()) GTEST_SKIP() << "test data " << shared("models") << " is not there";
    const std::string input = std::filesystem::absolute(shared("models") / GetParam()).string();
    const TempFolder folder;
    const Json before = findingsOf(folder, input);
    std::set<std::string> commands;
    for (const Json& finding : before) commands.merge(commandsIn(finding["remedy"]));
    for (const std::string& command : commands) {
        const std::string output = "out/" + std::filesystem::path(input).filename().string();
        std::filesystem::create_directories(folder.path("out"));
        const ToolRun run = runTool(folder, command + " " + quoted(input) + " -o " + quoted(output));
        ASSERT_EQ(run.exit_code, 0) << command << ": " << run.err;
        const Places old = placesOf(before), now = placesOf(findingsOf(folder, output));
        for (const Json& finding : before) {
            if (!commandsIn(finding["remedy"]).contains(command)) continue;
            EXPECT_FALSE(now.contains({finding["code"], finding["place"]}))
                << command << " does not mend " << finding["code"] << " at " << finding["place"] << ": "
                << finding["message"];
        }
        for (const auto& [code, place] : now) {
            EXPECT_TRUE(old.contains({code, place})) << command << " makes " << code << " at " << place;
        }
        std::filesystem::remove_all(folder.path("out"));
    }
}

INSTANTIATE_TEST_SUITE_P(All, Advice, testing::ValuesIn(modelFiles("models")),
                         [](const auto& model) { return testName(model.param); });

TEST(AdviceTest, FindsCommandsInText) {
    EXPECT_EQ(commandsIn("Store +1 or -1 in w: tspace generate --repair."), std::set<std::string>{"generate --repair"});
    EXPECT_EQ(commandsIn("Run tspace generate. Without it"), std::set<std::string>{"generate"});
    EXPECT_EQ(commandsIn("Negate: tspace generate --repair --convention opengl."),
              std::set<std::string>{"generate --repair --convention opengl"});
    EXPECT_EQ(commandsIn("Unwrap the mesh."), std::set<std::string>{});
}

}  // namespace
}  // namespace tspace::test
