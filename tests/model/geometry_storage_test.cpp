// SPDX-License-Identifier: MIT
// The various ways in which glTF stores and shares geometry. `run` compares every attribute at every corner, and runs
// generate again on its output.
#include <gtest/gtest.h>

#include <cmath>

#include "generate_run.h"
#include "model/gltf/accessor.h"

namespace tspace {
namespace {

using namespace test;

void expectUnitTangents(const GenerateRun& outcome, std::size_t primitive = 0) {
    for (const Vec4& t : readTangents(outcome.after, outcome.primitives.at(primitive))) {
        EXPECT_NEAR(t.x * t.x + t.y * t.y + t.z * t.z, 1, 1e-5);
        EXPECT_EQ(std::fabs(t.w), 1);
    }
}

/// Returns a model whose vertices, in the given order, form a strip or a fan. `mode`: of the glTF primitive.
GltfBuilder strung(int mode, const std::vector<Vec2>& places, const std::vector<Vec2>& uvs, bool is_indexed) {
    GltfBuilder builder;
    std::vector<float> positions, normals, coordinates;
    std::vector<std::uint16_t> indices;
    for (std::size_t i = 0; i < places.size(); ++i) {
        indices.push_back(static_cast<std::uint16_t>(i));
        positions.insert(positions.end(), {places[i].x, places[i].y, 0});
        normals.insert(normals.end(), {0, 0, 1});
        coordinates.insert(coordinates.end(), {uvs[i].x, uvs[i].y});
    }
    builder.addFloats(positions, 3);
    builder.addFloats(normals, 3);
    builder.addFloats(coordinates, 2);
    Json& primitive = builder.addPrimitive({{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}});
    primitive["mode"] = mode;
    if (is_indexed) primitive["indices"] = builder.addAccessor(indices, kU16, "SCALAR", indices.size());
    return builder;
}

/// Returns a ribbon of quads along x as one strip. `is_mirrored`: its UVs are mirrored at its middle.
GltfBuilder ribbon(bool is_mirrored, bool is_indexed) {
    std::vector<Vec2> places, uvs;
    for (int x = 0; x <= 4; ++x) {
        for (int y = 0; y < 2; ++y) {
            places.push_back({static_cast<float>(x), static_cast<float>(1 - y)});
            uvs.push_back({static_cast<float>(is_mirrored && x > 2 ? 4 - x : x), static_cast<float>(y)});
        }
    }
    return strung(5, places, uvs, is_indexed);
}

/// Returns a fan of four triangles around the origin. `is_mirrored`: u increases away from the y axis on both sides.
GltfBuilder fan(bool is_mirrored, bool is_indexed) {
    const std::vector<Vec2> places = {{0, 0}, {2, 0}, {1, 1}, {0, 2}, {-1, 1}, {-2, 0}};
    std::vector<Vec2> uvs;
    for (const Vec2& place : places) uvs.push_back({is_mirrored ? std::fabs(place.x) : place.x, -place.y});
    return strung(6, places, uvs, is_indexed);
}

TEST(GeometryStorage, StripsAndFansAreKeptUnlessVerticesAreSplit) {
    for (const bool is_indexed : {false, true}) {
        for (const auto& make : {ribbon, fan}) {
            const GltfBuilder plain = make(false, is_indexed);
            const GenerateRun same = run(plain, {.selection = {.all = true}});
            EXPECT_EQ(same.report.primitives.at(0).vertices_after, same.report.primitives[0].vertices_before);
            EXPECT_EQ(same.after.json["meshes"][0]["primitives"][0]["mode"],
                      same.before.json["meshes"][0]["primitives"][0]["mode"]);
            EXPECT_EQ(same.primitives[0].indices.has_value(), is_indexed);
            expectUnitTangents(same);

            const GenerateRun split = run(make(true, is_indexed), {.selection = {.all = true}});
            EXPECT_EQ(split.report.primitives.at(0).vertices_after, split.report.primitives[0].vertices_before + 2);
            EXPECT_EQ(split.primitives[0].mode, gltf::Mode::triangles);
            EXPECT_TRUE(split.primitives[0].indices.has_value());
            expectUnitTangents(split);
        }
    }
}

TEST(GeometryStorage, PrimitiveRestartIsRejectedInOneSentence) {
    GltfBuilder builder = ribbon(false, false);
    firstPrimitive(builder)["indices"] =
        builder.addAccessor<std::uint16_t>({0, 1, 2, 3, 65535, 4, 5, 6}, kU16, "SCALAR", 8);
    const TempFolder folder;
    const auto report = generateFile(folder.write("in.glb", builder.glb()), folder.path("out.glb").string(),
                                     {.selection = {.all = true}});
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::invalidFile);
    EXPECT_EQ(report.error().place, "/meshes/0/primitives/0/indices");
    EXPECT_EQ(report.error().message,
              "index 4 is 65535, but the primitive has only 10 vertices; glTF does not allow this value as a primitive "
              "restart index");
    EXPECT_EQ(folder.entryCount(), 1u);
}

TEST(GeometryStorage, TheLargestIndexIsAVertexIfItExists) {
    // glTF forbids the largest index (255 here). Some viewers restart the primitive at it, others draw it. tspace reads
    // it as an index, and writes wider indices when it splits vertices.
    const GenerateRun outcome = run(gridModel(Grid(15), kU8));
    EXPECT_EQ(outcome.report.primitives.at(0).vertices_before, 256u);
    EXPECT_EQ(readAccessor(outcome.after, *outcome.primitives[0].indices).component, gltf::ComponentType::u16);
}

TEST(GeometryStorage, TheSameGeometryInManyMeshesIsComputedOnceAndStaysShared) {
    GltfBuilder builder = gridModel(Grid(4));
    Json& meshes = builder.json()["meshes"];
    for (int i = 0; i < 3; ++i) meshes.push_back(Json(meshes[0]));
    builder.json()["nodes"] = Json::parse(R"([{"mesh":0},{"mesh":1},{"mesh":2},{"mesh":3},{"mesh":1}])");
    const GenerateRun outcome = run(builder);
    ASSERT_EQ(outcome.report.primitives.size(), 4u);
    EXPECT_EQ(outcome.after.json["accessors"].size(), 5u) << "one TANGENT for all, and no copies";
    for (std::size_t i = 1; i < 4; ++i) {
        EXPECT_EQ(outcome.after.json["meshes"][i], outcome.after.json["meshes"][0]);
        EXPECT_EQ(outcome.report.primitives[i].vertices_after, 30u);
    }
}

TEST(GeometryStorage, PiecesOfOneVertexArrayShareItsSplit) {
    // The left and the right half of the grid are two primitives, each with its own index list.
    const Grid grid(4);
    GltfBuilder builder = gridModel(grid);
    std::vector<std::uint16_t> halves[2];
    const std::vector<std::uint16_t> all = grid.indices<std::uint16_t>();
    for (std::size_t i = 0; i < all.size(); i += 6) {
        std::vector<std::uint16_t>& half = halves[i / 6 % 4 / 2];
        half.insert(half.end(), all.begin() + static_cast<std::ptrdiff_t>(i),
                    all.begin() + static_cast<std::ptrdiff_t>(i) + 6);
    }
    Json& primitives = builder.json()["meshes"][0]["primitives"];
    primitives.push_back(Json(primitives[0]));
    for (std::size_t i = 0; i < 2; ++i)
        primitives[i]["indices"] = builder.addAccessor(halves[i], kU16, "SCALAR", halves[i].size());
    const GenerateRun outcome = run(builder);
    EXPECT_EQ(outcome.primitives.at(0).attributes, outcome.primitives.at(1).attributes);
    EXPECT_EQ(outcome.report.primitives.at(0).vertices_after, 30u) << "the middle column belongs to both";
}

TEST(GeometryStorage, PrimitivesThatShareSomeAccessorsAreSeparatedOnlyIfNecessary) {
    // Two primitives share positions and normals but not UVs, which are mirrored for one primitive only.
    GltfBuilder builder = gridModel(Grid(4));
    const std::size_t straight = builder.addFloats(Grid(4, false).uvs, 2);
    Json& primitives = builder.json()["meshes"][0]["primitives"];
    primitives.push_back(Json(primitives[0]));
    primitives[1]["attributes"]["TEXCOORD_0"] = straight;
    const GenerateRun outcome = run(builder);
    EXPECT_EQ(outcome.report.primitives.at(0).vertices_after, 30u);
    EXPECT_EQ(outcome.report.primitives.at(1).vertices_after, 25u);
    EXPECT_EQ(outcome.primitives[1].find("POSITION"), 0u) << "the one without a split keeps what both had";
    EXPECT_NE(outcome.primitives[0].find("POSITION"), 0u);
    EXPECT_EQ(outcome.primitives[1].indices, 3u);
}

TEST(GeometryStorage, PrimitivesOfOneVertexArrayOnDifferentUvSetsGetTangentsOfTheirOwn) {
    GltfBuilder builder = gridModel(Grid(4, false));
    std::vector<float> turned;
    const Grid grid(4, false);
    for (std::size_t i = 0; i < grid.uvs.size(); i += 2) turned.insert(turned.end(), {grid.uvs[i + 1], grid.uvs[i]});
    firstPrimitive(builder)["attributes"]["TEXCOORD_1"] = builder.addFloats(turned, 2);
    builder.json()["materials"].push_back(Json::parse(R"({"normalTexture":{"index":0,"texCoord":1}})"));
    Json& primitives = builder.json()["meshes"][0]["primitives"];
    primitives.push_back(Json(primitives[0]));
    primitives[1]["material"] = 2;
    const GenerateRun outcome = run(builder);
    EXPECT_EQ(readTangents(outcome.after, outcome.primitives.at(0))[0], (Vec4{1, 0, 0, 1}));
    EXPECT_EQ(readTangents(outcome.after, outcome.primitives.at(1))[0], (Vec4{0, -1, 0, -1}));
    EXPECT_EQ(outcome.primitives[0].find("POSITION"), outcome.primitives[1].find("POSITION"));
}

TEST(GeometryStorage, SkinsGoAlongWithASplit) {
    const Grid grid(4);
    GltfBuilder builder = gridModel(grid);
    const std::size_t count = grid.vertexCount();
    std::vector<std::uint16_t> joints(count * 4);
    std::vector<std::uint8_t> weights(count * 4);
    for (std::size_t i = 0; i < joints.size(); ++i) {
        joints[i] = static_cast<std::uint16_t>(i % 3);
        weights[i] = static_cast<std::uint8_t>(i % 4 == 0 ? 255 : 0);
    }
    Json& attributes = firstPrimitive(builder)["attributes"];
    for (const char* set : {"0", "1"}) {
        attributes[std::string("JOINTS_") + set] = builder.addAccessor(joints, kU16, "VEC4", count);
        attributes[std::string("WEIGHTS_") + set] = builder.addAccessor(weights, kU8, "VEC4", count);
        builder.json()["accessors"].back()["normalized"] = true;
    }
    const std::size_t matrices = builder.addAccessor(std::vector<float>(48, 1.0f), 5126, "MAT4", 3);
    builder.json()["nodes"] = Json::parse(R"([{"mesh":0,"skin":0},{},{},{}])");
    builder.json()["skins"] = Json::array({Json{{"joints", {1, 2, 3}}, {"inverseBindMatrices", matrices}}});
    const GenerateRun outcome = run(builder);
    EXPECT_EQ(outcome.report.primitives.at(0).vertices_after, 30u);
    EXPECT_EQ(outcome.after.json["skins"], outcome.before.json["skins"]);
}

TEST(GeometryStorage, InstancesKeepTheirPositionsEvenIfSharedWithVertices) {
    // An instance of the mesh is at each of its own vertices, so both use the same accessor. Splitting vertices must
    // not change the instances.
    GltfBuilder builder = gridModel(Grid(4));
    builder.json()["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    builder.json()["nodes"] =
        Json::parse(R"([{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0}}}}])");
    const GenerateRun outcome = run(builder);
    EXPECT_EQ(outcome.after.json["nodes"], outcome.before.json["nodes"]);
    EXPECT_NE(outcome.primitives.at(0).find("POSITION"), 0u);
    EXPECT_EQ(readAccessor(outcome.after, 0).count, 25u);
    EXPECT_EQ(copyElements(outcome.after, readAccessor(outcome.after, 0)),
              copyElements(outcome.before, readAccessor(outcome.before, 0)));
}

TEST(GeometryStorage, NegativeNodeScaleChangesNothingInTheMesh) {
    GltfBuilder builder = gridModel(Grid(4));
    builder.json()["nodes"] = Json::parse(R"([{"mesh":0,"scale":[1,1,1]}])");
    const GenerateRun plain = run(builder);
    builder.json()["nodes"] = Json::parse(R"([{"mesh":0,"scale":[-1,1,1]}])");
    const GenerateRun mirrored = run(builder);
    EXPECT_EQ(readTangents(plain.after, plain.primitives.at(0)),
              readTangents(mirrored.after, mirrored.primitives.at(0)));
}

TEST(GeometryStorage, AccessorsWithoutAViewAreZeros) {
    for (const std::size_t accessor : {0, 1, 2}) {
        GltfBuilder builder = gridModel(Grid(4));
        builder.json()["accessors"][accessor].erase("bufferView");
        const GenerateRun outcome = run(builder);
        EXPECT_EQ(outcome.report.primitives.at(0).action, PrimitiveAction::generated) << accessor;
        expectUnitTangents(outcome);
    }
}

TEST(GeometryStorage, SparsePositionsAndUvsCountWithTheirReplacements) {
    GltfBuilder builder = gridModel(Grid(4, false));
    // Sparse values over dense ones exchange all u and v, so that the UV map is mirrored and rotated.
    const Grid grid(4, false);
    std::vector<float> swapped;
    std::vector<std::uint8_t> places;
    for (std::size_t i = 0; i < grid.uvs.size(); i += 2) {
        swapped.insert(swapped.end(), {grid.uvs[i + 1], grid.uvs[i]});
        places.push_back(static_cast<std::uint8_t>(i / 2));
    }
    const std::size_t indices = builder.addView(bytesOfValues(places)),
                      values = builder.addView(bytesOfValues(swapped));
    builder.json()["accessors"][2]["sparse"] = {{"count", places.size()},
                                                {"indices", {{"bufferView", indices}, {"componentType", kU8}}},
                                                {"values", {{"bufferView", values}}}};
    const GenerateRun outcome = run(builder);
    for (const Vec4& tangent : readTangents(outcome.after, outcome.primitives.at(0)))
        EXPECT_EQ(tangent, (Vec4{0, -1, 0, -1}));
    EXPECT_TRUE(outcome.after.json["accessors"][2].contains("sparse")) << "nothing was split, so it stays";
}

TEST(GeometryStorage, SparseAttributesAreSplitWithTheirReplacements) {
    GltfBuilder builder = gridModel(Grid(4));
    builder.json()["accessors"][1]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", builder.addView(bytesOfValues<std::uint8_t>({2}))}, {"componentType", kU8}}},
        {"values", {{"bufferView", builder.addView(bytesOfValues<float>({0.6f, 0, 0.8f}))}}}};
    const GenerateRun outcome = run(builder);
    EXPECT_EQ(outcome.report.primitives.at(0).vertices_after, 30u);
    EXPECT_EQ(readVec3(outcome.after, outcome.primitives[0], "NORMAL")[2], (Vec3{0.6f, 0, 0.8f}));
    EXPECT_FALSE(outcome.after.json["accessors"][1].contains("sparse"));
}

TEST(GeometryStorage, VerticesThatNoTriangleUsesGetUnitTangentsToo) {
    GltfBuilder builder = gridModel(Grid(4, false));
    firstPrimitive(builder)["indices"] = builder.addAccessor<std::uint8_t>({0, 1, 6}, kU8, "SCALAR", 3);
    expectUnitTangents(run(builder));
}

}  // namespace
}  // namespace tspace
