// SPDX-License-Identifier: MIT
// Primitives: triangles out of every mode, checks of counts, and which materials need tangents.
#include <gtest/gtest.h>

#include "asset/gltf/material_needs.h"
#include "asset/gltf/primitive_reader.h"
#include "gltf_builder.h"

namespace tspace::gltf {
namespace {

using test::errorOf;
using test::GltfBuilder;
using test::parse;
using Corners = std::vector<std::uint32_t>;

GltfBuilder withVertices(std::size_t count) {
    GltfBuilder builder;
    builder.addFloats(std::vector<float>(count * 3), 3);
    builder.addPrimitive({{"POSITION", 0}});
    return builder;
}

Corners corners(const GltfBuilder& builder) {
    const Document document = parse(builder);
    return readTriangleCorners(document, readPrimitives(document).at(0));
}

TEST(Primitive, CutsStripsAndFansAsTheSpecificationSays) {
    GltfBuilder builder = withVertices(5);
    Json& primitive = builder.json()["meshes"][0]["primitives"][0];
    primitive["mode"] = 5;
    EXPECT_EQ(corners(builder), (Corners{0, 1, 2, 1, 3, 2, 2, 3, 4}));
    primitive["mode"] = 6;
    EXPECT_EQ(corners(builder), (Corners{1, 2, 0, 2, 3, 0, 3, 4, 0}));
    primitive["mode"] = 4;
    EXPECT_EQ(corners(builder), (Corners{0, 1, 2}));
    builder.addAccessor<std::uint8_t>({4, 3, 2, 1}, 5121, "SCALAR", 4);
    builder.json()["meshes"][0]["primitives"][0]["indices"] = 1;
    builder.json()["meshes"][0]["primitives"][0]["mode"] = 5;
    EXPECT_EQ(corners(builder), (Corners{4, 3, 2, 3, 1, 2}));
}

TEST(Primitive, LeavesPointsLinesAndTooFewCornersWithoutTriangles) {
    for (int mode = 0; mode < 7; ++mode) {
        GltfBuilder builder = withVertices(2);
        builder.json()["meshes"][0]["primitives"][0]["mode"] = mode;
        EXPECT_EQ(readPrimitives(parse(builder))[0].triangleCount(), 0u);
        EXPECT_EQ(hasTriangles(static_cast<Mode>(mode)), mode >= 4);
    }
}

TEST(Primitive, RefusesBadReferencesAtTheirPlace) {
    const auto place = [](const std::string& key, const Json& value) {
        GltfBuilder builder = withVertices(3);
        builder.addFloats({0, 0, 0}, 3);
        builder.json()["meshes"][0]["primitives"][0][key] = value;
        return errorOf([&] {
                   const Document document = parse(builder);
                   readTriangleCorners(document, readPrimitives(document)[0]);
               })
            .place;
    };
    const std::string base = "/meshes/0/primitives/0";
    EXPECT_EQ(place("mode", 7), base + "/mode");
    EXPECT_EQ(place("mode", "x"), base + "/mode");
    EXPECT_EQ(place("indices", 9), base + "/indices");
    EXPECT_EQ(place("indices", 0), base + "/indices");
    EXPECT_EQ(place("material", 0), base + "/material");
    EXPECT_EQ(place("attributes", Json::array()), base + "/attributes");
    EXPECT_EQ(place("attributes", {{"POSITION", 9}}), base + "/attributes/POSITION");
    EXPECT_EQ(place("attributes", {{"POSITION", 0}, {"NORMAL", 1}}), base + "/attributes/NORMAL");
    EXPECT_EQ(place("targets", Json::array({Json{{"POSITION", 1}}})), base + "/targets/0/POSITION");
    EXPECT_EQ(place("targets", 1), base + "/targets");
}

TangentNeed needOf(const std::string& material, const std::string& primitive_extensions = "{}") {
    GltfBuilder builder = withVertices(3);
    builder.json()["materials"] =
        Json::array({Json::parse(material), Json::parse(R"({"normalTexture":{"index":0,"texCoord":3}})")});
    builder.json()["meshes"][0]["primitives"][0]["material"] = 0;
    builder.json()["meshes"][0]["primitives"][0]["extensions"] = Json::parse(primitive_extensions);
    const Document document = parse(builder);
    return tangentNeed(document, readPrimitives(document)[0]);
}

TEST(TangentNeed, FollowsTheTextureThatAsks) {
    const struct {
        const char* material;
        const char* needed_by;
        std::size_t uv_set;
    } cases[] = {
        {R"({})", "", 0},
        {R"({"normalTexture":{"index":0}})", "normalTexture", 0},
        {R"({"normalTexture":{"index":0,"texCoord":2}})", "normalTexture", 2},
        {R"({"normalTexture":{"texCoord":2,"extensions":{"KHR_texture_transform":{"texCoord":1}}}})",
         "normalTexture", 1},
        {R"({"normalTexture":{"texCoord":2,"extensions":{"KHR_texture_transform":{"scale":[2,2]}}}})",
         "normalTexture", 2},
        {R"({"extensions":{"KHR_materials_clearcoat":{"clearcoatNormalTexture":{"index":0,"texCoord":1}}}})",
         "clearcoatNormalTexture", 1},
        {R"({"extensions":{"KHR_materials_clearcoat":{"clearcoatTexture":{"index":0}}}})", "", 0},
        {R"({"extensions":{"KHR_materials_anisotropy":{"anisotropyStrength":0.5}}})", "anisotropy", 0},
        {R"({"extensions":{"KHR_materials_anisotropy":{"anisotropyTexture":{"index":0,"texCoord":1}}}})",
         "anisotropy", 1},
        {R"({"extensions":{"KHR_materials_anisotropy":{}}})", "", 0},
        {R"({"normalTexture":{"index":0,"texCoord":4},
             "extensions":{"KHR_materials_clearcoat":{"clearcoatNormalTexture":{"index":0,"texCoord":1}}}})",
         "normalTexture", 4},
    };
    for (const auto& test : cases) {
        const TangentNeed need = needOf(test.material);
        EXPECT_EQ(need.needed_by, test.needed_by) << test.material;
        EXPECT_EQ(need.uv_set, test.uv_set) << test.material;
    }
}

TEST(TangentNeed, LooksAtMaterialVariants) {
    const TangentNeed need = needOf(
        "{}",
        R"({"KHR_materials_variants":{"mappings":[{"material":0,"variants":[0]},{"material":1,"variants":[1]}]}})");
    EXPECT_EQ(need.needed_by, "normalTexture");
    EXPECT_EQ(need.uv_set, 3u);
}

TEST(TangentNeed, RefusesWrongTypes) {
    EXPECT_EQ(errorOf([] { needOf(R"({"normalTexture":5})"); }).place, "/materials/0/normalTexture");
    EXPECT_EQ(errorOf([] { needOf(R"({"normalTexture":{"texCoord":-1}})"); }).place,
              "/materials/0/normalTexture/texCoord");
    EXPECT_EQ(errorOf([] { needOf(R"({"extensions":[]})"); }).place, "/materials/0/extensions");
}

}  // namespace
}  // namespace tspace::gltf
