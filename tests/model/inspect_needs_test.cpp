// SPDX-License-Identifier: MIT
// Needs that inspect reports: every use of tangents, transforms, variants, and how often a mesh is drawn.
#include <gtest/gtest.h>

#include <cmath>

#include "generate_run.h"
#include "tspace/inspect.h"

namespace tspace {
namespace {

using namespace test;

Inspection inspect(const GltfBuilder& builder) {
    const TempFolder folder;
    const auto result = inspectFile(folder.write("in.glb", builder.glb()));
    EXPECT_TRUE(result) << result.error().message;
    return result ? *result : Inspection{};
}

TEST(InspectNeeds, ListsEveryUseWithItsTransform) {
    GltfBuilder builder = gridModel(Grid(2));
    builder.json()["materials"][0] = Json::parse(R"({
        "normalTexture":{"index":0,"extensions":{"KHR_texture_transform":{"rotation":0.5,"scale":[2,-2],"offset":[1,0]}}},
        "extensions":{"KHR_materials_anisotropy":{"anisotropyTexture":{"index":0,"texCoord":1}},
                      "KHR_materials_clearcoat":{"clearcoatNormalTexture":{"index":0,
                          "extensions":{"KHR_texture_transform":{"rotation":0.5,"scale":[3,-3]}}}}}})");
    const PrimitiveInfo info = inspect(builder).primitives.at(0);
    ASSERT_EQ(info.tangent_uses.size(), 3u);
    const TangentUseInfo& first = info.tangent_uses[0];
    EXPECT_EQ(first.needed_by, "normalTexture");
    EXPECT_EQ(first.place, "/materials/0/normalTexture");
    EXPECT_EQ(first.uv_rotation_rad, 0.5);
    EXPECT_EQ(first.uv_scale[1], -2);
    EXPECT_EQ(first.uv_offset[0], 1);
    EXPECT_TRUE(first.follows_first);
    EXPECT_EQ(info.tangent_uses[1].needed_by, "clearcoatNormalTexture");
    EXPECT_TRUE(info.tangent_uses[1].follows_first) << "turned and mirrored in the same way";
    EXPECT_EQ(info.tangent_uses[2].uv_set, 1);
    EXPECT_FALSE(info.tangent_uses[2].follows_first);
}

TEST(InspectNeeds, CountsMirroredTrianglesAsTheTransformShowsThem) {
    GltfBuilder builder = gridModel(Grid(4));
    EXPECT_EQ(inspect(builder).primitives.at(0).mirrored_triangle_count, 16u);
    builder = gridModel(Grid(4, false));
    EXPECT_EQ(inspect(builder).primitives.at(0).mirrored_triangle_count, 0u);
    builder.json()["materials"][0]["normalTexture"]["extensions"]["KHR_texture_transform"]["scale"] = {-1, 1};
    EXPECT_EQ(inspect(builder).primitives.at(0).mirrored_triangle_count, 32u);
}

TEST(InspectNeeds, NamesVariantsAndCountsTheirMaterials) {
    GltfBuilder builder = gridModel(Grid(2));
    builder.json()["extensions"]["KHR_materials_variants"]["variants"] =
        Json::parse(R"([{"name":"red"},{"name":"old"}])");
    firstPrimitive(builder)["material"] = 1;
    firstPrimitive(builder)["extensions"]["KHR_materials_variants"]["mappings"] =
        Json::parse(R"([{"material":0,"variants":[0]},{"material":1,"variants":[1]}])");
    const Inspection file = inspect(builder);
    EXPECT_EQ(file.variants, (std::vector<std::string>{"red", "old"}));
    EXPECT_EQ(file.primitives.at(0).variant_material_count, 2u);
    EXPECT_TRUE(file.primitives.at(0).needs_tangents);
    EXPECT_TRUE(file.primitives.at(0).tangent_uses.at(0).only_in_variant);
}

TEST(InspectNeeds, CountsNodesAndInstances) {
    GltfBuilder builder = gridModel(Grid(2));
    const std::size_t places = builder.addFloats(std::vector<float>(5 * 3), 3);
    builder.json()["nodes"] = Json::parse(R"([{"mesh":0},{"name":"empty"},{"mesh":0,"extensions":{
        "EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0}}}}])");
    builder.json()["nodes"][2]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = places;
    const PrimitiveInfo info = inspect(builder).primitives.at(0);
    EXPECT_EQ(info.node_count, 2u);
    EXPECT_EQ(info.instance_count, 6u);
    builder.json()["nodes"][2]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 99;
    const TempFolder folder;
    const auto bad = inspectFile(folder.write("in.glb", builder.glb()));
    ASSERT_FALSE(bad);
    EXPECT_EQ(bad.error().place, "/nodes/2/extensions/EXT_mesh_gpu_instancing/attributes/TRANSLATION");
}

/// Returns a wavy sheet of irregular triangles, each about 5 units wide. Positions are rounded to integers and stored
/// as 16-bit integers or as floats.
GltfBuilder roundedSheet(bool as_floats) {
    constexpr int kSide = 60;
    GltfBuilder builder;
    std::vector<std::int16_t> rounded;
    std::vector<std::uint16_t> indices;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const double at_x = 5 * (x + 0.3 * std::sin(7.0 * x + 12.0 * y)),
                         at_y = 5 * (y + 0.3 * std::sin(5.0 * x * y));
            const double height = 60 * std::sin(0.03 * at_x + 0.4) * std::cos(0.022 * at_y);
            for (const double number : {at_x, at_y, height, 0.0})
                rounded.push_back(static_cast<std::int16_t>(std::lround(number)));
            if (x + 1 == kSide || y + 1 == kSide) continue;
            const auto a = static_cast<std::uint16_t>(y * kSide + x);
            for (const int corner : {0, 1, kSide + 1, 0, kSide + 1, kSide})
                indices.push_back(static_cast<std::uint16_t>(a + corner));
        }
    }
    const std::size_t count = kSide * kSide;
    std::size_t positions = 0;
    if (as_floats) {
        positions = builder.addFloats(std::vector<float>(rounded.begin(), rounded.end()), 4);
        builder.json()["bufferViews"].back()["byteStride"] = 16;
    } else {
        positions = builder.addAccessor(rounded, 5122, "VEC3", count);
        builder.json()["bufferViews"].back()["byteStride"] = 8;
        builder.json()["extensionsUsed"] = builder.json()["extensionsRequired"] = {"KHR_mesh_quantization"};
    }
    builder.json()["accessors"].back()["type"] = "VEC3";
    const std::size_t list = builder.addAccessor(indices, 5123, "SCALAR", indices.size());
    builder.addPrimitive({{"POSITION", positions}})["indices"] = list;
    return builder;
}

TEST(InspectNeeds, RoundingIsNotReportedAsNoise) {
    EXPECT_GT(inspect(roundedSheet(true)).primitives.at(0).position_noise, 0.03)
        << "floats that happen to be whole numbers are taken for what they are";
    EXPECT_EQ(inspect(roundedSheet(false)).primitives.at(0).position_noise, 0);
}

}  // namespace
}  // namespace tspace
