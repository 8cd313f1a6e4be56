// SPDX-License-Identifier: MIT
// The JSON output is what docs/json.md says: every field, no other, of the type that stands there.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "maps/images.h"
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

void collect(const Json& value, const std::string& path, std::map<std::string, std::set<std::string>>& fields) {
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

/// The fields of all documents together are those that the page lists, with the types that it names.
void expectFieldsDocumented(const std::vector<Json>& documents, const std::string& schema) {
    std::map<std::string, std::set<std::string>> found;
    for (const Json& document : documents) collect(document, "", found);
    const std::map<std::string, std::string> documented = documentedFields(schema);
    ASSERT_GT(documented.size(), 20U);
    for (const auto& [path, type] : documented) {
        ASSERT_EQ(found.count(path), 1U) << path << " is documented but not there";
        for (const std::string& actual : found[path]) EXPECT_NE(type.find(actual), std::string::npos) << path;
    }
    for (const auto& [path, types] : found) EXPECT_EQ(documented.count(path), 1U) << path << " is not documented";
}

/// A run over a good and a bad file shows every field there is, together with those of `more`.
void expectDocumented(const std::string& arguments, const std::string& schema, std::vector<Json> more = {}) {
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

    more.push_back(document);
    expectFieldsDocumented(more, schema);
}

TEST(JsonOutput, OfGenerateIsAsDocumented) {
    const TempFolder folder;
    folder.write("sheet.mtl", "newmtl skin\nmap_Bump bump.png\n");
    folder.write("bump.png", pngFile(normalMapOf(8, bumps)));
    folder.write("a.obj",
                 "mtllib sheet.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\nvt 0 0\nvt 1 0\nvt 0.7 1\nvt 0 1\n"
                 "vn 0 0 1\nusemtl skin\nf 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n");
    ASSERT_EQ(runTool(folder, "generate -q a.obj -o a.glb").exit_code, 0);
    const ToolRun run = runTool(folder, "generate a.glb -o b.glb --overwrite --method flat --convert-maps --json");
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Json converted = Json::parse(run.out);
    EXPECT_EQ(converted["files"][0]["convertedMaps"].size(), 1U);
    expectDocumented("generate in -o out --json --flip-green", "tspace.generate/1", {converted});
}

TEST(JsonOutput, OfConvertMapIsAsDocumented) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    folder.write("bump.png", pngFile(normalMapOf(8, bumps)));
    std::vector<Json> documents;
    for (const std::string arguments : {"bump.png --mesh a.obj --to-mesh ./a.obj", "bump.png"}) {
        documents.push_back(Json::parse(runTool(folder, "convert-map --json -o b.png " + arguments).out));
    }
    expectFieldsDocumented(documents, "tspace.convert-map/1");
}

TEST(JsonOutput, OfHeightToNormalIsAsDocumented) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    folder.write("bump.png", pngFile(normalMapOf(8, bumps)));
    std::vector<Json> documents;
    for (const std::string arguments : {"bump.png --mesh a.obj", "bump.png", "none.png"}) {
        documents.push_back(Json::parse(runTool(folder, "height-to-normal --json -o b.png " + arguments).out));
    }
    expectFieldsDocumented(documents, "tspace.height-to-normal/1");
}

TEST(JsonOutput, OfInspectIsAsDocumented) { expectDocumented("inspect in --json", "tspace.inspect/1"); }

TEST(JsonOutput, OfDiffIsAsDocumented) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    folder.write("small.obj", "v 0 0 0\nv 1 0 0\nv 0 9 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    for (const std::string arguments : {"generate a.obj -o a.glb", "generate a.obj -o b.glb --convention opengl",
                                        "generate small.obj --all -o c.glb"}) {
        ASSERT_EQ(runTool(folder, arguments).exit_code, 0);
    }
    std::vector<Json> documents;
    const auto run = [&](const std::string& files, int exit_code) {
        const ToolRun done = runTool(folder, "diff " + files + " --json");
        EXPECT_EQ(done.exit_code, exit_code) << done.err;
        documents.push_back(Json::parse(done.out));
        EXPECT_EQ(documents.back()["exitCode"], exit_code);
    };
    run("a.glb b.glb", 1);
    run("a.glb c.glb", 1);
    run("c.glb c.glb", 0);
    run("a.glb none.glb", 4);
    expectFieldsDocumented(documents, "tspace.diff/1");
}

/// `command` over a folder with a good and a bad file; `made`: options of generate for the good one.
void expectFolderDocumented(const std::string& command, const std::string& made, const std::string& schema) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    runTool(folder, "generate a.obj -o in/a.glb " + made);
    folder.write("in/bad.obj", "f 1 2 3\n");
    const ToolRun run = runTool(folder, command + " in --json");
    EXPECT_EQ(run.exit_code, 3) << run.err;
    expectFieldsDocumented({Json::parse(run.out)}, schema);
}

TEST(JsonOutput, OfIdentifyIsAsDocumented) { expectFolderDocumented("identify", "", "tspace.identify/1"); }

TEST(JsonOutput, OfCheckIsAsDocumented) {
    expectFolderDocumented("check", "--convention opengl --pack frame32", "tspace.check/1");
}

TEST(JsonOutput, IsTheSameWithQuiet) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    EXPECT_EQ(runTool(folder, "inspect a.obj --json --quiet").out, runTool(folder, "inspect a.obj --json").out);
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
