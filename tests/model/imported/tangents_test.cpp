// SPDX-License-Identifier: MIT
// Tangents of other formats. Those of FBX are read, with their signs. If a format or the importer cannot provide
// tangents, no report says that the file has none.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "model/imported/with_importer.h"
#include "model/read/read_scene.h"
#include "support/temp_folder.h"
#include "tool/run_tool.h"
#include "tspace/check.h"
#include "tspace/generate.h"
#include "tspace/inspect.h"
#include "tspace/result.h"

namespace tspace::test {
namespace {

std::string layer(const std::string& kind, const std::string& values_name, const std::string& values,
                  std::size_t count) {
    return "LayerElement" + kind +
           ": 0 {\n Version: 101\n Name: \"\"\n MappingInformationType: \"ByPolygonVertex\"\n"
           " ReferenceInformationType: \"Direct\"\n " +
           values_name + ": *" + std::to_string(count) + " {\n a: " + values + "\n }\n}\n";
}

std::string list(const std::vector<std::string>& values) {
    std::string text;
    for (const std::string& value : values) text += (text.empty() ? "" : ",") + value;
    return text;
}

std::vector<std::string> times(const std::string& a, const std::string& b) { return {a, a, a, a, b, b, b, b}; }

/// The tangents and bitangents in the text of an FBX file.
struct Stored {
    std::string tangents = list(times("1,0,0", "-1,0,0"));
    std::string bitangents = list(times("0,1,0", "0,1,0"));
};

/// Writes an FBX file in the text format of Autodesk's SDK: two adjacent squares with a normal map, which is mirrored
/// on the second one.
std::string writeSquares(const TempFolder& folder, const Stored& stored) {
    std::string layers = layer("Normal", "Normals", list(times("0,0,1", "0,0,1")), 24);
    std::vector<std::string> kinds = {"Normal", "UV"};
    if (!stored.bitangents.empty()) {
        layers += layer("Binormal", "Binormals", stored.bitangents, 24);
        kinds.emplace_back("Binormal");
    }
    if (!stored.tangents.empty()) {
        layers += layer("Tangent", "Tangents", stored.tangents, 24);
        kinds.emplace_back("Tangent");
    }
    layers += layer("UV", "UV", "0,0,1,0,1,1,0,1,1,0,0,0,0,1,1,1", 16);
    layers +=
        "LayerElementMaterial: 0 {\n Version: 101\n Name: \"\"\n MappingInformationType: \"AllSame\"\n"
        " ReferenceInformationType: \"IndexToDirect\"\n Materials: *1 {\n a: 0\n }\n}\n";
    kinds.emplace_back("Material");
    layers += "Layer: 0 {\n Version: 100\n";
    writeBumpMap(folder);
    for (const std::string& kind : kinds)
        layers += " LayerElement:  {\n Type: \"LayerElement" + kind + "\"\n TypedIndex: 0\n }\n";
    layers += "}\n";
    return folder.write(
        "squares.fbx",
        "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n FBXHeaderVersion: 1003\n FBXVersion: 7400\n"
        " Creator: \"A modeller 1.0\"\n}\nObjects:  {\nGeometry: 1, \"Geometry::g\", \"Mesh\" {\n"
        "Vertices: *18 {\n a: 0,0,0,1,0,0,2,0,0,0,1,0,1,1,0,2,1,0\n}\n"
        "PolygonVertexIndex: *8 {\n a: 0,1,4,-4,1,2,5,-5\n}\n" +
            layers +
            "}\nModel: 2, \"Model::m\", \"Mesh\" {\n Version: 232\n}\n"
            "Material: 3, \"Material::skin\", \"\" {\n Version: 102\n}\n"
            "Texture: 4, \"Texture::t\", \"\" {\n Type: \"TextureVideoClip\"\n Version: 202\n"
            " FileName: \"bump.png\"\n RelativeFilename: \"bump.png\"\n}\n}\n"
            "Connections:  {\n C: \"OO\",1,2\n C: \"OO\",2,0\n C: \"OO\",3,2\n C: \"OP\",4,3, \"NormalMap\"\n}\n");
}

std::string writePly(const TempFolder& folder) {
    return folder.write("a.ply",
                        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
                        "z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                        "0 0 0\n3 0 0\n1 1 0\n3 0 1 2\n");
}

TEST(ImportTangents, OfFbxAreReadWithTheirSigns) {
    const TempFolder folder;
    const Scene scene = readScene(writeSquares(folder, {}), kWithImporter, false);
    ASSERT_EQ(scene.primitives.size(), 1U);
    const ScenePrimitive& primitive = scene.primitives[0];
    EXPECT_FALSE(primitive.tangents_not_read);
    ASSERT_EQ(primitive.tangents.size(), primitive.positions.size());
    ASSERT_EQ(primitive.tangents.size(), 8U) << "vertices with other tangents stay apart";
    std::size_t plain = 0, mirrored = 0;
    for (const Vec4& t : primitive.tangents) {
        plain += t == Vec4{1, 0, 0, 1};
        mirrored += t == Vec4{-1, 0, 0, -1};
    }
    EXPECT_EQ(plain, 4U);
    EXPECT_EQ(mirrored, 4U);
}

TEST(ImportTangents, OfFbxAreJudgedLikeThoseOfGltf) {
    const TempFolder folder;
    const std::string path = writeSquares(folder, {});
    const Result<Identification> identified = identifyFile(path, {.file = kWithImporter});
    ASSERT_TRUE(identified.ok()) << identified.error().message;
    ASSERT_FALSE(identified->explanations.empty()) << identified->verdict;
    EXPECT_EQ(identified->explanations[0].nearShare(), 1.0);
    EXPECT_EQ(identified->explanations[0].signs(), SignReading::gltf);
    const Result<CheckReport> good = checkFile(path, {.file = kWithImporter});
    ASSERT_TRUE(good.ok());
    EXPECT_EQ(good->error_count, 0U);
    EXPECT_EQ(good->tangents_count, 1U);
    const std::string inverted = writeSquares(folder, {.bitangents = list(times("0,-1,0", "0,-1,0"))});
    const Result<CheckReport> bad = checkFile(inverted, {.file = kWithImporter});
    ASSERT_TRUE(bad.ok());
    ASSERT_GT(bad->error_count, 0U);
    EXPECT_EQ(bad->findings[0].code, FindingCode::signsInverted);
}

TEST(ImportTangents, CorrectOnesAreKeptAndWrongOnesRecomputed) {
    const TempFolder folder;
    const auto actionFor = [&](const Stored& stored) {
        const Result<GenerateReport> report =
            generateFile(writeSquares(folder, stored), folder.path("out.glb").string(), {.file = kWithImporter});
        EXPECT_TRUE(report.ok()) << report.error().message;
        return std::string(actionName(report->primitives[0].action));
    };
    EXPECT_EQ(actionFor({}), "kept");
    EXPECT_EQ(actionFor({.bitangents = list(times("0,-1,0", "0,-1,0"))}), "replaced");
    EXPECT_EQ(actionFor({.tangents = list(times("nan,0,0", "-1,0,0"))}), "replaced");
    EXPECT_EQ(actionFor({.tangents = "", .bitangents = ""}), "generated");
}

TEST(ImportTangents, WithoutBitangentsTheirSignIsNotInvented) {
    const TempFolder folder;
    const std::string path = writeSquares(folder, {.bitangents = ""});
    const Scene scene = readScene(path, kWithImporter, false);
    EXPECT_TRUE(scene.primitives[0].tangents.empty());
    EXPECT_TRUE(scene.primitives[0].tangents_not_read);
}

std::string verdictOn(const std::string& path) {
    const Result<Identification> result = identifyFile(path, {.file = kWithImporter});
    return result ? result->verdict : result.error().message;
}

TEST(ImportTangents, UnreadTangentsAreNotReportedAsMissing) {
    const TempFolder folder;
    const std::string not_read =
        "The tangents of this file, if any, were not read, because the importer does not support them in this format.";
    EXPECT_EQ(verdictOn(writePly(folder)), not_read);
    EXPECT_EQ(verdictOn(writeSquares(folder, {.bitangents = ""})), not_read);
    EXPECT_EQ(verdictOn(writeSquares(folder, {.tangents = "", .bitangents = ""})), "This file contains no tangents.");
    const std::string unsigned_ones = writeSquares(folder, {.bitangents = ""});
    const Result<Inspection> inspected = inspectFile(unsigned_ones, kWithImporter);
    ASSERT_TRUE(inspected.ok());
    EXPECT_FALSE(inspected->primitives[0].has_tangents);
    EXPECT_TRUE(inspected->primitives[0].tangents_not_read);
    const Result<CheckReport> checked = checkFile(unsigned_ones, {.images = false, .file = kWithImporter});
    ASSERT_TRUE(checked.ok());
    ASSERT_EQ(checked->findings.size(), 1U);
    EXPECT_EQ(checked->findings[0].code, FindingCode::tangentsMissing);
    EXPECT_NE(checked->findings[0].message.find("cannot be read from this format"), std::string::npos)
        << checked->findings[0].message;
}

TEST(ImportTangents, UnreadTangentsAreNotComparedAndDiffReportsIt) {
    const TempFolder folder;
    writePly(folder);
    ASSERT_EQ(runTool(folder, "generate a.ply -q -o a.glb").exit_code, 0);
    for (const char* files : {"a.ply a.ply", "a.ply a.glb", "a.glb a.ply"}) {
        const ToolRun run = runTool(folder, std::string("diff ") + files);
        EXPECT_LE(run.exit_code, 1) << run.err;
        EXPECT_NE(run.out.find("were not read, because the importer does not support them in this format"),
                  std::string::npos)
            << run.out;
        EXPECT_EQ(run.out.find("in both"), std::string::npos) << run.out;
    }
    EXPECT_NE(runTool(folder, "diff a.glb a.glb").out.find("no primitive has tangents in both models"),
              std::string::npos);
    const Result<FrameDiff> diff =
        diffFiles(folder.path("a.ply").string(), folder.path("a.glb").string(), {.file = kWithImporter});
    ASSERT_TRUE(diff) << diff.error().message;
    EXPECT_TRUE(diff->primitives.at(0).tangents_not_read_a);
    EXPECT_FALSE(diff->primitives.at(0).tangents_not_read_b);
}

/// Writes a square as a COLLADA file, with the input that exporters call TEXTANGENT.
std::string writeDae(const TempFolder& folder, const std::string& bitangent) {
    const auto source = [](const std::string& id, const std::string& values, int count, const std::string& names) {
        std::string params;
        for (const char name : names) params += std::string("<param name=\"") + name + "\" type=\"float\"/>";
        const std::string width = std::to_string(names.size()), floats = std::to_string(count * names.size());
        return "<source id=\"" + id + "\"><float_array id=\"" + id + "-a\" count=\"" + floats + "\">" + values +
               "</float_array><technique_common><accessor source=\"#" + id + "-a\" count=\"" + std::to_string(count) +
               "\" stride=\"" + width + "\">" + params + "</accessor></technique_common></source>";
    };
    const auto input = [](const std::string& semantic, const std::string& id, int offset) {
        return "<input semantic=\"" + semantic + "\" source=\"#" + id + "\" offset=\"" + std::to_string(offset) +
               "\" set=\"0\"/>";
    };
    return folder.write(
        "square.dae",
        "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">"
        "<asset><up_axis>Y_UP</up_axis></asset><library_geometries><geometry id=\"g\"><mesh>" +
            source("p", "0 0 0 1 0 0 1 1 0 0 1 0", 4, "XYZ") + source("n", "0 0 1", 1, "XYZ") +
            source("t", "0 0 1 0 1 1 0 1", 4, "ST") + source("x", "1 0 0", 1, "XYZ") +
            source("y", bitangent, 1, "XYZ") +
            "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><polylist count=\"1\">" +
            input("VERTEX", "v", 0) + input("NORMAL", "n", 1) + input("TEXCOORD", "t", 2) +
            input("TEXTANGENT", "x", 3) + input("TEXBINORMAL", "y", 4) +
            "<vcount>4</vcount><p>0 0 0 0 0 1 0 1 0 0 2 0 2 0 0 3 0 3 0 0</p></polylist></mesh></geometry>"
            "</library_geometries><library_visual_scenes><visual_scene id=\"s\"><node id=\"o\">"
            "<instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes>"
            "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>");
}

TEST(ImportTangents, OfColladaAreReadWithTheirSigns) {
    const TempFolder folder;
    for (const auto& [bitangent, sign] : {std::pair("0 1 0", 1.0F), {"0 -1 0", -1.0F}}) {
        const Scene scene = readScene(writeDae(folder, bitangent), kWithImporter, false);
        ASSERT_EQ(scene.primitives.size(), 1U);
        const ScenePrimitive& primitive = scene.primitives[0];
        EXPECT_FALSE(primitive.tangents_not_read);
        ASSERT_EQ(primitive.tangents.size(), 4U);
        for (const Vec4& t : primitive.tangents) EXPECT_EQ(t, (Vec4{1, 0, 0, sign}));
    }
}

TEST(ImportTangents, TheGeneratorIsTheProgramThatWroteTheFile) {
    const TempFolder folder;
    const auto generatorOf = [](const std::string& path) {
        const Result<Inspection> result = inspectFile(path, kWithImporter);
        return result ? result->generator : result.error().message;
    };
    const std::string fbx = writeSquares(folder, {}), made = folder.path("out.glb").string();
    EXPECT_EQ(generatorOf(fbx), "A modeller 1.0");
    EXPECT_EQ(generatorOf(writePly(folder)), "");
    ASSERT_TRUE(generateFile(fbx, made, {.file = kWithImporter}).ok());
    EXPECT_EQ(generatorOf(made), "tspace");
    EXPECT_EQ(identifyFile(fbx, {.file = kWithImporter})->generator, "A modeller 1.0");
    EXPECT_EQ(checkFile(fbx, {.file = kWithImporter})->generator, "A modeller 1.0");
}

}  // namespace
}  // namespace tspace::test
