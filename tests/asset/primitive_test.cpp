// SPDX-License-Identifier: MIT
// Primitives: triangles out of every mode, and checks of counts.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace tspace::gltf
