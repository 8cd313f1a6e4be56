// SPDX-License-Identifier: MIT
// Creation of glTF documents: the JSON of each accessor, and the position of its bytes.
#include "model/gltf/document_builder.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "tspace/span.h"

namespace tspace {
namespace {

using gltf::DocumentBuilder;

TEST(DocumentBuilder, BeginsEachViewAtAMultipleOfFourBytes) {
    DocumentBuilder builder(Json::object());
    const std::vector<std::uint8_t> five(5, 7);
    for (int i = 0; i < 3; ++i) builder.addView(std::as_bytes(std::span(five)), 1, gltf::kNoTarget);
    EXPECT_EQ(builder.json()["bufferViews"].dump(),
              R"([{"buffer":0,"byteOffset":0,"byteLength":5},{"buffer":0,"byteOffset":8,"byteLength":5},)"
              R"({"buffer":0,"byteOffset":16,"byteLength":5}])");
    EXPECT_EQ(builder.bytes(), (Bytes{7, 7, 7, 7, 7, 0, 0, 0, 7, 7, 7, 7, 7, 0, 0, 0, 7, 7, 7, 7, 7}));
}

TEST(DocumentBuilder, BoundsAreThoseOfEachComponent) {
    DocumentBuilder builder(Json::object());
    const std::vector<Vec3> positions{{1, -2, 3}, {-1, 5, 3}, {0, 0, 4}};
    builder.addFloats(positions, positions.size(), "VEC3", gltf::kVertexTarget, true);
    EXPECT_EQ(builder.json()["accessors"][0].dump(),
              R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[-1.0,-2.0,3.0],)"
              R"("max":[1.0,5.0,4.0]})");
    EXPECT_EQ(builder.json()["bufferViews"][0].dump(), R"({"buffer":0,"byteOffset":0,"byteLength":36,"target":34962})");
}

TEST(DocumentBuilder, IndicesHave16BitsAsLongAsNoneIs65535) {
    std::vector<std::uint32_t> indices(65535);
    std::iota(indices.begin(), indices.end(), 0U);
    DocumentBuilder builder(Json::object());
    builder.addIndices(indices, indices.size());
    indices.push_back(65535);
    builder.addIndices(indices, indices.size());
    EXPECT_EQ(builder.json()["accessors"][0]["componentType"], 5123);
    EXPECT_EQ(builder.json()["bufferViews"][0]["byteLength"], 2 * 65535);
    EXPECT_EQ(builder.json()["accessors"][1]["componentType"], 5125);
    EXPECT_EQ(builder.json()["bufferViews"][1]["byteLength"], 4 * 65536);
}

}  // namespace
}  // namespace tspace
