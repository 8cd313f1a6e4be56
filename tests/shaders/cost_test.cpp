// SPDX-License-Identifier: MIT
// The costs in the comments of the shaders equal the counts of operations in the compiled shaders.
#include <gtest/gtest.h>

#include <map>
#include <regex>

#include "operation_counts.h"
#include "read_spirv.h"

namespace tspace::shaders {

namespace {

/// Returns the text of the comments "// Cost: ...", by the name of the function that follows.
std::map<std::string, std::string> statedCosts(const std::string& file_name) {
    std::ifstream file(TSPACE_SHADER_FOLDER "/" + file_name);
    const std::regex stated("^// Cost: (.*)\\.$"), function("\\btspace_\\w+(?=\\()");
    std::map<std::string, std::string> costs;
    std::string cost;
    std::smatch match;
    for (std::string line; std::getline(file, line);) {
        if (std::regex_search(line, match, stated)) {
            cost = match[1];
        } else if (!cost.empty() && std::regex_search(line, match, function)) {
            costs[match[0]] = cost;
            cost.clear();
        }
    }
    return costs;
}

TEST(ShaderCosts, EqualTheCompilersCounts) {
    const std::map<std::string, std::string> stated = statedCosts("tspace.glsl");
    std::size_t found = 0;
    for (const auto& [name, count] : countOperations(readSpirv("glsl"))) {
        if (name.rfind("tspace_", 0) != 0) continue;
        ++found;
        ASSERT_EQ(stated.count(name), 1u) << name;
        EXPECT_EQ(stated.at(name), count.text()) << name;
    }
    EXPECT_GE(found, 30u);
}

class ShaderFiles : public testing::TestWithParam<const char*> {};

TEST_P(ShaderFiles, HaveTheFunctionsAndCostsOfTheOthers) {
    EXPECT_EQ(statedCosts(GetParam()), statedCosts("tspace.glsl"));
}

INSTANTIATE_TEST_SUITE_P(Languages, ShaderFiles, testing::Values("tspace.hlsl", "tspace.metal", "tspace.wgsl"));

}  // namespace

}  // namespace tspace::shaders
