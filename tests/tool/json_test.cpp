// SPDX-License-Identifier: MIT
// The JSON output is what docs/json.md says: every field, no other, of the type that stands there.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "tool/run_tool.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;

/// path -> type of one section of docs/json.md.
std::map<std::string, std::string> documentedFields(const std::string& schema) {
    std::ifstream page(TSPACE_DOCS_DIR "/json.md");
    std::map<std::string, std::string> fields;
    bool in_section = false;
    for (std::string line; std::getline(page, line);) {
        if (line.rfind("## ", 0) == 0) in_section = line == "## " + schema;
        if (!in_section || line.rfind("| `", 0) != 0) continue;
        const std::size_t path_end = line.find('`', 3);
        const std::size_t type_end = line.find(" |", path_end + 4);
        fields[line.substr(3, path_end - 3)] = line.substr(path_end + 4, type_end - path_end - 4);
    }
    return fields;
}

void collect(const Json& value, const std::string& path,
             std::map<std::string, std::set<std::string>>& fields) {
    if (!path.empty() && !path.ends_with("[]")) fields[path].insert(value.type_name());
    if (value.is_object()) {
        for (const auto& [key, member] : value.items()) {
            std::string name = path;
            if (!name.empty()) name += '.';
            name += key;
            collect(member, name, fields);
        }
    }
    if (value.is_array()) {
        for (const Json& entry : value) collect(entry, path + "[]", fields);
    }
}

/// A run over a good and a bad file shows every field there is.
void expectDocumented(const std::string& arguments, const std::string& schema) {
    const TempFolder folder;
    writeFoldedObj(folder, "in/a.obj");
    folder.write("in/bad.obj", "f 1 2 3\n");
    const ToolRun run = runTool(folder, arguments);
    EXPECT_EQ(run.exit_code, 3) << run.err;
    const Json document = Json::parse(run.out, nullptr, false);
    ASSERT_FALSE(document.is_discarded()) << run.out;
    EXPECT_EQ(document["schema"], schema);
    EXPECT_EQ(document["exitCode"], 3);
    EXPECT_EQ(document["ok"], false);
    ASSERT_EQ(document["files"].size(), 2U);
    EXPECT_EQ(document["files"][0]["error"], nullptr);
    EXPECT_EQ(document["files"][1]["error"]["code"], "invalidFile");
    EXPECT_EQ(document["files"][1]["error"]["place"], "line 1");

    std::map<std::string, std::set<std::string>> found;
    collect(document, "", found);
    const std::map<std::string, std::string> documented = documentedFields(schema);
    ASSERT_GT(documented.size(), 20U);
    for (const auto& [path, type] : documented) {
        ASSERT_EQ(found.count(path), 1U) << path << " is documented but not there";
        for (const std::string& actual : found[path]) EXPECT_NE(type.find(actual), std::string::npos) << path;
    }
    for (const auto& [path, types] : found)
        EXPECT_EQ(documented.count(path), 1U) << path << " is not documented";
}

TEST(JsonOutput, OfGenerateIsAsDocumented) {
    expectDocumented("generate in -o out --json", "tspace.generate/1");
}

TEST(JsonOutput, OfInspectIsAsDocumented) { expectDocumented("inspect in --json", "tspace.inspect/1"); }

TEST(JsonOutput, IsTheSameWithQuiet) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    EXPECT_EQ(runTool(folder, "inspect a.obj --json --quiet").out,
              runTool(folder, "inspect a.obj --json").out);
}

TEST(JsonOutput, SurvivesNamesThatAreNotUtf8) {
    const TempFolder folder;
    folder.write("a.obj", "o \xff\xfe\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    for (const std::string arguments : {"inspect a.obj --json", "generate a.obj -o a.glb --json"}) {
        const ToolRun run = runTool(folder, arguments);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        EXPECT_FALSE(Json::parse(run.out, nullptr, false).is_discarded()) << run.out;
    }
}

}  // namespace
}  // namespace tspace::test
