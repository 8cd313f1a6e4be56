// SPDX-License-Identifier: MIT
// Numbers have a decimal point in every locale: in options, files, and messages.
#include <gtest/gtest.h>

#include <cmath>

#include "commands/check/check_report.h"
#include "commands/inspect/inspect_report.h"
#include "commands/shared/request.h"
#include "maps/rays/map_surfaces.h"
#include "model/gltf/draco_primitives.h"
#include "support/comma_locale.h"
#include "support/scene_file.h"
#include "tspace/bake_file.h"
#include "tspace/check.h"
#include "tspace/generate.h"
#include "tspace/inspect.h"
#include "tspace/result.h"

namespace tspace::test {
namespace {

/// Returns all outputs as text, which must be equal in every locale.
std::vector<std::string> answers() {
    std::vector<std::string> all;
    BakeFileOptions bake;
    const options::OptionList list = options::bakeOptions(bake);
    for (const char* reach : {"0.5", "0,5", "1e-3", "2"}) {
        options::Given given;
        bake.map.reach = 0;
        const std::string wrong = options::giveValue(*options::findOption(list, "--reach"), reach, given);
        all.push_back(reach + std::string(wrong.empty() ? " is " : " is wrong: ") + wrong +
                      std::to_string(std::lround(1e6 * bake.map.reach)));
    }
    PositionBox small, large;
    small.add({0, 0, 0});
    small.add({1, 1, 1});
    large.add({0, 0, 0});
    large.add({12.5, 12.5, 12.5});
    all.push_back(misplacement(small, large));

    const TempFolder folder;
    const std::string obj = folder.write(
        "a.obj", "v 0.25 0.5 0.125\nv 1.75 0 0.5\nv 0.5 1.5 0\nvt 0.5 0.25\nvt 0.75 0\nvt 0 1.5\nf 1/1 2/2 3/3\n");
    for (const Compression compression : {Compression::none, Compression::meshopt, Compression::draco}) {
        GenerateOptions options{.selection = {.all = true}, .storage = {.compression = compression}};
        const Result<GenerateReport> made = generateFile(obj, folder.path("a.glb").string(), options);
        all.push_back(made ? folder.read("a.glb") : made.error().message);
        const report::CheckOutcome outcome{.input = "a.glb", .result = checkFile(folder.path("a.glb").string(), {})};
        all.push_back(report::checkJson({outcome}, report::ExitCode::done, Severity::error));
        const report::InspectOutcome inspected{.input = "a.glb",
                                               .result = inspectFile(folder.path("a.glb").string(), {})};
        all.push_back(report::inspectJson({inspected}, report::ExitCode::done));
    }
    return all;
}

TEST(Locale, ChangesNoNumber) {
    const std::vector<std::string> plain = answers();
    EXPECT_EQ(plain[0], "0.5 is 500000");
    EXPECT_NE(plain[1].find("wrong"), std::string::npos);
    EXPECT_EQ(plain[4],
              "the high poly is 12.5 times as large as the low poly: scale the high poly by 0.08 to align it with the "
              "low poly");
    const CommaLocale german;
    if (!german.isThere()) GTEST_SKIP() << "localedef makes no German locale here";
    const std::vector<std::string> in_german = answers();
    ASSERT_EQ(in_german.size(), plain.size());
    for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_EQ(in_german[i], plain[i]) << i;
}

}  // namespace
}  // namespace tspace::test
