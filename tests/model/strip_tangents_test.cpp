// SPDX-License-Identifier: MIT
// --strip: removes tangents that no material needs, with their data.
#include <gtest/gtest.h>

#include "generate_run.h"
#include "model/read/read_scene.h"

namespace tspace {
namespace {

using namespace test;

/// Returns the grid with tangents, and with a material that needs none.
GltfBuilder unneeded(const Grid& grid = Grid(4, false)) {
    GltfBuilder builder = gridModel(grid);
    std::vector<float> tangents;
    for (std::size_t v = 0; v < grid.vertexCount(); ++v) tangents.insert(tangents.end(), {0, 1, 0, 1});
    firstPrimitive(builder)["attributes"]["TANGENT"] = builder.addFloats(tangents, 4);
    firstPrimitive(builder)["material"] = 1;
    return builder;
}

TEST(StripTangents, RemovesThemWithTheirBytes) {
    const GenerateRun outcome = run(unneeded(), {.selection = {.strip = true}});
    const PrimitiveReport& report = outcome.report.primitives.at(0);
    EXPECT_EQ(report.action, PrimitiveAction::removed);
    EXPECT_EQ(report.reason, "nothing needs its tangents: no texture of its material needs tangents");
    EXPECT_FALSE(outcome.primitives[0].find("TANGENT").has_value());
    EXPECT_TRUE(outcome.primitives[0].find("NORMAL").has_value());
    const std::size_t before = outcome.before.buffers[0].bytes.size(), after = outcome.after.buffers[0].bytes.size();
    EXPECT_LE(after, before - 25 * 16 + 16) << "25 tangents of 16 bytes, and what alignment asks for";
    EXPECT_EQ(outcome.after.json["accessors"].size(), outcome.before.json["accessors"].size())
        << "entries are not removed, because others may count on their numbers";
}

TEST(StripTangents, RunsOnlyOnRequest) {
    const GenerateRun outcome = run(unneeded());
    EXPECT_EQ(outcome.report.primitives.at(0).action, PrimitiveAction::notNeeded);
    EXPECT_FALSE(outcome.report.changed);
}

TEST(StripTangents, KeepsThoseThatAMaterialOrAVariantNeeds) {
    const GenerateRun needed =
        run(withTangents(Grid(4, false)), {.selection = {.strip = true, .existing = ExistingTangents::replace}});
    EXPECT_EQ(needed.report.primitives.at(0).action, PrimitiveAction::replaced);

    GltfBuilder builder = unneeded();
    firstPrimitive(builder)["extensions"]["KHR_materials_variants"]["mappings"] =
        Json::parse(R"([{"material":0,"variants":[0]}])");
    const GenerateRun variant = run(builder, {.selection = {.strip = true, .existing = ExistingTangents::replace}});
    EXPECT_EQ(variant.report.primitives.at(0).action, PrimitiveAction::replaced);
    EXPECT_EQ(variant.report.primitives.at(0).reason,
              "a material variant needs tangents for normalTexture, and overwriting was requested");
}

TEST(StripTangents, KeepsSharedData) {
    GltfBuilder builder = unneeded();
    Json& primitives = builder.json()["meshes"][0]["primitives"];
    primitives.push_back(Json(primitives[0]));
    primitives[0]["material"] = 0;
    primitives[0].erase("indices");
    const TempFolder folder;
    const std::string input = folder.write("in.glb", builder.glb()), output = folder.path("out.glb").string();
    const auto report = generateFile(input, output, {.selection = {.strip = true}});
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->primitives[0].action, PrimitiveAction::kept);
    EXPECT_EQ(report->primitives[1].action, PrimitiveAction::removed);
    const auto before = gltf::loadDocument(input, {}), after = gltf::loadDocument(output, {});
    EXPECT_EQ(readTangents(before, readPrimitives(before)[0]), readTangents(after, readPrimitives(after)[0]));
    EXPECT_EQ(before.buffers[0].bytes.size(), after.buffers[0].bytes.size());
}

TEST(StripTangents, KeepsInterleavedNeighbors) {
    // POSITION and TANGENT in one view, 28 bytes apart.
    GltfBuilder builder;
    std::vector<float> mixed;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 7; ++k) mixed.push_back(static_cast<float>(i * 7 + k));
    }
    const std::size_t view = builder.addView(bytesOfValues(mixed));
    builder.json()["bufferViews"][view]["byteStride"] = 28;
    for (const auto& [offset, type] : {std::pair{0, "VEC3"}, std::pair{12, "VEC4"}}) {
        builder.json()["accessors"].push_back(
            {{"bufferView", view}, {"byteOffset", offset}, {"componentType", 5126}, {"count", 3}, {"type", type}});
    }
    builder.addPrimitive({{"POSITION", 0}, {"TANGENT", 1}});
    const GenerateRun outcome = run(builder, {.selection = {.strip = true}});
    EXPECT_EQ(outcome.report.primitives.at(0).action, PrimitiveAction::removed);
    EXPECT_EQ(readVec3(outcome.after, outcome.primitives[0], "POSITION")[2], (Vec3{14, 15, 16}));
}

TEST(StripTangents, RemovesThoseOfMorphTargetsToo) {
    GltfBuilder builder = unneeded();
    const std::size_t delta = builder.addFloats(std::vector<float>(25 * 3), 3);
    const std::size_t turn = builder.addFloats(std::vector<float>(25 * 3), 3);
    firstPrimitive(builder)["targets"] = Json::array({Json{{"POSITION", delta}, {"TANGENT", turn}}});
    const GenerateRun outcome = run(builder, {.selection = {.strip = true}});
    EXPECT_EQ(outcome.report.primitives.at(0).action, PrimitiveAction::removed);
    ASSERT_EQ(outcome.primitives[0].targets.size(), 1u);
    EXPECT_EQ(outcome.primitives[0].targets[0].size(), 1u);

    firstPrimitive(builder)["targets"].push_back(Json{{"TANGENT", turn}});
    const PrimitiveReport report = run(builder, {.selection = {.strip = true}}).report.primitives.at(0);
    EXPECT_EQ(report.action, PrimitiveAction::notNeeded) << "an empty target is not allowed";
    EXPECT_NE(report.reason.find("because a morph target has nothing but tangent deltas"), std::string::npos)
        << report.reason;
}

TEST(StripTangents, RemovesThemFromPointsAndFromSparseAccessors) {
    GltfBuilder builder = unneeded();
    firstPrimitive(builder)["mode"] = 0;
    Json& accessor = builder.json()["accessors"][4];
    builder.addView(bytesOfValues<std::uint16_t>({7}));
    builder.addView(bytesOfValues<float>({1, 0, 0, 1}));
    const std::size_t views = builder.json()["bufferViews"].size();
    accessor["sparse"] = {{"count", 1},
                          {"indices", {{"bufferView", views - 2}, {"componentType", kU16}}},
                          {"values", {{"bufferView", views - 1}}}};
    const GenerateRun outcome = run(builder, {.selection = {.strip = true}});
    EXPECT_EQ(outcome.report.primitives.at(0).action, PrimitiveAction::removed);
    EXPECT_FALSE(outcome.after.json["accessors"][4].contains("sparse"));
    EXPECT_LT(outcome.after.buffers[0].bytes.size(), outcome.before.buffers[0].bytes.size());
}

TEST(StripTangents, CanEmptyABufferThatHeldNothingElse) {
    GltfBuilder builder;
    builder.addFloats(std::vector<float>(12, 0.5f), 4);
    builder.json()["accessors"].push_back({{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
    builder.addPrimitive({{"POSITION", 1}, {"TANGENT", 0}});
    const GenerateRun outcome = run(builder, {.selection = {.strip = true}});
    EXPECT_GT(outcome.after.json["buffers"][0]["byteLength"], 0) << "glTF has no empty buffers";
    EXPECT_LT(outcome.after.json["buffers"][0]["byteLength"], 48);
}

TEST(StripTangents, NeedsNoBuffer) {
    for (const char* output : {"out.gltf", "out.glb"}) {
        GltfBuilder builder;
        builder.json().erase("buffers");
        builder.json().erase("bufferViews");
        builder.json()["accessors"] = Json::parse(R"([{"componentType":5126,"count":3,"type":"VEC3"},
                                                      {"componentType":5126,"count":3,"type":"VEC4"}])");
        builder.addPrimitive({{"POSITION", 0}, {"TANGENT", 1}});
        const TempFolder folder;
        const std::string input = folder.write("in.gltf", builder.gltfText());
        const auto report = generateFile(input, folder.path(output).string(), {.selection = {.strip = true}});
        ASSERT_TRUE(report) << report.error().message << " at " << report.error().place;
        EXPECT_EQ(report->primitives.at(0).action, PrimitiveAction::removed);
        const gltf::Document written = gltf::loadDocument(folder.path(output).string(), {});
        EXPECT_FALSE(written.json.contains("buffers") && written.json["buffers"].is_null());
    }
}

TEST(StripTangents, ConflictsWithAll) {
    const TempFolder folder;
    const std::string input = folder.write("in.glb", unneeded().glb());
    const auto report =
        generateFile(input, folder.path("out.glb").string(), {.selection = {.all = true, .strip = true}});
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::invalidOption);
    EXPECT_EQ(folder.entryCount(), 1u);
}

}  // namespace
}  // namespace tspace
