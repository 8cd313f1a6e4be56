// SPDX-License-Identifier: MIT
// Commands that read models with invalid normals, or that replace normals.
#include <sys/stat.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tool/folder_files.h"
#include "tool/normal_models.h"
#include "tool/run_tool.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;

constexpr const char* kInvalid = "normals of length 0, NaN or infinite: 2 vertices (mesh 0, primitive 0)";

std::string writeFault(const TempFolder& folder, const std::string& name, const std::string& file = "sheet.gltf") {
    for (const SheetFault& fault : sheetFaults()) {
        if (name != fault.name) continue;
        Sheet sheet = bentSheetWithTangents();
        fault.apply(sheet);
        return writeSheet(folder, file, sheet);
    }
    ADD_FAILURE() << name;
    return {};
}

std::string fixesOf(const TempFolder& folder, const std::string& arguments) {
    std::string fixes;
    const Json report = Json::parse(runTool(folder, "check --json " + arguments).out);
    for (const Json& finding : report["files"][0]["findings"]) fixes += finding["remedy"].get<std::string>() + "\n";
    return fixes;
}

TEST(InvalidNormals, AreStatedByEveryCommandThatUsesThem) {
    for (const char* fault : {"normalsOfLength0", "tinyNormals", "denormalNormals", "normalsNan", "normalsInfinite"}) {
        TempFolder folder;
        writeFault(folder, fault);
        folder.write("map.png", std::string(std::begin(kFlatPng), std::end(kFlatPng)));
        for (const char* command :
             {"generate sheet.gltf -o a.glb", "generate sheet.gltf -o b.glb --repair", "inspect sheet.gltf",
              "identify sheet.gltf", "diff sheet.gltf sheet.gltf", "render sheet.gltf -o a.png --size 16",
              "convert-map map.png --mesh sheet.gltf --to object -o b.png",
              "height-to-normal map.png --mesh sheet.gltf -o c.png --strength 0.1",
              "bake sheet.gltf --high sheet.gltf -o d.png --size 16",
              "bake sheet.gltf --high sheet.gltf -o e.png --size 16 --out-mesh e.glb",
              "map-error map.png sheet.gltf --high sheet.gltf"}) {
            const ToolRun run = runTool(folder, command);
            EXPECT_LE(run.exit_code, 1) << command << ": " << run.err;
            EXPECT_NE((run.out + run.err).find(kInvalid), std::string::npos) << fault << ": " << command << run.out;
        }
    }
}

TEST(InvalidNormals, OfUnusedVerticesAreNotStated) {
    TempFolder folder;
    Sheet sheet = bentSheetWithTangents();
    setNormals(sheet, 0, 0, 0);
    for (std::uint32_t& corner : sheet.corners) corner = corner == 10 || corner == 24 ? 0 : corner;
    writeSheet(folder, "sheet.gltf", sheet);
    EXPECT_EQ(runTool(folder, "generate sheet.gltf -o a.glb").out.find("of length 0"), std::string::npos);
}

TEST(InvalidNormals, AreStatedAsReplacedIfTheyWere) {
    TempFolder folder;
    writeFault(folder, "normalsNan");
    for (const char* command : {"generate sheet.gltf -o a.glb --overwrite-normals", "finish sheet.gltf -o b.glb"}) {
        const std::string out = runTool(folder, command).out;
        EXPECT_NE(out.find("The normals in the output have unit length"), std::string::npos) << out;
        EXPECT_EQ(out.find("computes new normals)"), std::string::npos) << out;
    }
}

TEST(OverwrittenNormals, LeaveUvsThatCannotBeReadIfTangentsFollowThem) {
    TempFolder folder;
    Sheet sheet = bentSheetWithTangents();
    sheet.has_tangents = true;
    --sheet.uv_count;
    writeSheet(folder, "sheet.gltf", sheet);
    const std::string out = runTool(folder, "generate sheet.gltf -o out/a.gltf --overwrite-normals --crease 60").out;
    EXPECT_NE(out.find("cannot be recomputed, because its TEXCOORD_0 cannot be read"), std::string::npos) << out;
    const Json after = Json::parse(folder.read("out/a.gltf"));
    EXPECT_TRUE(after["meshes"][0]["primitives"][0]["attributes"].contains("TEXCOORD_0"));
    EXPECT_EQ(fixesOf(folder, "out/a.gltf"), fixesOf(folder, "sheet.gltf"));
}

TEST(OverwrittenNormals, LeaveValidNormalsOfUnlitMaterials) {
    TempFolder folder;
    Sheet sheet = bentSheetWithTangents();
    sheet.is_unlit = true;
    writeSheet(folder, "sheet.gltf", sheet);
    const std::string out = runTool(folder, "generate sheet.gltf -o a.glb --overwrite-normals").out;
    EXPECT_NE(out.find("--overwrite-normals has no effect"), std::string::npos) << out;
}

/// Commands that compute tangents must use the convention of the check.
TEST(Remedies, NameTheConventionOfTheCheck) {
    for (const char* fault : {"tiltedTangentsAtLongNormals", "windingWithTangentsOfTriangles", "normalsNan"}) {
        TempFolder folder;
        writeFault(folder, fault);
        const std::string fixes = fixesOf(folder, "sheet.gltf --convention directx");
        for (const char* option : {"--repair", "--overwrite", "--overwrite-normals", "tspace generate"}) {
            const std::size_t at = fixes.find(option + std::string(" --"));
            if (at == std::string::npos || option == std::string("tspace generate")) continue;
            EXPECT_EQ(fixes.find("--convention directx", at), at + std::string(option).size() + 1) << fixes;
        }
        EXPECT_NE(fixes.find("--convention directx"), std::string::npos) << fixes;
    }
}

TEST(FinishedNormals, AreStatedIfTheyWereScaled) {
    TempFolder folder;
    Sheet sheet = bentSheetWithTangents();
    for (float& number : sheet.normals) number *= 1.01F;
    sheet.has_tangents = true;
    writeSheet(folder, "sheet.gltf", sheet);
    const std::string out = runTool(folder, "finish sheet.gltf -o a.glb").out;
    EXPECT_NE(out.find("normals of 1 primitive scaled to unit length"), std::string::npos) << out;
    EXPECT_EQ(out.find("only the format was changed"), std::string::npos) << out;
    const std::string found = runTool(folder, "check sheet.gltf").out;
    EXPECT_NE(found.find("(from 1.01 to 1.01)"), std::string::npos) << found;
}

TEST(ObjOfAnotherEncoding, StatesWhatHappensToItsNames) {
    TempFolder folder;
    folder.write("a.obj", "o \xb0\xa1\xb3\xaa\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    const std::string out = runTool(folder, "generate a.obj -o a.glb --all").out;
    EXPECT_NE(out.find("U+FFFD"), std::string::npos) << out;
    EXPECT_EQ(out.find("bytes are kept"), std::string::npos) << out;
}

/// Images that no step needs must not end a command. Reading a pipe would block.
TEST(ImagesThatAreNoFiles, AreAWarning) {
    TempFolder folder;
    ASSERT_EQ(mkfifo(folder.path("pipe.png").c_str(), 0600), 0);
    std::filesystem::create_directory(folder.path("folder.png"));
    for (const char* image : {"pipe.png", "folder.png"}) {
        Sheet sheet = bentSheetWithTangents();
        sheet.image = image;
        writeSheet(folder, "sheet.gltf", sheet);
        const std::string why = image == std::string("pipe.png") ? "it is not a regular file" : "it is a folder";
        for (const char* command : {"generate sheet.gltf -o a.glb", "generate sheet.gltf -o out/a.gltf",
                                    "generate sheet.gltf -o out/a.gltf --repair", "finish sheet.gltf -o out/b.glb"}) {
            const ToolRun run = runTool(folder, command);
            EXPECT_EQ(run.exit_code, 0) << command << ": " << run.err;
            EXPECT_NE(run.out.find(why), std::string::npos) << command << ": " << run.out;
        }
    }
}

TEST(HiddenNodes, AreNotDrawn) {
    TempFolder folder;
    Sheet sheet = bentSheetWithTangents();
    const char* const kSecond = R"({"mesh": 0, "translation": [0, 0, 2]})";
    const auto drawn = [&](const std::string& nodes) {
        sheet.nodes = Json::parse(nodes);
        writeSheet(folder, "sheet.gltf", sheet);
        return Json::parse(runTool(folder, "render --json sheet.gltf -o a.png --size 16").out)["triangles"];
    };
    constexpr const char* kHidden = R"("extensions": {"KHR_node_visibility": {"visible": false}})";
    const std::string open = R"([{"children": [1, 2]}, {"mesh": 0}, )", hidden = std::string(", ") + kHidden;
    EXPECT_EQ(drawn(open + kSecond + "]"), 144);
    EXPECT_EQ(drawn(open + R"({"children": [3])" + hidden + "}, " + kSecond + "]"), 72);
}

/// Renderers can only draw complete instances.
TEST(InstancesWithAttributesOfDifferentCounts, AreCountedByTheSmallest) {
    TempFolder folder;
    Sheet sheet = bentSheetWithTangents();
    // The attributes have 216 and 49 elements.
    sheet.nodes = Json::parse(
        R"([{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"SORT": 3, "TRANSLATION": 0}}}}])");
    writeSheet(folder, "sheet.gltf", sheet);
    const Json report = Json::parse(runTool(folder, "inspect --json sheet.gltf").out);
    EXPECT_EQ(report["files"][0]["primitives"][0]["instances"], kSheetSize * kSheetSize);
    EXPECT_NE(report["files"][0]["warnings"].dump().find("49 to 216 elements"), std::string::npos) << report;
    const Json findings = findingsIn(folder, "sheet.gltf");
    EXPECT_TRUE(std::any_of(findings.begin(), findings.end(), [](const Json& finding) {
        return finding["code"] == "fileRemark" &&
               finding["message"].get<std::string>().find("node 0 has instancing attributes") == 0;
    })) << findings;
    EXPECT_NE(runTool(folder, "generate sheet.gltf -o out.gltf").out.find("49 to 216 elements"), std::string::npos);
}

}  // namespace
}  // namespace tspace::test
