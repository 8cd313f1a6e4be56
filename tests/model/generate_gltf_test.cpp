// SPDX-License-Identifier: MIT
// generateFile on small generated documents: sharing, splitting, wider indices, replacement in place, rejected input,
// and reports.
#include <gtest/gtest.h>

#include <algorithm>

#include "generate_run.h"
#include "model/gltf/accessor.h"
#include "model/gltf/container.h"
#include "model/gltf/primitive_reader.h"
#include "model/read/read_scene.h"
#include "tspace/inspect.h"

namespace tspace {
namespace {

using gltf::Document;
using gltf::Json;
using gltf::Primitive;
using namespace test;

TEST(GenerateGltf, AddsOnlyTangentsWhereNothingIsSplit) {
    const GenerateRun outcome = run(gridModel(Grid(4, false)));
    EXPECT_EQ(outcome.report.primitives.at(0).action, PrimitiveAction::generated);
    EXPECT_EQ(outcome.after.json["accessors"].size(), 5u);
    EXPECT_EQ(outcome.after.json["bufferViews"].size(), 5u);
    EXPECT_EQ(outcome.after.json["bufferViews"][4]["target"], 34962);
    EXPECT_EQ(outcome.after.json["meshes"][0]["primitives"][0]["indices"], 3);
    // u increases along x. v points down in glTF, so B = w cross(N, T) points against increasing v, and w is +1.
    for (const Vec4& tangent : readTangents(outcome.after, outcome.primitives[0]))
        EXPECT_EQ(tangent, (Vec4{1, 0, 0, 1}));
}

TEST(GenerateGltf, SplitsAndCarriesEveryAttributeAlong) {
    const Grid grid(4);
    GltfBuilder builder = gridModel(grid);
    const std::size_t count = grid.vertexCount();
    std::vector<std::uint8_t> joints(count * 4), ids(count * 4);
    for (std::size_t i = 0; i < joints.size(); ++i) joints[i] = ids[i] = static_cast<std::uint8_t>(i);
    const std::size_t joint = builder.addAccessor(joints, kU8, "VEC4", count);
    const std::size_t weight = builder.addFloats(std::vector<float>(count * 4, 0.25f), 4);
    // A custom attribute whose elements are three bytes with a stride of four.
    const std::size_t custom = builder.addAccessor(ids, kU8, "VEC3", count);
    builder.json()["bufferViews"].back()["byteStride"] = 4;
    builder.json()["accessors"].back()["normalized"] = true;
    // Deltas of a morph target in an accessor that is sparse and has no buffer view.
    builder.addView(test::bytesOfValues<std::uint16_t>({7, 12}));
    builder.addView(test::bytesOfValues<float>({1, 2, 3, 4, 5, 6}));
    const std::size_t views = builder.json()["bufferViews"].size();
    builder.json()["accessors"].push_back({{"componentType", 5126}, {"count", count}, {"type", "VEC3"}});
    builder.json()["accessors"].back()["sparse"] = {{"count", 2},
                                                    {"indices", {{"bufferView", views - 2}, {"componentType", kU16}}},
                                                    {"values", {{"bufferView", views - 1}}}};
    Json& primitive = builder.json()["meshes"][0]["primitives"][0];
    primitive["attributes"]["JOINTS_0"] = joint;
    primitive["attributes"]["WEIGHTS_0"] = weight;
    primitive["attributes"]["_CUSTOM"] = custom;
    primitive["targets"] = Json::array({Json{{"POSITION", custom + 1}}, Json{{"POSITION", 0}}});
    const GenerateRun outcome = run(builder);
    const PrimitiveReport& report = outcome.report.primitives.at(0);
    EXPECT_EQ(report.vertices_before, 25u);
    EXPECT_EQ(report.vertices_after, 30u) << "the middle column of 5 vertices is doubled";
    // POSITION is also a morph attribute. Both still refer to one accessor.
    EXPECT_EQ(outcome.primitives[0].find("POSITION"), outcome.primitives[0].targets[1][0].second);
    EXPECT_EQ(outcome.after.json["accessors"].size(), outcome.before.json["accessors"].size() + 3)
        << "tangents and deltas of two targets; other entries are re-used";
}

TEST(GenerateGltf, KeepsVertexAttributesAlignedTo4Bytes) {
    GltfBuilder builder = gridModel(Grid(4));
    const std::size_t color = builder.addAccessor(Bytes(25 * 4, 0), kU8, "VEC3", 25);
    builder.json()["bufferViews"].back()["byteStride"] = 4;
    builder.json()["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = color;
    const GenerateRun outcome = run(builder);
    const auto accessor = readAccessor(outcome.after, *outcome.primitives[0].find("COLOR_0"));
    EXPECT_EQ(accessor.stride, 4u);
    EXPECT_EQ(accessor.element_bytes, 3u);
}

TEST(GenerateGltf, WidensIndicesOnlyWhenTheyNoLongerFit) {
    const auto indexType = [](const Grid& grid, int type) {
        const GenerateRun outcome = run(gridModel(grid, type));
        EXPECT_GT(outcome.report.primitives.at(0).vertices_after, grid.vertexCount());
        return static_cast<int>(readAccessor(outcome.after, *outcome.primitives[0].indices).component);
    };
    EXPECT_EQ(indexType(Grid(4), kU8), kU8);
    EXPECT_EQ(indexType(Grid(14), kU8), kU8) << "225 + 15 vertices";
    EXPECT_EQ(indexType(Grid(15), kU8), kU16) << "256 vertices already, and more";
    EXPECT_EQ(indexType(Grid(4), kU16), kU16);
    EXPECT_EQ(indexType(Grid(254), kU16), kU16) << "65025 + 255 = 65280 vertices";
    EXPECT_EQ(indexType(Grid(255), kU16), kU32) << "65536 + 256 vertices";
    EXPECT_EQ(indexType(Grid(4), kU32), kU32);
}

TEST(GenerateGltf, ComputesPrimitivesOfOnePoolTogether) {
    GltfBuilder builder = gridModel(Grid(4));
    Json& primitives = builder.json()["meshes"][0]["primitives"];
    for (int i = 0; i < 2; ++i) primitives.push_back(Json(primitives[0]));
    primitives[2]["material"] = 1;
    const GenerateRun outcome = run(builder);
    EXPECT_EQ(outcome.report.primitives.at(1).action, PrimitiveAction::generated);
    EXPECT_EQ(outcome.report.primitives.at(2).action, PrimitiveAction::notNeeded);
    const Json& after = outcome.after.json["meshes"][0]["primitives"];
    EXPECT_EQ(after[0], after[1]) << "both still share everything";
    EXPECT_EQ(after[2]["attributes"], primitives[2]["attributes"])
        << "a primitive that is left alone keeps the old vertices";
    EXPECT_NE(after[0]["attributes"]["POSITION"], after[2]["attributes"]["POSITION"]);
}

TEST(GenerateGltf, TurnsSplitStripsAndFansIntoTriangles) {
    // A ribbon of 4 quads, mirrored at its middle, as a strip without indices.
    GltfBuilder builder;
    std::vector<float> positions, normals, uvs;
    for (int x = 0; x <= 4; ++x) {
        for (int y = 0; y < 2; ++y) {
            positions.insert(positions.end(), {static_cast<float>(x), static_cast<float>(1 - y), 0});
            normals.insert(normals.end(), {0, 0, 1});
            uvs.insert(uvs.end(), {static_cast<float>(x > 2 ? 4 - x : x), static_cast<float>(y)});
        }
    }
    builder.addFloats(positions, 3);
    builder.addFloats(normals, 3);
    builder.addFloats(uvs, 2);
    builder.addPrimitive({{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}})["mode"] = 5;
    const GenerateRun outcome = run(builder, {.selection = {.all = true}});
    EXPECT_EQ(outcome.report.primitives.at(0).vertices_after, 12u);
    EXPECT_EQ(outcome.primitives[0].mode, gltf::Mode::triangles);
    EXPECT_EQ(outcome.primitives[0].corner_count, 24u);
}

TEST(GenerateGltf, LeavesPlainTrianglesWithoutIndices) {
    const Grid grid(2);
    GltfBuilder builder;
    std::vector<float> positions, uvs;
    for (const std::uint32_t i : grid.indices<std::uint32_t>()) {
        positions.insert(positions.end(), grid.positions.begin() + i * 3, grid.positions.begin() + i * 3 + 3);
        uvs.insert(uvs.end(), grid.uvs.begin() + i * 2, grid.uvs.begin() + i * 2 + 2);
    }
    builder.addFloats(positions, 3);
    builder.addFloats(uvs, 2);
    builder.addPrimitive({{"POSITION", 0}, {"TEXCOORD_0", 1}});
    const GenerateRun outcome = run(builder, {.selection = {.all = true}});
    EXPECT_TRUE(outcome.report.primitives.at(0).normals_generated);
    EXPECT_FALSE(outcome.primitives[0].indices.has_value());
    for (const Vec3& normal : readVec3(outcome.after, outcome.primitives[0], "NORMAL"))
        EXPECT_EQ(normal, (Vec3{0, 0, 1}));
}

/// gridModel with wrong float tangents that nothing else uses.
TEST(GenerateGltf, KeepsTangentsWithoutOverwrite) {
    const GltfBuilder builder = withTangents(Grid(4, false));
    const TempFolder folder;
    const std::string input = folder.write("in.glb", builder.glb()), output = folder.path("out.glb").string();
    const auto report = generateFile(input, output);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->primitives.at(0).action, PrimitiveAction::kept);
    EXPECT_FALSE(report->changed);
    EXPECT_EQ(readFile(output), readFile(input));
}

TEST(GenerateGltf, OverwritesTangentsInPlace) {
    const GenerateRun outcome =
        run(withTangents(Grid(4, false)), {.selection = {.existing = ExistingTangents::replace}});
    EXPECT_EQ(outcome.report.primitives.at(0).action, PrimitiveAction::replaced);
    EXPECT_EQ(outcome.after.json["bufferViews"], outcome.before.json["bufferViews"]);
    EXPECT_EQ(outcome.after.buffers[0].bytes.size(), outcome.before.buffers[0].bytes.size());
    EXPECT_EQ(outcome.after.json["accessors"][4]["max"], Json::array({1.0, 0.0, 0.0, 1.0})) << "bounds follow";
}

TEST(GenerateGltf, KeepsTangentsForOtherUsers) {
    GltfBuilder builder = withTangents(Grid(4, false));
    builder.json()["meshes"][0]["primitives"][0]["attributes"]["_COPY"] = 4;
    const GenerateRun outcome = run(builder, {.selection = {.existing = ExistingTangents::replace}});
    EXPECT_NE(outcome.primitives[0].find("TANGENT"), outcome.primitives[0].find("_COPY"));
}

TEST(GenerateGltf, LeavesNoOldBytesBehindWhenASplitReplacesThem) {
    const GenerateRun outcome = run(withTangents(Grid(16)), {.selection = {.existing = ExistingTangents::replace}});
    const std::size_t vertices = outcome.report.primitives.at(0).vertices_after;
    EXPECT_GT(vertices, outcome.report.primitives.at(0).vertices_before);
    const std::size_t needed = vertices * (12 + 12 + 8 + 16) + outcome.primitives[0].corner_count * 2;
    // Only multiples of 8 bytes are cut, so a few bytes may remain at each of the five accessors.
    EXPECT_LT(outcome.after.buffers[0].bytes.size(), needed + 5 * 16);
}

TEST(GenerateGltf, TreatsTangentsWithoutNormalsAsMissing) {
    GltfBuilder builder = withTangents(Grid(4, false));
    builder.json()["meshes"][0]["primitives"][0]["attributes"].erase("NORMAL");
    const GenerateRun outcome = run(builder);
    EXPECT_EQ(outcome.report.primitives.at(0).action, PrimitiveAction::generated);
    EXPECT_TRUE(outcome.report.primitives.at(0).normals_generated);
    EXPECT_EQ(outcome.report.primitives.at(0).notes,
              std::vector<std::string>{"its existing tangents were ignored, because it had no normals"});
    EXPECT_EQ(readTangents(outcome.after, outcome.primitives[0])[0], (Vec4{1, 0, 0, 1}));
}

TEST(GenerateGltf, ExplainsWhyAPrimitiveIsUnchanged) {
    GltfBuilder builder = gridModel(Grid(4, false));
    std::vector<float> tangents;
    for (std::size_t v = 0; v < 25; ++v) tangents.insert(tangents.end(), {0, 1, 0, 1});
    firstPrimitive(builder)["attributes"]["TANGENT"] = builder.addFloats(tangents, 4);
    Json& primitives = builder.json()["meshes"][0]["primitives"];
    const Json model = primitives[0];
    const auto add = [&](const char* key, const Json& value) {
        primitives.push_back(model);
        primitives.back()[key] = value;
    };
    builder.json()["materials"].push_back(Json::parse(R"({"normalTexture":{"index":0,"texCoord":1}})"));
    add("material", 1);
    add("mode", 1);
    add("mode", 0);
    add("material", 2);
    const GenerateRun outcome = run(builder, {.selection = {.existing = ExistingTangents::replace}});
    const std::vector<PrimitiveReport>& reports = outcome.report.primitives;
    ASSERT_EQ(reports.size(), 5u);
    EXPECT_EQ(reports[1].action, PrimitiveAction::notNeeded);
    EXPECT_EQ(reports[1].material_name, "plain");
    EXPECT_EQ(reports[2].action, PrimitiveAction::notTriangles);
    EXPECT_EQ(reports[3].action, PrimitiveAction::notTriangles);
    EXPECT_EQ(reports[4].action, PrimitiveAction::impossible);
    EXPECT_NE(reports[4].reason.find("TEXCOORD_1"), std::string::npos);
    EXPECT_EQ(outcome.primitives[4].find("TANGENT"), 4u) << "its own tangents are kept";
}

TEST(GenerateGltf, KeepsChunksExtensionsAndUnknownMembers) {
    GltfBuilder builder = gridModel(Grid(4));
    builder.json()["VENDOR_top"] = {{"z", 1}, {"a", {1.0, -0.0, 0.10000000149011612}}};
    builder.json()["extensionsUsed"] = {"VENDOR_thing"};
    builder.json()["extensionsRequired"] = {"VENDOR_thing"};
    builder.json()["accessors"][0]["name"] = "positions";
    builder.json()["accessors"][0]["extras"] = {{"k", "v"}};
    builder.json()["meshes"][0]["primitives"][0]["extensions"] = {{"VENDOR_thing", {{"deep", {1, 2}}}}};
    builder.json()["meshes"][0]["extras"] = {{"targetNames", {"a"}}};
    const GenerateRun outcome = run(builder, {}, {{0x31415926, {1, 2, 3, 4, 5, 6, 7, 8}}});
    ASSERT_EQ(outcome.report.warnings.size(), 2u);
    EXPECT_NE(outcome.report.warnings[1].find("VENDOR_thing"), std::string::npos) << "vertices were split";
    ASSERT_EQ(outcome.after.extra_chunks.size(), 1u);
    EXPECT_EQ(outcome.after.extra_chunks[0].type, 0x31415926u);
}

TEST(GenerateGltf, ReportsProgressUpToTheEnd) {
    const TempFolder folder;
    const std::string input = folder.write("in.glb", gridModel(Grid(4)).glb());
    std::vector<std::string> steps;
    std::uint64_t last_done = 0, last_total = 1;
    GenerateOptions options;
    options.progress = [&](const char* what, std::uint64_t done, std::uint64_t total) {
        EXPECT_LE(done, total);
        if (steps.empty() || steps.back() != what) steps.emplace_back(what);
        last_done = done;
        last_total = total;
    };
    ASSERT_TRUE(generateFile(input, folder.path("out.glb").string(), options));
    EXPECT_EQ(steps, (std::vector<std::string>{"reading", "computing tangents", "writing"}));
    EXPECT_EQ(last_done, last_total);
}

TEST(GenerateGltf, LeavesDataUrisDataUris) {
    const TempFolder folder;
    const std::string input = folder.write("in.gltf", gridModel(Grid(4)).gltfText(1)),
                      output = folder.path("out.gltf").string();
    const auto report = generateFile(input, output);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->output_files, (std::vector<std::string>{output}));
    const Document after = gltf::loadDocument(output, {});
    EXPECT_EQ(after.buffers.size(), 1u);
    EXPECT_EQ(after.style.indent, 1);
}

/// Writes the grid as a .gltf file, with its buffer and an image in separate files.
void writeWithFiles(const TempFolder& folder, const std::string& name, GltfBuilder builder,
                    const char* image_uri = "tex/image.png") {
    folder.write("in/geo metry.bin", builder.bytes());
    folder.write("in/tex/image.png", std::string("\x89PNG\r\n\x1a\nrest"));
    builder.json()["buffers"] = Json::array({Json{{"byteLength", builder.bytes().size()}, {"uri", "geo%20metry.bin"}}});
    builder.json()["images"] = Json::array({Json{{"uri", image_uri}, {"name", "i"}}});
    folder.write("in/" + name, builder.json().dump(2));
}

TEST(GenerateGltf, NeverChangesBufferFilesOfTheInput) {
    const TempFolder folder;
    writeWithFiles(folder, "a.gltf", withTangents(Grid(4, false)));
    const Bytes model = readFile(folder.path("in/a.gltf")), buffer = readFile(folder.path("in/geo metry.bin"));
    const std::string input = folder.path("in/a.gltf").string();
    const auto same_folder =
        generateFile(input, folder.path("in/b.gltf").string(), {.selection = {.existing = ExistingTangents::replace}});
    ASSERT_TRUE(same_folder) << same_folder.error().message;
    EXPECT_EQ(same_folder->output_files.size(), 2u);
    EXPECT_TRUE(std::filesystem::exists(folder.path("in/b.tspace.bin")));
    const auto in_place = generateFile(input, input, {.selection = {.existing = ExistingTangents::replace}});
    ASSERT_TRUE(in_place);
    EXPECT_TRUE(std::filesystem::exists(folder.path("in/a.tspace.bin")));
    EXPECT_EQ(readFile(folder.path("in/geo metry.bin")), buffer);
    EXPECT_NE(readFile(folder.path("in/a.gltf")), model);
    // A run with a different method replaces the tangents in the file that the first run wrote.
    const std::size_t own_bytes = readFile(folder.path("in/a.tspace.bin")).size();
    GenerateOptions other{.selection = {.existing = ExistingTangents::replace}};
    other.tangents.compute.convention = conventions::opengl;
    const auto third = generateFile(input, input, other);
    ASSERT_TRUE(third);
    EXPECT_TRUE(third->changed);
    EXPECT_EQ(readFile(folder.path("in/a.tspace.bin")).size(), own_bytes);
}

TEST(GenerateGltf, CopiesNamedFilesButOverwritesNoOther) {
    const TempFolder folder;
    writeWithFiles(folder, "a.gltf", gridModel(Grid(4)));
    const std::string input = folder.path("in/a.gltf").string(), output = folder.path("out/a.gltf").string();
    const auto report = generateFile(input, output);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->output_files.size(), 4u);
    EXPECT_EQ(report->output_files[0], output);
    EXPECT_EQ(readFile(folder.path("out/geo metry.bin")), readFile(folder.path("in/geo metry.bin")));
    EXPECT_TRUE(std::filesystem::exists(folder.path("out/tex/image.png")));
    EXPECT_TRUE(generateFile(input, output)) << "the same files again are no conflict";
    folder.write("out/tex/image.png", std::string("somebody else's"));
    const std::size_t files = folder.entryCount();
    const Bytes model = readFile(output);
    const auto refused = generateFile(input, output, {.selection = {.existing = ExistingTangents::replace}});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::cannotWrite);
    EXPECT_EQ(folder.entryCount(), files);
    EXPECT_EQ(readFile(output), model);
}

TEST(GenerateGltf, IsCancelledByItsProgressAndLeavesNothing) {
    const TempFolder folder;
    writeWithFiles(folder, "a.gltf", gridModel(Grid(4)));
    const std::size_t files = folder.entryCount();
    int calls_left = 0;
    GenerateOptions options{.selection = {.all = true}};
    options.progress = [&](const char*, std::uint64_t, std::uint64_t) {
        if (calls_left-- == 0) throw Cancelled{};
    };
    for (int calls = 0; calls < 3; ++calls) {
        calls_left = calls;
        const auto report = generateFile(folder.path("in/a.gltf").string(), folder.path("out/a.glb").string(), options);
        ASSERT_FALSE(report) << calls;
        EXPECT_EQ(report.error().code, ErrorCode::cancelled);
        EXPECT_EQ(folder.entryCount(), files);
    }
}

TEST(GenerateGltf, FindsFilesThatAreNamedWithWindowsSeparators) {
    const TempFolder folder;
    writeWithFiles(folder, "b.gltf", gridModel(Grid(4)), "tex\\image.png");
    const std::string input = folder.path("in/b.gltf").string(), output = folder.path("out/b.gltf").string();
    ASSERT_TRUE(generateFile(input, output));
    EXPECT_TRUE(std::filesystem::exists(folder.path("out/tex/image.png")));
    EXPECT_EQ(gltf::loadDocument(output, {}).json["images"][0]["uri"], "tex\\image.png");
    ASSERT_TRUE(generateFile(input, folder.path("out/b.glb").string()));
    EXPECT_EQ(gltf::loadDocument(folder.path("out/b.glb").string(), {}).json["images"][0]["mimeType"], "image/png");
}

TEST(GenerateGltf, MakesASelfContainedGlb) {
    const TempFolder folder;
    writeWithFiles(folder, "a.gltf", gridModel(Grid(4)));
    const std::string output = folder.path("out/a.glb").string();
    const auto report = generateFile(folder.path("in/a.gltf").string(), output);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->output_files, (std::vector<std::string>{output}));
    const Document after = gltf::loadDocument(output, {});
    EXPECT_EQ(after.json["images"][0]["mimeType"], "image/png");
    EXPECT_FALSE(after.json["images"][0].contains("uri"));
    EXPECT_EQ(after.buffers.size(), 1u);
    for (const std::string& difference :
         test::differences(gltf::loadDocument(folder.path("in/a.gltf"), {}), after, *report)) {
        ADD_FAILURE() << difference;
    }
}

TEST(GenerateGltf, KeepsTheUriOfAMissingImageAndWarns) {
    const TempFolder folder;
    writeWithFiles(folder, "a.gltf", gridModel(Grid(4)));
    std::filesystem::remove(folder.path("in/tex/image.png"));
    for (const char* name : {"out/a.glb", "out/a.gltf"}) {
        const auto report = generateFile(folder.path("in/a.gltf").string(), folder.path(name).string());
        ASSERT_TRUE(report);
        EXPECT_EQ(report->warnings.size(), 1u);
        EXPECT_EQ(gltf::loadDocument(folder.path(name), {}).json["images"][0]["uri"], "tex/image.png");
    }
}

/// Some exporters write the path of a folder for a texture that was never saved.
TEST(GenerateGltf, TreatsAFolderInsteadOfAnImageAsMissing) {
    const TempFolder folder;
    writeWithFiles(folder, "a.gltf", gridModel(Grid(4)), "tex/.");
    for (const char* name : {"out/a.glb", "out/a.gltf"}) {
        const auto report = generateFile(folder.path("in/a.gltf").string(), folder.path(name).string());
        ASSERT_TRUE(report) << report.error().message;
        ASSERT_EQ(report->warnings.size(), 1u);
        EXPECT_NE(report->warnings[0].find("is a folder"), std::string::npos) << report->warnings[0];
        EXPECT_EQ(gltf::loadDocument(folder.path(name), {}).json["images"][0]["uri"], "tex/.");
    }
}

TEST(GenerateGltf, RejectsOtherOutputs) {
    const TempFolder folder;
    const std::string input = folder.write("in.glb", gridModel(Grid(4)).glb());
    const auto obj = generateFile(input, folder.path("out.obj").string());
    ASSERT_FALSE(obj);
    EXPECT_EQ(obj.error().code, ErrorCode::invalidOption);
    EXPECT_EQ(folder.entryCount(), 1u);
}

TEST(GenerateGltf, SucceedsOrFailsCleanlyForAnyChangedByte) {
    const TempFolder folder;
    const Bytes sound = withTangents(Grid(2)).glb();
    const std::string input = folder.path("in.glb").string(), output = folder.path("out.glb").string();
    constexpr std::uint8_t kValues[] = {0x00, 0x39, 0xff, 0x22};
    for (std::size_t i = 12; i < sound.size(); ++i) {
        Bytes changed = sound;
        changed[i] = kValues[i % 4];
        folder.write("in.glb", changed);
        const auto report =
            generateFile(input, output, {.selection = {.all = true, .existing = ExistingTangents::replace}});
        if (report) continue;
        EXPECT_NE(report.error().code, ErrorCode::internal) << i << ": " << report.error().message;
        EXPECT_NE(report.error().code, ErrorCode::outOfMemory) << i << ": " << report.error().message;
    }
}

TEST(GenerateGltf, NamesTheLocationOfAnInvalidIndex) {
    const TempFolder folder;
    GltfBuilder builder = gridModel(Grid(4));
    builder.bytes()[builder.json()["bufferViews"][3]["byteOffset"].get<std::size_t>()] = 0xff;
    const auto report = generateFile(folder.write("in.glb", builder.glb()), folder.path("out.glb").string());
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::invalidFile);
    EXPECT_EQ(report.error().place, "/meshes/0/primitives/0/indices");
    EXPECT_EQ(folder.entryCount(), 1u);
}

TEST(GenerateGltf, DropsBytesAfterTheGlbOnlyWhenItRewritesTheFile) {
    const auto longer = [](Bytes file) {
        file.insert(file.end(), {1, 2, 3});
        return file;
    };
    const TempFolder folder;
    const std::string input = folder.write("in.glb", longer(gridModel(Grid(4)).glb()));
    const std::string output = folder.path("out.glb").string();
    const auto anew = generateFile(input, output);
    ASSERT_TRUE(anew) << anew.error().message;
    EXPECT_TRUE(anew->changed);
    EXPECT_EQ(anew->warnings.size(), 1u);
    EXPECT_EQ(gltf::readGlb(readFile(output)).ignored_bytes, 0u);

    const std::string finished = folder.write("finished.glb", longer(readFile(output)));
    const auto unchanged = generateFile(finished, output);
    ASSERT_TRUE(unchanged) << unchanged.error().message;
    EXPECT_FALSE(unchanged->changed);
    EXPECT_EQ(unchanged->warnings.size(), 1u);
    EXPECT_EQ(readFile(output), readFile(finished)) << "byte for byte";
}

TEST(GenerateGltf, CarriesMatricesWithoutPaddingAtTheEndThroughASplit) {
    const Grid grid(4);
    GltfBuilder builder = gridModel(grid);
    Bytes matrices(grid.vertexCount() * 8 - 2, 0);
    for (std::size_t i = 0; i < matrices.size(); ++i) {
        if (i % 4 < 2) matrices[i] = static_cast<std::uint8_t>(i % 8);
    }
    const std::size_t accessor = builder.addAccessor(matrices, 5121, "MAT2", grid.vertexCount());
    builder.json()["meshes"][0]["primitives"][0]["attributes"]["_MATRIX"] = accessor;
    const GenerateRun outcome = run(builder);
    EXPECT_GT(outcome.report.primitives.at(0).vertices_after, grid.vertexCount());
}

TEST(GenerateGltf, ConvertsAModelWithoutAnyData) {
    const TempFolder folder;
    const std::string input =
        folder.write("in.gltf", std::string(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":12}],
            "bufferViews":[{"buffer":0,"byteLength":12}]})"));
    const std::string output = folder.path("out.glb").string();
    ASSERT_TRUE(generateFile(input, output));
    const Document after = gltf::loadDocument(output, {});
    EXPECT_GT(after.json["buffers"][0]["byteLength"], 0) << "glTF has no empty buffers";
    EXPECT_EQ(after.json["buffers"][1], Json({{"byteLength", 12}}));
    EXPECT_EQ(after.json["bufferViews"][0]["buffer"], 1);
}

TEST(GenerateGltf, RejectsUvSetsThatNoReportCanName) {
    const TempFolder folder;
    GltfBuilder builder = gridModel(Grid(4));
    builder.json()["materials"][0]["normalTexture"]["texCoord"] = 4294967295u;
    builder.json()["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_4294967295"] = 2;
    const auto report = generateFile(folder.write("in.glb", builder.glb()), folder.path("out.glb").string());
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().place, "/materials/0/normalTexture/texCoord");
}

TEST(GenerateGltf, RejectsThousandsOfAttributes) {
    const TempFolder folder;
    GltfBuilder builder = gridModel(Grid(4));
    Json& attributes = builder.json()["meshes"][0]["primitives"][0]["attributes"];
    for (int i = 1; i < 2000; ++i) attributes["TEXCOORD_" + std::to_string(i)] = 2;
    const auto report = inspectFile(folder.write("in.glb", builder.glb()));
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::unsupportedFile);
}

TEST(GenerateGltf, VerticesWithoutDataCostNoMemory) {
    const TempFolder folder;
    const std::string input = folder.write("in.gltf", std::string(R"({"asset":{"version":"2.0"},
            "accessors":[{"componentType":5126,"type":"VEC3","count":2147483647}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]})"));
    const auto inspection = inspectFile(input);
    ASSERT_FALSE(inspection);
    EXPECT_EQ(inspection.error().code, ErrorCode::tooLarge);
    const auto report = generateFile(input, folder.path("out.glb").string(),
                                     {.selection = {.all = true, .existing = ExistingTangents::replace}});
    EXPECT_TRUE(report) << "it has no UVs, so nothing is read";
}

/// Returns a grid of 5 x 5 vertices whose signs are inverted. `flat_rows`: number of rows of triangles without UV area,
/// whose signs are 1.
GltfBuilder invertedGrid(std::size_t flat_rows) {
    Grid grid(4, false);
    if (flat_rows != 0) std::fill_n(grid.uvs.begin(), 10 * (flat_rows + 1), 0.5f);
    GltfBuilder builder = gridModel(grid);
    std::vector<float> tangents;
    for (std::size_t v = 0; v < 25; ++v) tangents.insert(tangents.end(), {1, 0, 0, v < 5 * flat_rows ? 1.0f : -1.0f});
    firstPrimitive(builder)["attributes"]["TANGENT"] = builder.addFloats(tangents, 4);
    return builder;
}

/// Inverted signs are kept, because the normal map may have been made for them. Vertices whose UVs determine no sign do
/// not matter.
TEST(GenerateGltf, KeepsInvertedSignsWhenNormalsAreRecomputed) {
    for (const std::size_t flat_rows : {0, 2}) {
        for (const ExistingTangents existing : {ExistingTangents::keep, ExistingTangents::replace}) {
            GenerateOptions options{.selection = {.existing = existing}};
            options.normals.overwrite = true;
            const TempFolder folder;
            const std::string output = folder.path("out.glb").string();
            const auto report = generateFile(folder.write("in.glb", invertedGrid(flat_rows).glb()), output, options);
            ASSERT_TRUE(report);
            const bool stays = existing == ExistingTangents::keep;
            const Document after = gltf::loadDocument(output, {});
            const std::vector<Vec4> tangents = readTangents(after, readPrimitives(after)[0]);
            EXPECT_EQ(tangents.back().w, stays ? -1.0f : 1.0f) << flat_rows;
            EXPECT_TRUE(flat_rows != 0 || std::all_of(tangents.begin(), tangents.end(), [&](const Vec4& tangent) {
                            return tangent.w == tangents.back().w;
                        }));
            const std::vector<std::string>& notes = report->primitives[0].notes;
            const bool is_noted = std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
                return note.starts_with("most tangent signs of the file were inverted, so all new signs were");
            });
            EXPECT_EQ(is_noted, stays) << flat_rows;
        }
    }
}

/// Returns a grid on a slope, five million units from the origin, where the spacing of floats is half a unit.
GltfBuilder farGrid(bool has_normals) {
    Grid grid(8, false);
    for (std::size_t i = 0; i < grid.positions.size(); ++i)
        grid.positions[i] = 5e6f + 1.3f * grid.positions[i] + 0.4f * grid.positions[i / 3 * 3];
    GltfBuilder builder;
    Json attributes = {{"POSITION", builder.addFloats(grid.positions, 3)},
                       {"TEXCOORD_0", builder.addFloats(grid.uvs, 2)}};
    if (has_normals) attributes["NORMAL"] = builder.addFloats(grid.normals, 3);
    const std::vector<std::uint32_t> indices = grid.indices<std::uint32_t>();
    const std::size_t accessor = builder.addAccessor(indices, kU32, "SCALAR", indices.size());
    builder.addPrimitive(attributes)["indices"] = accessor;
    return builder;
}

TEST(GenerateGltf, WarnsOfTangentsComputedFromRoundedPositions) {
    const auto warningOf = [](bool has_normals, const GenerateOptions& options) {
        const TempFolder folder;
        const std::string input = folder.write("in.glb", farGrid(has_normals).glb());
        const auto report = generateFile(input, folder.path("out.glb").string(), options);
        return report && !report->warnings.empty() ? report->warnings[0] : std::string();
    };
    const auto says = [](const std::string& warning, const std::string& made) {
        return warning.find("primitives/0: " + made + " were computed from positions that are rounded") !=
               std::string::npos;
    };
    EXPECT_TRUE(says(warningOf(true, {.selection = {.all = true}}), "tangents"));
    EXPECT_TRUE(says(warningOf(false, {.selection = {.all = true}}), "normals and tangents"));
    GenerateOptions options;
    options.normals.overwrite = true;
    EXPECT_TRUE(says(warningOf(true, options), "normals")) << "nothing needs tangents";
}

}  // namespace
}  // namespace tspace
