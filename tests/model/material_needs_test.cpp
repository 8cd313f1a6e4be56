// SPDX-License-Identifier: MIT
// Which parts of a primitive's materials need tangents, and for which UV sets.
#include "model/gltf/material_needs.h"

#include <gtest/gtest.h>

#include "gltf_builder.h"

namespace tspace::gltf {
namespace {

using test::errorOf;
using test::GltfBuilder;
using test::parse;

/// Returns a model of one primitive with material 0. `more`: the other materials.
GltfBuilder withMaterial(const std::string& material, const std::string& more = "",
                         const std::string& primitive_extensions = "{}") {
    GltfBuilder builder;
    builder.addFloats(std::vector<float>(9), 3);
    builder.addPrimitive({{"POSITION", 0}});
    builder.json()["materials"] = Json::parse("[" + material + (more.empty() ? "" : "," + more) + "]");
    builder.json()["meshes"][0]["primitives"][0]["material"] = 0;
    builder.json()["meshes"][0]["primitives"][0]["extensions"] = Json::parse(primitive_extensions);
    return builder;
}

std::vector<TangentUse> usesOf(const GltfBuilder& builder) {
    const Document document = parse(builder);
    return tangentUses(document, readPrimitives(document)[0]);
}

TEST(TangentUses, FollowTheTextureThatNeedsThem) {
    const struct {
        const char* material;
        const char* needed_by;
        std::size_t uv_set;
        const char* place;
    } cases[] = {
        {R"({})", "", 0, ""},
        {R"({"normalTexture":{"index":0}})", "normalTexture", 0, "/materials/0/normalTexture"},
        {R"({"normalTexture":{"index":0,"texCoord":2}})", "normalTexture", 2, "/materials/0/normalTexture"},
        {R"({"normalTexture":{"texCoord":2,"extensions":{"KHR_texture_transform":{"texCoord":1}}}})", "normalTexture",
         1, "/materials/0/normalTexture"},
        {R"({"normalTexture":{"texCoord":2,"extensions":{"KHR_texture_transform":{"scale":[2,2]}}}})", "normalTexture",
         2, "/materials/0/normalTexture"},
        {R"({"extensions":{"KHR_materials_clearcoat":{"clearcoatNormalTexture":{"index":0,"texCoord":1}}}})",
         "clearcoatNormalTexture", 1, "/materials/0/extensions/KHR_materials_clearcoat/clearcoatNormalTexture"},
        {R"({"extensions":{"KHR_materials_clearcoat":{"clearcoatTexture":{"index":0}}}})", "", 0, ""},
        {R"({"extensions":{"KHR_materials_anisotropy":{"anisotropyStrength":0.5}}})", "anisotropy", 0,
         "/materials/0/extensions/KHR_materials_anisotropy"},
        {R"({"extensions":{"KHR_materials_anisotropy":{"anisotropyTexture":{"index":0,"texCoord":1}}}})", "anisotropy",
         1, "/materials/0/extensions/KHR_materials_anisotropy/anisotropyTexture"},
        {R"({"extensions":{"KHR_materials_anisotropy":{}}})", "", 0, ""},
    };
    for (const auto& test : cases) {
        const std::vector<TangentUse> uses = usesOf(withMaterial(test.material));
        ASSERT_EQ(uses.size(), test.needed_by[0] == '\0' ? 0u : 1u) << test.material;
        if (uses.empty()) continue;
        EXPECT_EQ(uses[0].needed_by, test.needed_by) << test.material;
        EXPECT_EQ(uses[0].uv_set, test.uv_set) << test.material;
        EXPECT_EQ(uses[0].place, test.place) << test.material;
        EXPECT_EQ(uses[0].material, 0u);
        EXPECT_FALSE(uses[0].only_in_variant);
    }
}

TEST(TangentUses, AreAllOfAMaterialWithTheNormalMapFirst) {
    const auto uses = usesOf(withMaterial(R"({
        "extensions":{"KHR_materials_anisotropy":{"anisotropyTexture":{"index":0,"texCoord":3}},
                      "KHR_materials_clearcoat":{"clearcoatNormalTexture":{"index":0,"texCoord":1}}},
        "normalTexture":{"index":0,"texCoord":4}})"));
    ASSERT_EQ(uses.size(), 3u);
    EXPECT_EQ(uses[0].needed_by, "normalTexture");
    EXPECT_EQ(uses[0].uv_set, 4u);
    EXPECT_EQ(uses[1].needed_by, "clearcoatNormalTexture");
    EXPECT_EQ(uses[1].uv_set, 1u);
    EXPECT_EQ(uses[2].needed_by, "anisotropy");
    EXPECT_EQ(uses[2].uv_set, 3u);
}

TEST(TangentUses, OfAnisotropyWithoutATextureFollowTheNormalMap) {
    const auto uses = usesOf(withMaterial(R"({
        "extensions":{"KHR_materials_anisotropy":{"anisotropyStrength":1}},
        "normalTexture":{"texCoord":1,"extensions":{"KHR_texture_transform":{"rotation":1}}}})"));
    ASSERT_EQ(uses.size(), 2u);
    EXPECT_EQ(uses[1].needed_by, "anisotropy");
    EXPECT_EQ(uses[1].uv_set, 1u);
    EXPECT_EQ(uses[1].transform.rotation, 1);
    EXPECT_EQ(uses[1].image, std::nullopt);
}

TEST(TangentUses, HaveTheTextureTransform) {
    const auto uses = usesOf(withMaterial(R"({"normalTexture":{"extensions":{"KHR_texture_transform":{
        "offset":[0.5,-1],"rotation":1.25,"scale":[-2,3]}}}})"));
    const UvTransform& transform = uses.at(0).transform;
    EXPECT_EQ(transform.offset[0], 0.5);
    EXPECT_EQ(transform.offset[1], -1);
    EXPECT_EQ(transform.rotation, 1.25);
    EXPECT_EQ(transform.scale[0], -2);
    EXPECT_EQ(transform.scale[1], 3);
    EXPECT_TRUE(transform.changesFrames());
    EXPECT_TRUE(transform.mirrors());
    const auto plain =
        usesOf(withMaterial(R"({"normalTexture":{"extensions":{"KHR_texture_transform":{"offset":[0.5,0.5]}}}})"));
    EXPECT_FALSE(plain.at(0).transform.changesFrames());
}

TEST(TangentUses, NameTheImageWhereThereIsOne) {
    const auto imageOf = [](const std::string& texture, const char* reference = R"({"index":0})") {
        GltfBuilder builder = withMaterial(std::string(R"({"normalTexture":)") + reference + "}");
        builder.json()["textures"] = Json::parse("[" + texture + "]");
        builder.json()["images"] = Json::parse(R"([{"uri":"a.png"},{"uri":"b.webp"}])");
        return usesOf(builder).at(0).image;
    };
    EXPECT_EQ(imageOf(R"({"source":1})"), 1u);
    EXPECT_EQ(imageOf(R"({"source":0,"extensions":{"EXT_texture_webp":{"source":1}}})"), 0u);
    EXPECT_EQ(imageOf(R"({"extensions":{"KHR_texture_basisu":{"source":1}}})"), 1u);
    EXPECT_EQ(imageOf("{}"), std::nullopt);
    EXPECT_EQ(imageOf(R"({"source":2})"), std::nullopt);
    EXPECT_EQ(imageOf(R"({"source":-1})"), std::nullopt);
    EXPECT_EQ(imageOf(R"({"source":1})", R"({"index":1})"), std::nullopt);
    EXPECT_EQ(imageOf(R"({"source":1})", "{}"), std::nullopt);
}

TEST(TangentUses, AreThoseOfEveryVariantToo) {
    const std::string mapped = R"({"normalTexture":{"index":0,"texCoord":3}})";
    const char* variants = R"({"KHR_materials_variants":{"mappings":[
        {"material":0,"variants":[0]},{"material":1,"variants":[1]},{"material":1,"variants":[2]}]}})";
    const auto only_there = usesOf(withMaterial("{}", mapped, variants));
    ASSERT_EQ(only_there.size(), 1u) << "a material counts once";
    EXPECT_EQ(only_there[0].needed_by, "normalTexture");
    EXPECT_EQ(only_there[0].uv_set, 3u);
    EXPECT_EQ(only_there[0].material, 1u);
    EXPECT_EQ(only_there[0].place, "/materials/1/normalTexture");
    EXPECT_TRUE(only_there[0].only_in_variant);

    const auto both = usesOf(
        withMaterial(R"({"extensions":{"KHR_materials_anisotropy":{"anisotropyStrength":1}}})", mapped, variants));
    ASSERT_EQ(both.size(), 2u);
    EXPECT_EQ(both[0].needed_by, "anisotropy") << "the primitive's own material goes first";
    EXPECT_FALSE(both[0].only_in_variant);
    EXPECT_TRUE(both[1].only_in_variant);
}

TEST(TangentUses, IgnoreVariantsWithoutTheirMaterial) {
    EXPECT_TRUE(
        usesOf(withMaterial("{}", "", R"({"KHR_materials_variants":{"mappings":[{"material":1},{}]}})")).empty());
}

TEST(TangentUses, RejectWrongTypesWithTheirLocation) {
    const auto placeOf = [](const std::string& material, const std::string& extensions = "{}") {
        return errorOf([&] { usesOf(withMaterial(material, "", extensions)); }).place;
    };
    const auto transform = [&](const std::string& member) {
        return placeOf(R"({"normalTexture":{"extensions":{"KHR_texture_transform":{)" + member + "}}}}");
    };
    const std::string texture = "/materials/0/normalTexture";
    const std::string base = texture + "/extensions/KHR_texture_transform";
    EXPECT_EQ(placeOf(R"({"normalTexture":5})"), texture);
    EXPECT_EQ(placeOf(R"({"normalTexture":{"texCoord":-1}})"), texture + "/texCoord");
    EXPECT_EQ(placeOf(R"({"extensions":[]})"), "/materials/0/extensions");
    EXPECT_EQ(transform(R"("offset":[1])"), base + "/offset");
    EXPECT_EQ(transform(R"("scale":[1,"x"])"), base + "/scale/1");
    EXPECT_EQ(transform(R"("scale":2)"), base + "/scale");
    EXPECT_EQ(transform(R"("rotation":[])"), base + "/rotation");
    EXPECT_EQ(transform(R"("texCoord":4294967296)"), base + "/texCoord");
    EXPECT_EQ(placeOf("{}", R"({"KHR_materials_variants":{"mappings":[{"material":"x"}]}})"),
              "/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings/0/material");
}

}  // namespace
}  // namespace tspace::gltf
