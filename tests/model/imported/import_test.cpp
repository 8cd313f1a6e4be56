// SPDX-License-Identifier: MIT
// Models in other formats become glTF with frames, and a corrupt model only causes an error.
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <cstring>

#include "model/gltf/primitive_reader.h"
#include "model/imported/import_document.h"
#include "model/imported/with_importer.h"
#include "model/read/read_scene.h"
#include "support/scene_file.h"
#include "support/shared_data.h"
#include "tspace/inspect.h"

namespace tspace::test {
namespace {

/// Converts the glTF file to `format`, a format of Assimp, and returns the path of the new file.
std::string exported(const TempFolder& folder, const std::string& gltf, const std::string& format,
                     const std::string& extension) {
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(gltf, 0);
    if (scene == nullptr) throw std::runtime_error(importer.GetErrorString());
    const std::string path = folder.path("model." + extension).string();
    Assimp::Exporter exporter;
    if (exporter.Export(scene, format, path) != AI_SUCCESS) throw std::runtime_error(exporter.GetErrorString());
    return path;
}

Result<GenerateReport> generate(const std::string& input, const std::string& output, FileOptions file = kWithImporter) {
    GenerateOptions options{.selection = {.all = true}};
    options.file = std::move(file);
    return generateFile(input, output, options);
}

ErrorCode codeOf(const Result<GenerateReport>& report) { return report ? ErrorCode::ok : report.error().code; }

/// Converts exceptions of the library to exceptions that a test prints.
template <class Body>
auto readable(Body&& body) {
    try {
        return body();
    } catch (const FileError& failure) {
        throw std::runtime_error(failure.error.message);
    }
}

Scene sceneOf(const std::string& path) {
    return readable([&] { return readScene(path, kWithImporter, false); });
}

struct Format {
    const char* name;
    const char* extension;
    bool has_uvs;
};

class EachFormat : public testing::TestWithParam<Format> {};

TEST_P(EachFormat, KeepsTheSurfaceAndGetsFrames) {
    const auto& [format, extension, has_uvs] = GetParam();
    const TempFolder folder;
    ModelData sheet = bentSheet(5);
    const std::string original = writeModel(folder, "sheet.glb", {sheet});
    const std::string path = exported(folder, original, format, extension);
    const std::string output = folder.path("out.glb").string();
    const Result<GenerateReport> report = generate(path, output);
    ASSERT_TRUE(report.ok()) << report.error().message;
    const Scene scene = sceneOf(output);
    ASSERT_EQ(scene.primitives.size(), 1U);
    const ScenePrimitive& primitive = scene.primitives[0];
    EXPECT_EQ(primitive.corners.size(), sheet.indices.size());
    EXPECT_EQ(primitive.normals.size(), primitive.positions.size());
    if (!has_uvs) {
        EXPECT_EQ(report->primitives[0].action, PrimitiveAction::impossible);
        return;
    }
    EXPECT_EQ(report->primitives[0].action, PrimitiveAction::generated);
    // Text formats write few digits, but the frames of the sheet still equal those of the glTF file.
    const std::string direct = folder.path("direct.glb").string();
    ASSERT_TRUE(generate(original, direct).ok());
    const Result<FrameDiff> diff = diffFiles(direct, output);
    ASSERT_TRUE(diff.ok());
    EXPECT_EQ(diff->unpaired_triangle_count, 0U);
    EXPECT_EQ(diff->sign_change_count, 0U);
    EXPECT_LT(diff->tangents.max_deg, 0.1);
    EXPECT_LT(diff->normals.max_deg, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Import, EachFormat,
                         testing::Values(Format{"fbxa", "fbx", true}, Format{"collada", "dae", true},
                                         Format{"ply", "ply", true}, Format{"plyb", "ply", true},
                                         Format{"stlb", "stl", false}),
                         [](const auto& format) { return std::string(format.param.name); });

TEST(Import, VerticesAreJoinedOnlyWhereAllBitsAgree) {
    const TempFolder folder;
    const std::string path = exported(folder, writeModel(folder, "sheet.glb", {bentSheet(5)}), "fbxa", "fbx");
    EXPECT_EQ(sceneOf(path).primitives[0].positions.size(), 36U) << "Assimp itself gives every corner its vertex";
}

TEST(Import, UnitsOfFbxBecomeMeters) {
    const TempFolder folder;
    exported(folder, writeModel(folder, "sheet.glb", {bentSheet(2)}), "fbxa", "fbx");
    const std::string text = folder.read("model.fbx");
    const std::string key = "\"UnitScaleFactor\", \"double\", \"Number\", \"\",";
    ASSERT_NE(text.find(key), std::string::npos) << text.substr(0, 3000);
    const std::size_t begin = text.find(key) + key.size();
    const std::size_t size = text.find('\n', begin) - begin;
    // Units are in centimeters. Negative units are ignored.
    for (const auto& [unit, scale] : {std::pair("1", 0.01F), {"2.54", 0.0254F}, {"100", 1.0F}, {"-1", 1.0F}}) {
        folder.write("units.fbx", std::string{text}.replace(begin, size, unit));
        const std::string path = folder.path("units.fbx").string();
        const DrawnScene drawn = readable([&] { return readDrawnScene(path, kWithImporter, false); });
        ASSERT_EQ(drawn.placements.size(), 1U);
        EXPECT_NEAR(length(drawn.placements[0].to_world.x), static_cast<double>(scale), 1e-7) << unit;
    }
}

TEST(Import, TriangulatesPolygonsByTheRuleOfTspace) {
    const TempFolder folder;
    // The diagonal from corner 0 to corner 2 is the shorter one.
    const std::string path =
        folder.write("quad.ply",
                     "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                     "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                     "end_header\n0 0 0\n3 0 0\n1 1 0\n0 3 0\n4 0 1 2 3\n");
    const Scene scene = sceneOf(path);
    EXPECT_EQ(std::vector<std::uint32_t>(scene.primitives[0].corners.begin(), scene.primitives[0].corners.end()),
              (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
}

TEST(Import, KeepsNormalMapsUvSetsAndImages) {
    const TempFolder folder;
    folder.write("bump%20map.png", "not looked at");
    GltfBuilder builder;
    const ModelData sheet = bentSheet(2);
    Json& primitive = builder.addPrimitive({{"POSITION", builder.addFloats(floatsOf(sheet.positions), 3)},
                                            {"NORMAL", builder.addFloats(floatsOf(sheet.normals), 3)},
                                            {"TEXCOORD_0", builder.addFloats(floatsOf(sheet.uvs), 2)}});
    primitive["material"] = 0;
    primitive["indices"] = builder.addAccessor(sheet.indices, 5125, "SCALAR", sheet.indices.size());
    builder.json()["images"] = Json::array({Json{{"uri", "bump.png"}}});
    builder.json()["textures"] = Json::array({Json{{"source", 0}}});
    builder.json()["materials"] = Json::array({Json{{"name", "skin"}, {"normalTexture", {{"index", 0}}}}});
    builder.json()["nodes"] = Json::array({Json{{"mesh", 0}}});
    builder.json()["scenes"] = Json::array({Json{{"nodes", {0}}}});
    builder.json()["scene"] = 0;
    const std::string gltf = folder.write("a.glb", std::span<const std::uint8_t>(builder.glb()));
    const Scene scene = sceneOf(exported(folder, gltf, "fbxa", "fbx"));
    ASSERT_EQ(scene.primitives.size(), 1U);
    EXPECT_EQ(scene.primitives[0].material_name, "skin");
    ASSERT_EQ(scene.primitives[0].uses.size(), 1U);
    EXPECT_EQ(scene.primitives[0].uses[0].needed_by, "normalTexture");
    ASSERT_TRUE(scene.primitives[0].uses[0].image.has_value());
    EXPECT_EQ(scene.images[*scene.primitives[0].uses[0].image].uri, "bump.png");
}

TEST(Import, KeepsSkinsMorphsAndAnimations) {
    struct Case {
        const char* file;
        const char* what;  ///< name of a member in the JSON of the output
    };
    for (const auto& [file, what] :
         {Case{"models/features/box-morph.gltf", "\"targets\""},
          Case{"models/asset-generator/Animation_SkinType/Animation_SkinType_02.gltf", "\"skins\""},
          Case{"models/asset-generator/Animation_SkinType/Animation_SkinType_02.gltf", "\"WEIGHTS_0\""},
          Case{"models/asset-generator/Animation_SkinType/Animation_SkinType_02.gltf", "\"animations\""}}) {
        TSPACE_NEEDS_SHARED(file);
        const TempFolder folder;
        const std::string path = exported(folder, shared(file).string(), "fbxa", "fbx");
        const gltf::Document document = readable([&] { return importDocument(path, kWithImporter); });
        EXPECT_NE(document.json.dump().find(what), std::string::npos) << file << " " << what;
        EXPECT_TRUE(generate(path, folder.path("out.glb").string()).ok());
    }
}

TEST(Import, ValuesThatAreNotFiniteAreReplacedAndReported) {
    const TempFolder folder;
    const std::string path =
        folder.write("nan.ply",
                     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                     "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                     "end_header\n0 0 0\n3 0 nan\n1 inf 0\n3 0 1 2\n");
    const gltf::Document document = readable([&] { return importDocument(path, kWithImporter); });
    EXPECT_EQ(document.json.dump().find("null"), std::string::npos) << "JSON has no word for NaN";
    EXPECT_EQ(document.warnings, (std::vector<std::string>{"2 positions are not finite and were moved to the origin"}));
    const Scene scene = sceneOf(path);
    ASSERT_EQ(scene.primitives[0].positions.size(), 1U) << "all three are at the origin now";
    EXPECT_EQ(scene.primitives[0].positions[0], (Vec3{0, 0, 0}));
}

/// Returns a sheet of 3 x 3 vertices, `step` apart, with its corner at (x, y). It is a text STL, which has more digits
/// than floats.
std::string stlSheet(double x, double y, double step) {
    std::string text = "solid sheet\n";
    for (const int a : {0, 1, 3, 4}) {
        for (const std::array<int, 3>& face : {std::array{a, a + 1, a + 4}, std::array{a, a + 4, a + 3}}) {
            text += "facet normal 0 0 1\nouter loop\n";
            for (const int i : face)
                text +=
                    "vertex " + std::to_string(x + step * (i % 3)) + " " + std::to_string(y + step * (i / 3)) + " 0\n";
            text += "endloop\nendfacet\n";
        }
    }
    return text + "endsolid sheet\n";
}

/// Returns the sheet as a PLY file. `type`: type of the coordinates. `format`: "ascii", or a binary format, in which
/// coordinates are doubles.
std::string plySheet(double x, double y, double step, const std::string& format, const std::string& type = "double") {
    std::string text = "ply\nformat " + format + " 1.0\nelement vertex 9\nproperty uchar tag\n";
    for (const char* axis : {"x", "y", "z"}) text += "property " + type + " " + axis + "\n";
    text += "element face 8\nproperty list uchar int vertex_indices\nend_header\n";
    const bool is_text = format == "ascii", is_big = format == "binary_big_endian";
    const auto append = [&](auto value) {
        std::array<char, sizeof value> bytes;
        std::memcpy(bytes.data(), &value, sizeof value);
        if (is_big) std::reverse(bytes.begin(), bytes.end());
        is_text ? text += std::to_string(value) + " " : text.append(bytes.data(), bytes.size());
    };
    for (int i = 0; i < 9; ++i) {
        append(static_cast<std::uint8_t>(9));
        for (const double value : {x + step * (i % 3), y + step * (i / 3), 0.25}) append(value);
        if (is_text) text += "\n";
    }
    for (const int a : {0, 1, 3, 4}) {
        for (const std::array<int, 3>& face : {std::array{a, a + 1, a + 4}, std::array{a, a + 4, a + 3}}) {
            append(static_cast<std::uint8_t>(3));
            for (const int i : face) append(i);
            if (is_text) text += "\n";
        }
    }
    return text;
}

TEST(Import, WarnsAboutPositionsThatFloatsCannotRepresent) {
    const TempFolder folder;
    const auto warns = [&](const std::string& stl) {
        const std::string path = folder.write("sheet.stl", stl);
        const gltf::Document document = readable([&] { return importDocument(path, kWithImporter); });
        return !document.warnings.empty() && document.warnings[0].find("far from the origin") != std::string::npos;
    };
    EXPECT_TRUE(warns(stlSheet(456123, 5261789, 0.7)));
    EXPECT_FALSE(warns(stlSheet(456123, 5261789, 1000.3))) << "the steps are small for edges of this length";
    EXPECT_FALSE(warns(stlSheet(456128, 5261824, 64))) << "whole numbers are not rounded";
    EXPECT_FALSE(warns(stlSheet(3, 7, 0.7)));
}

TEST(Import, PlyFarFromTheOriginKeepsItsShape) {
    const TempFolder folder;
    constexpr double kX = 456123.4, kY = 5261789.3, kStep = 0.05;
    for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        const std::string path = folder.write(format + ".ply", plySheet(kX, kY, kStep, format));
        const Result<GenerateReport> report = generate(path, folder.path("out.glb").string());
        ASSERT_TRUE(report) << report.error().message;
        ASSERT_EQ(report->warnings.size(), 1U) << format;
        EXPECT_NE(report->warnings[0].find("was subtracted"), std::string::npos);
        const DrawnScene drawn = readable([&] { return readDrawnScene(folder.path("out.glb").string(), {}, false); });
        const Affine& place = drawn.placements[0].to_world;
        EXPECT_EQ(place.origin.y, report->coordinate_offset[1]);
        EXPECT_NEAR(place.origin.y, kY, 0.2);
        const std::span<const Vec3> positions = drawn.scene.primitives[0].positions.span();
        ASSERT_EQ(positions.size(), 9U);
        DVec3 least{1e9, 1e9, 1e9}, most{-1e9, -1e9, -1e9};
        for (const Vec3& position : positions) {
            const DVec3 p = place.point(toDouble(position));
            least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
            most = {std::max(most.x, p.x), std::max(most.y, p.y), std::max(most.z, p.z)};
        }
        EXPECT_LT(length(least - DVec3{kX, kY, 0.25}), 1e-6) << format;
        EXPECT_LT(length(most - DVec3{kX + 2 * kStep, kY + 2 * kStep, 0.25}), 1e-6) << format;
        EXPECT_EQ(inspectFile(path, kWithImporter)->coordinate_offset[1], place.origin.y);
    }
    FileOptions keep = kWithImporter;
    keep.keep_coordinates = true;
    const Result<GenerateReport> kept =
        generate(folder.path("ascii.ply").string(), folder.path("k.glb").string(), keep);
    EXPECT_EQ(kept->coordinate_offset[1], 0);
    EXPECT_NE(kept->warnings[0].find("--keep-coordinates"), std::string::npos);
    const std::string near = folder.write("near.ply", plySheet(3, 7, 0.7, "ascii"));
    EXPECT_TRUE(generate(near, folder.path("n.glb").string())->warnings.empty());
}

/// Returns a triangle without UVs as a COLLADA file.
std::string daeTriangle(const char* normals, const char* diffuse) {
    const auto source = [](const char* name, const char* values) {
        return "<source id='" + std::string(name) + "'><float_array id='" + name + "-a' count='9'>" + values +
               "</float_array><technique_common><accessor source='#" + name +
               "-a' count='3' stride='3'><param name='X' type='float'/><param name='Y' type='float'/>"
               "<param name='Z' type='float'/></accessor></technique_common></source>";
    };
    return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'>"
           "<library_images><image id='i'><init_from>a.png</init_from></image></library_images>"
           "<library_effects><effect id='e'><profile_COMMON><technique sid='c'><phong><diffuse>" +
           std::string(diffuse) +
           "</diffuse></phong></technique></profile_COMMON></effect></library_effects>"
           "<library_materials><material id='m'><instance_effect url='#e'/></material></library_materials>"
           "<library_geometries><geometry id='g'><mesh>" +
           source("p", "0 0 0 1 0 0 0 1 0") + source("n", normals) +
           "<vertices id='v'><input semantic='POSITION' source='#p'/></vertices><triangles count='1' material='s'>"
           "<input semantic='VERTEX' source='#v' offset='0'/><input semantic='NORMAL' source='#n' offset='0'/><p>0 1 "
           "2</p>"
           "</triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id='w'><node "
           "id='o'>"
           "<instance_geometry url='#g'><bind_material><technique_common><instance_material symbol='s' target='#m'/>"
           "</technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>"
           "<scene><instance_visual_scene url='#w'/></scene></COLLADA>";
}

TEST(Import, NormalsBecomeUnitAndColorsNumbers) {
    const TempFolder folder;
    const std::string path = folder.write("a.dae", daeTriangle("0 0 2 1 0 0 0 0 0", "<color>nan 2 -1 1</color>"));
    const Scene scene = sceneOf(path);
    EXPECT_EQ(std::vector<Vec3>(scene.primitives[0].normals.begin(), scene.primitives[0].normals.end()),
              (std::vector<Vec3>{{0, 0, 1}, {1, 0, 0}, {0, 0, 1}}));
    const gltf::Document document = readable([&] { return importDocument(path, kWithImporter); });
    EXPECT_EQ(document.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"], Json({1.0, 1.0, 0.0, 1.0}));
    EXPECT_EQ(document.warnings,
              (std::vector<std::string>{"1 normal is zero or not finite and was replaced by a face normal"}));
}

TEST(Import, MeshesWithoutUvsGetNoTextures) {
    const TempFolder folder;
    const std::string path =
        folder.write("a.dae", daeTriangle("0 0 1 0 0 1 0 0 1", "<texture texture='i' texcoord='x'/>"));
    const gltf::Document document = readable([&] { return importDocument(path, kWithImporter); });
    const Json& materials = document.json["materials"];
    EXPECT_TRUE(materials[0]["pbrMetallicRoughness"].contains("baseColorTexture"));
    const auto used = document.json["meshes"][0]["primitives"][0]["material"].get<std::size_t>();
    EXPECT_FALSE(materials[used]["pbrMetallicRoughness"].contains("baseColorTexture")) << materials.dump();
}

constexpr const char* kTriangle =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

/// Writes a LightWave scene that loads its meshes from other files.
std::string sceneOfFiles(const TempFolder& folder, std::initializer_list<const char*> names) {
    std::string text = "LWSC\n3\n\n";
    for (const char* name : names) text += "LoadObjectLayer 1 " + std::string(name) + "\nShowObject 6 8421504\n\n";
    return folder.write("scene/a.lws", text);
}

TEST(Import, ReadsOnlyReferencedFilesInTheModelsFolder) {
    const TempFolder folder;
    folder.write("scene/parts/inside.ply", kTriangle);
    folder.write("scene/more.ply", kTriangle);
    folder.write("outside.ply", kTriangle);
    std::filesystem::create_symlink(folder.path("outside.ply"), folder.path("scene/link.ply"));
    std::filesystem::create_symlink(folder.path("scene/more.ply"), folder.path("scene/link_inside.ply"));
    const std::string absolute = folder.path("outside.ply").string();
    FileOptions anywhere = kWithImporter;
    anywhere.allow_external = true;
    const auto primitives = [](const Result<Inspection>& result) { return result ? result->primitives.size() : 0; };
    for (const char* inside : {"more.ply", "parts/inside.ply", "link_inside.ply"}) {
        const Result<Inspection> result = inspectFile(sceneOfFiles(folder, {inside}), kWithImporter);
        EXPECT_EQ(primitives(result), 1U) << inside;
        EXPECT_TRUE(!result || result->warnings.empty()) << inside;
    }
    for (const char* outside : {"../outside.ply", "parts/../../outside.ply", "link.ply", absolute.c_str()}) {
        const std::string scene = sceneOfFiles(folder, {"more.ply", outside});
        const Result<Inspection> result = inspectFile(scene, kWithImporter);
        ASSERT_EQ(primitives(result), 1U) << outside;
        ASSERT_EQ(result->warnings.size(), 1U) << outside;
        EXPECT_NE(result->warnings[0].find("is outside the folder of the model"), std::string::npos);
        EXPECT_EQ(primitives(inspectFile(scene, anywhere)), 2U) << outside;
        const Result<Inspection> alone = inspectFile(sceneOfFiles(folder, {outside}), kWithImporter);
        ASSERT_FALSE(alone.ok()) << outside;
        EXPECT_NE(alone.error().message.find("is outside the folder of the model"), std::string::npos)
            << alone.error().message;
    }
}

TEST(Import, WithoutTheImporterTheErrorSaysWhatIsMissing) {
    const TempFolder folder;
    const Result<GenerateReport> report = generate(folder.write("a.fbx", "x"), folder.path("a.glb").string(), {});
    ASSERT_FALSE(report.ok());
    EXPECT_EQ(report.error().code, ErrorCode::unsupportedFile);
    EXPECT_NE(report.error().message.find("tspace-import"), std::string::npos);
}

TEST(Import, BrokenFilesAndAbsentFilesAreErrorsAndLeaveNothing) {
    const TempFolder folder;
    const std::string output = folder.path("out/a.glb").string();
    EXPECT_EQ(codeOf(generate(folder.write("a.fbx", "Kaydara FBX Binary  "), output)), ErrorCode::invalidFile);
    EXPECT_EQ(codeOf(generate(folder.write("a.ply", ""), output)), ErrorCode::invalidFile);
    EXPECT_EQ(codeOf(generate(folder.path("none.stl").string(), output)), ErrorCode::cannotRead);
    EXPECT_FALSE(folder.has("out"));
}

TEST(Import, ACrashOfTheImporterIsAnError) {
    const char* file = "bad/assimp-invalid/crash-30d6d0f7c529b3b66b4131700b7a4580cd7082df.ply";
    TSPACE_NEEDS_SHARED(file);
    const TempFolder folder;
    const Result<GenerateReport> report = generate(shared(file).string(), folder.path("a.glb").string());
    ASSERT_FALSE(report.ok());
    EXPECT_EQ(report.error().code, ErrorCode::invalidFile);
}

TEST(Import, MemoryAndSizeAreLimited) {
    const TempFolder folder;
    const std::string path = exported(folder, writeModel(folder, "sheet.glb", {bentSheet(200)}), "plyb", "ply");
    FileOptions small_file = kWithImporter, little_memory = kWithImporter;
    small_file.import_max_file_bytes = 1000;
    little_memory.import_max_memory_bytes = 24 << 20;
    EXPECT_EQ(codeOf(generate(path, folder.path("a.glb").string(), small_file)), ErrorCode::unsupportedFile);
#ifndef TSPACE_SANITIZED  // with sanitizers the importer has no such limit
    EXPECT_EQ(codeOf(generate(path, folder.path("a.glb").string(), little_memory)), ErrorCode::invalidFile);
#endif
    EXPECT_EQ(codeOf(generate(path, folder.path("a.glb").string())), ErrorCode::ok);
}

TEST(Import, AnImporterThatHangsIsStopped) {
    const TempFolder folder;
    const std::string hanging = folder.write("hang", "#!/bin/sh\nexec sleep 60\n");
    std::filesystem::permissions(hanging, std::filesystem::perms::owner_all);
    FileOptions file{.importer = hanging};
    file.import_max_seconds = 1;
    const Result<GenerateReport> report = generate(folder.write("a.ply", "ply"), folder.path("a.glb").string(), file);
    ASSERT_FALSE(report.ok());
    EXPECT_EQ(report.error().code, ErrorCode::invalidFile);
    EXPECT_NE(report.error().message.find("stopped after 1 s"), std::string::npos) << report.error().message;
}

}  // namespace
}  // namespace tspace::test
