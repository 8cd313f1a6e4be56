// SPDX-License-Identifier: MIT
// The JSON output conforms to docs/schema. All other tests of the tool check this too; this file tests documents that
// no other test covers.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "images/images.h"
#include "tool/run_tool.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;

/// Returns the JSON document of a run. runTool validates it against its schema.
Json documentOf(const TempFolder& folder, const std::string& arguments, int exit_code) {
    const ToolRun run = runTool(folder, arguments + " --json");
    EXPECT_EQ(run.exit_code, exit_code) << run.err;
    Json document = Json::parse(run.out, nullptr, false);
    EXPECT_EQ(document["schema"], "tspace." + arguments.substr(0, arguments.find(' ')) + "/1");
    EXPECT_EQ(document["exitCode"], exit_code);
    return document;
}

/// Runs a command on a valid file and on an invalid one.
void expectBoth(const std::string& arguments) {
    const TempFolder folder;
    writeFoldedObj(folder, "in/a.obj");
    folder.write("in/bad.obj", "f 1 2 3\n");
    const Json document = documentOf(folder, arguments, 3);
    EXPECT_EQ(document["ok"], false);
    ASSERT_EQ(document["files"].size(), 2U);
    EXPECT_EQ(document["files"][0]["error"], nullptr);
    EXPECT_EQ(document["files"][1]["error"]["code"], "invalidFile");
    EXPECT_EQ(document["files"][1]["error"]["place"], "line 1");
}

TEST(JsonOutput, ReportsTheResultOfEachFile) {
    expectBoth("generate in -o out --flip-green");
    expectBoth("inspect in");
    expectBoth("identify in");
    expectBoth("check in");
}

TEST(JsonOutput, OfGenerateHasConvertedMaps) {
    const TempFolder folder;
    folder.write("sheet.mtl", "newmtl skin\nmap_Bump bump.png\n");
    folder.write("bump.png", pngFile(normalMapOf(8, bumps)));
    folder.write("a.obj",
                 "mtllib sheet.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\nvt 0 0\nvt 1 0\nvt 0.7 1\nvt 0 1\n"
                 "vn 0 0 1\nusemtl skin\nf 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n");
    documentOf(folder, "generate a.obj -o a.glb", 0);
    const Json converted = documentOf(folder, "generate a.glb -o b.glb --overwrite --method flat --convert-maps", 0);
    EXPECT_EQ(converted["files"][0]["convertedMaps"].size(), 1U);
}

TEST(JsonOutput, OfCheckHasPackedFrames) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    documentOf(folder, "generate a.obj -o a.glb --convention opengl --pack frame32", 0);
    const Json document = documentOf(folder, "check a.glb --fail-on note", 1);
    EXPECT_EQ(document["files"][0]["packedFrames"].size(), 1U);
    EXPECT_FALSE(document["files"][0]["findings"].empty());
}

TEST(JsonOutput, OfMapsIsThereWithAndWithoutAModel) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    folder.write("bump.png", pngFile(normalMapOf(8, bumps)));
    const std::string convert = "convert-map bump.png -o b.png";
    EXPECT_TRUE(documentOf(folder, convert + " --mesh a.obj --to-mesh ./a.obj", 0)["to"].is_object());
    EXPECT_TRUE(documentOf(folder, convert + " --mesh a.obj", 0)["to"].is_null());
    EXPECT_TRUE(documentOf(folder, convert, 0)["from"].is_null());
    EXPECT_TRUE(documentOf(folder, "height-to-normal bump.png -o b.png --mesh a.obj", 0)["mesh"].is_object());
    EXPECT_TRUE(documentOf(folder, "height-to-normal bump.png -o b.png", 0)["mesh"].is_null());
    documentOf(folder, "height-to-normal none.png -o b.png", 4);
}

TEST(JsonOutput, OfDiffIsThereForEqualAndDifferentAndMissingFiles) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    folder.write("small.obj", "v 0 0 0\nv 1 0 0\nv 0 9 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    for (const char* arguments : {"generate a.obj -o a.glb", "generate a.obj -o b.glb --convention opengl",
                                  "generate small.obj --all -o c.glb"}) {
        documentOf(folder, arguments, 0);
    }
    EXPECT_FALSE(documentOf(folder, "diff a.glb b.glb", 1)["worst"].empty());
    EXPECT_TRUE(documentOf(folder, "diff a.glb c.glb", 1)["primitives"][0]["b"].is_null());
    documentOf(folder, "diff c.glb c.glb", 0);
    documentOf(folder, "diff a.glb none.glb", 4);
}

/// Returns a valid report, which tests then make invalid.
Json soundReport() {
    const TempFolder folder;
    writeFoldedObj(folder, "in/a.obj");
    folder.write("in/bad.obj", "f 1 2 3\n");
    return documentOf(folder, "check in", 3);
}

TEST(JsonOutput, ViolationsOfASchemaAreDetected) {
    const Json sound = soundReport();
    EXPECT_EQ(reportFaults(sound.dump()), "");
    const auto expectFault = [&](const char* place, const Json& value, const std::string& words) {
        Json spoilt = sound;
        const Json::json_pointer pointer(place);
        if (value.is_discarded()) {
            spoilt[pointer.parent_pointer()].erase(pointer.back());
        } else {
            spoilt[pointer] = value;
        }
        EXPECT_NE(reportFaults(spoilt.dump()).find(words), std::string::npos) << place << reportFaults(spoilt.dump());
    };
    const Json nothing(Json::value_t::discarded);
    expectFault("/color", "red", "'color'");
    expectFault("/files/0/color", "red", "'color'");
    expectFault("/files/1/error/color", "red", "'color'");
    expectFault("/failOn", nothing, "'failOn'");
    expectFault("/failOn", "all", "failOn");
    expectFault("/files/0/counts", nothing, "'counts'");
    expectFault("/files/0/counts/error", -1, "error");
    expectFault("/files/0/counts/error", 0.5, "error");
    expectFault("/files/0/findings", nullptr, "findings");
    expectFault("/files/1/format", "glb", "no more than 3");
    expectFault("/files/1/error/code", 3, "code");
}

TEST(JsonOutput, OfAnUnknownSchemaIsAnError) {
    EXPECT_THROW(reportFaults(R"({"schema": "tspace.nothing/1"})"), std::runtime_error);
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
