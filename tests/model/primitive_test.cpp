// SPDX-License-Identifier: MIT
// Primitives: triangles of every mode, and checks of their counts.
#include <gtest/gtest.h>

#include <bit>

#include "gltf_builder.h"
#include "model/gltf/primitive_reader.h"

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

TEST(Primitive, TriangulatesStripsAndFansAsSpecified) {
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

/// Returns a model with interleaved positions and UVs that start at byte `shift` of the buffer.
GltfBuilder interleaved(std::size_t shift) {
    GltfBuilder builder;
    const std::vector<float> values = {1, 2, 3, 0.5f, 0.25f, 4, 5, 6, 0.75f, 1};
    Bytes bytes(shift, 0);
    const Bytes floats = test::bytesOfValues(values);
    bytes.insert(bytes.end(), floats.begin(), floats.end());
    builder.addView(bytes);
    builder.json()["bufferViews"][0] = {{"buffer", 0}, {"byteOffset", shift}, {"byteLength", 40}, {"byteStride", 20}};
    for (const int components : {3, 2}) {
        builder.json()["accessors"].push_back({{"bufferView", 0},
                                               {"byteOffset", components == 3 ? 0 : 12},
                                               {"componentType", 5126},
                                               {"count", 2},
                                               {"type", "VEC" + std::to_string(components)}});
    }
    builder.addPrimitive({{"POSITION", 0}, {"TEXCOORD_0", 1}});
    return builder;
}

TEST(Primitive, ReturnsFloatsWithoutACopy) {
    if (std::endian::native != std::endian::little) GTEST_SKIP() << "here floats are turned, and so copied";
    const Document document = parse(interleaved(4));
    const Primitive primitive = readPrimitives(document)[0];
    const auto positions = lendVec3(document, primitive, "POSITION");
    const auto uvs = lendUvs(document, primitive, 0);
    ASSERT_TRUE(positions && uvs);
    EXPECT_EQ(positions->count, 2u);
    EXPECT_EQ((*positions)[1], (Vec3{4, 5, 6}));
    EXPECT_EQ((*uvs)[0], (Vec2{0.5f, 0.25f}));
    EXPECT_EQ((*uvs)[1], (Vec2{0.75f, 1}));
    EXPECT_EQ(uvs->stride_bytes, 20u);
}

TEST(Primitive, CopiesDataThatIsNotAlignedFloats) {
    if (std::endian::native != std::endian::little) GTEST_SKIP() << "here floats are turned, and so copied";
    const auto lent = [](const GltfBuilder& builder) {
        const Document document = parse(builder);
        const Primitive primitive = readPrimitives(document)[0];
        const bool positions = lendVec3(document, primitive, "POSITION").has_value();
        const bool uvs = lendUvs(document, primitive, 0).has_value();
        return std::pair(positions, uvs);
    };
    for (const std::size_t shift : {1u, 2u, 3u}) EXPECT_EQ(lent(interleaved(shift)), std::pair(false, false));
    GltfBuilder builder = interleaved(0);
    EXPECT_EQ(lent(builder), std::pair(true, true));
    builder.json()["accessors"][1]["componentType"] = 5123;
    builder.json()["accessors"][1]["normalized"] = true;
    EXPECT_EQ(lent(builder), std::pair(true, false));
    builder.json()["accessors"][1]["componentType"] = 5125;  // same size as floats, and allowed by the file format
    EXPECT_EQ(lent(builder), std::pair(true, false));
    builder.json()["accessors"][0].erase("bufferView");  // without a view, all values are zero
    EXPECT_EQ(lent(builder), std::pair(false, false));
    builder.json()["accessors"][0]["bufferView"] = 0;
    builder.json()["accessors"][0]["sparse"] = {{"count", 1},
                                                {"indices", {{"bufferView", 0}, {"componentType", 5121}}},
                                                {"values", {{"bufferView", 0}, {"byteOffset", 4}}}};
    builder.json()["bufferViews"][0].erase("byteStride");
    EXPECT_EQ(lent(builder), std::pair(false, false));
}

TEST(Primitive, RejectsInvalidReferencesWithTheirLocation) {
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
    EXPECT_EQ(place("targets", Json::array({Json{{"POSITION", 9}}})), base + "/targets/0/POSITION");
    EXPECT_EQ(place("targets", 1), base + "/targets");
}

}  // namespace
}  // namespace tspace::gltf
