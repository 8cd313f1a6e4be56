// SPDX-License-Identifier: MIT
// A small model, and a function that runs generateFile on models created in a test.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gltf_builder.h"
#include "model/gltf/primitive_reader.h"
#include "model/read/read_scene.h"
#include "model_compare.h"
#include "support/temp_folder.h"

namespace tspace::test {

inline constexpr int kU8 = 5121, kU16 = 5123, kU32 = 5125;

/// A flat grid of quads with the UV map mirrored at the middle column, so that its vertices there must be split.
class Grid {
  public:
    explicit Grid(std::size_t size, bool mirrored = true) : size_(size) {
        for (std::size_t y = 0; y <= size; ++y) {
            for (std::size_t x = 0; x <= size; ++x) {
                const auto u = static_cast<float>(mirrored && x > size / 2 ? size / 2 * 2 - x : x);
                positions.insert(positions.end(), {static_cast<float>(x), static_cast<float>(y), 0});
                normals.insert(normals.end(), {0, 0, 1});
                uvs.insert(uvs.end(),
                           {u / static_cast<float>(size), 1 - static_cast<float>(y) / static_cast<float>(size)});
            }
        }
    }
    template <class Index>
    [[nodiscard]] std::vector<Index> indices() const {
        std::vector<Index> list;
        for (std::size_t y = 0; y < size_; ++y) {
            for (std::size_t x = 0; x < size_; ++x) {
                const std::size_t a = y * (size_ + 1) + x, b = a + size_ + 1;
                for (const std::size_t i : {a, a + 1, b + 1, a, b + 1, b}) list.push_back(static_cast<Index>(i));
            }
        }
        return list;
    }
    [[nodiscard]] std::size_t vertexCount() const { return positions.size() / 3; }

    std::vector<float> positions, normals, uvs;

  private:
    std::size_t size_;
};

/// Returns a model of one primitive with a normal map. Its accessors are POSITION 0, NORMAL 1, TEXCOORD_0 2, indices 3.
inline GltfBuilder gridModel(const Grid& grid, int index_type = kU16) {
    GltfBuilder builder;
    builder.addFloats(grid.positions, 3);
    builder.json()["accessors"][0]["min"] = {0, 0, 0};
    builder.json()["accessors"][0]["max"] = {9, 9, 0};
    builder.addFloats(grid.normals, 3);
    builder.addFloats(grid.uvs, 2);
    const std::size_t count = grid.indices<std::uint32_t>().size();
    if (index_type == kU8) builder.addAccessor(grid.indices<std::uint8_t>(), kU8, "SCALAR", count);
    if (index_type == kU16) builder.addAccessor(grid.indices<std::uint16_t>(), kU16, "SCALAR", count);
    if (index_type == kU32) builder.addAccessor(grid.indices<std::uint32_t>(), kU32, "SCALAR", count);
    builder.json()["materials"] = Json::parse(R"([{"normalTexture":{"index":0}},{"name":"plain"}])");
    builder.json()["textures"] = Json::parse("[{}]");
    Json& primitive = builder.addPrimitive({{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}});
    primitive["indices"] = 3;
    primitive["material"] = 0;
    return builder;
}

/// Returns gridModel with wrong tangents in accessor 4.
inline GltfBuilder withTangents(const Grid& grid) {
    GltfBuilder builder = gridModel(grid);
    const std::size_t tangent = builder.addFloats(std::vector<float>(grid.vertexCount() * 4, 0.5f), 4);
    builder.json()["accessors"][tangent]["min"] = builder.json()["accessors"][tangent]["max"] = {0.5, 0.5, 0.5, 0.5};
    builder.json()["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] = tangent;
    return builder;
}

inline Json& firstPrimitive(GltfBuilder& builder) { return builder.json()["meshes"][0]["primitives"][0]; }

struct GenerateRun {
    GenerateReport report;
    gltf::Document before, after;
    std::vector<gltf::Primitive> primitives;
    Bytes file;
};

/// Runs generateFile on `builder` as a GLB, checks everything that must be preserved, and runs again.
inline GenerateRun run(const GltfBuilder& builder, GenerateOptions options = {},
                       const std::vector<gltf::ExtraChunk>& chunks = {}) {
    const TempFolder folder;
    const std::string input = folder.write("in.glb", builder.glb(chunks)), output = folder.path("out.glb").string();
    auto report = generateFile(input, output, options);
    GenerateRun outcome;
    EXPECT_TRUE(report) << report.error().message << " at " << report.error().place;
    if (!report) return outcome;
    outcome = {*std::move(report), gltf::loadDocument(input, {}), gltf::loadDocument(output, {}), {}, readFile(output)};
    outcome.primitives = readPrimitives(outcome.after);
    for (const std::string& difference : differences(outcome.before, outcome.after, outcome.report)) {
        ADD_FAILURE() << difference;
    }
    options.selection.existing = ExistingTangents::replace;
    const auto second = generateFile(output, output, options);
    EXPECT_TRUE(second && !second->changed);
    EXPECT_EQ(readFile(output), outcome.file);
    return outcome;
}

}  // namespace tspace::test
