// SPDX-License-Identifier: MIT
// What inspect says about needs: every use, transforms, variants, and how often a mesh is drawn.
#include <gtest/gtest.h>

#include "generate_run.h"

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

}  // namespace
}  // namespace tspace
