// SPDX-License-Identifier: MIT
// Geometry that inspectFile reports.
#include <gtest/gtest.h>

#include <algorithm>

#include "commands/inspect/inspect.h"
#include "support/shared_data.h"
#include "support/temp_folder.h"
#include "tspace/inspect.h"

namespace tspace::test {
namespace {

/// A square of two triangles with UVs.
struct Square {
    std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    std::vector<Vec2> uvs{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    std::vector<std::uint32_t> corners{0, 1, 2, 0, 2, 3};
};

PrimitiveInfo describe(const Square& square, bool v_runs_down = false) {
    PrimitiveInfo info;
    describeUvMap(square.corners, square.positions, square.uvs, v_runs_down, info);
    return info;
}

TEST(UvMap, TrianglesThatShareAnEdgeAreOneIsland) {
    const PrimitiveInfo info = describe({});
    EXPECT_EQ(info.uv_island_count, 1U);
    EXPECT_EQ(info.mirrored_island_count, 0U);
    EXPECT_EQ(info.mirrored_triangle_count, 0U);
    EXPECT_EQ(info.degenerate_uv_count, 0U);
}

TEST(UvMap, MirroredIsVisuallyMirroredForAnyVAxis) {
    Square square;
    EXPECT_EQ(describe(square, true).mirrored_island_count, 1U);
    for (Vec2& uv : square.uvs) uv.x = -uv.x;
    EXPECT_EQ(describe(square, false).mirrored_island_count, 1U);
    EXPECT_EQ(describe(square, false).mirrored_triangle_count, 2U);
    EXPECT_EQ(describe(square, true).mirrored_island_count, 0U);
}

TEST(UvMap, IslandsDoNotDependOnHowVerticesAreIndexed) {
    Square square;
    Square unindexed;
    unindexed.positions.clear();
    unindexed.uvs.clear();
    for (std::size_t i = 0; i < square.corners.size(); ++i) {
        unindexed.positions.push_back(square.positions[square.corners[i]]);
        unindexed.uvs.push_back(square.uvs[square.corners[i]]);
        unindexed.corners[i] = static_cast<std::uint32_t>(i);
    }
    EXPECT_EQ(describe(unindexed).uv_island_count, 1U);
    unindexed.uvs[3].x = -0.0f;
    EXPECT_EQ(describe(unindexed).uv_island_count, 1U) << "minus zero is zero";
}

TEST(UvMap, ASeamInPositionOrInUvSeparatesIslands) {
    Square square;
    square.positions.push_back(square.positions[2]);
    square.uvs.push_back({0.5f, 0.5f});
    square.corners = {0, 1, 2, 0, 4, 3};
    EXPECT_EQ(describe(square).uv_island_count, 2U);
    square.uvs.back() = square.uvs[2];
    EXPECT_EQ(describe(square).uv_island_count, 1U);
    square.positions.back().z = 1;
    EXPECT_EQ(describe(square).uv_island_count, 2U);
}

TEST(UvMap, DegenerateTrianglesAreCounted) {
    Square square;
    square.uvs[1] = square.uvs[0];
    EXPECT_EQ(describe(square).degenerate_uv_count, 1U);
    square.positions[3] = square.positions[2];
    EXPECT_EQ(describe(square).degenerate_triangle_count, 1U);
    square.uvs[2].x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(describe(square).degenerate_uv_count, 2U);
    square.uvs.clear();
    EXPECT_EQ(describe(square).uv_island_count, 0U);
}

TEST(UvMap, AnIslandIsMirroredWhenMostOfItsAreaIs) {
    // A strip whose second square is mirrored in UV space, so that it covers the first one; it is also larger.
    Square square;
    square.positions.insert(square.positions.end(), {{3, 0, 0}, {3, 1, 0}});
    square.uvs.insert(square.uvs.end(), {{-2, 0}, {-2, 1}});
    square.corners.insert(square.corners.end(), {1, 4, 5, 1, 5, 2});
    const PrimitiveInfo info = describe(square);
    EXPECT_EQ(info.uv_island_count, 1U);
    EXPECT_EQ(info.mirrored_triangle_count, 2U);
    EXPECT_EQ(info.mirrored_island_count, 1U);
}

TEST(InspectFile, CountsShapesMaterialsAndImagesOfAnObj) {
    const TempFolder folder;
    folder.write("m.mtl", "newmtl a\nmap_Kd c.png\nnorm n.png\nnewmtl unused\n");
    const std::string file = folder.write("a.obj",
                                          "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
                                          "vt 0 1\no one\nusemtl a\nf 1/1 2/2 3/3 4/4\no two\nf 1 2 3\n");
    Result<Inspection> result = inspectFile(file);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->format, "obj");
    EXPECT_EQ(result->mesh_count, 2U);
    EXPECT_EQ(result->material_count, 1U);
    EXPECT_EQ(result->image_count, 2U);
    ASSERT_EQ(result->primitives.size(), 2U);
    EXPECT_EQ(result->primitives[0].mode, "polygons");
    EXPECT_EQ(result->primitives[0].triangle_count, 2U);
    EXPECT_TRUE(result->primitives[0].needs_tangents);
    EXPECT_EQ(result->primitives[0].uv_set, 0);
    EXPECT_EQ(result->primitives[0].mirrored_triangle_count, 0U);
    EXPECT_EQ(result->primitives[1].uv_set, -1);
    EXPECT_FALSE(result->primitives[1].has_normals);
}

TEST(InspectFile, ReadsAKnownModel) {
    TSPACE_NEEDS_SHARED("models/khronos/NormalTangentTest.glb");
    Result<Inspection> result = inspectFile(shared("models/khronos/NormalTangentTest.glb").string());
    ASSERT_TRUE(result) << result.error().message;
    ASSERT_EQ(result->primitives.size(), 1U);
    const PrimitiveInfo& primitive = result->primitives[0];
    EXPECT_EQ(primitive.triangle_count, 7774U);
    EXPECT_EQ(primitive.vertex_count, 3983U);
    EXPECT_EQ(primitive.needed_by, "normalTexture");
    EXPECT_FALSE(primitive.has_tangents);
    EXPECT_EQ(primitive.index_type, "u16");
}

TEST(InspectFile, ReadsOrRefusesEverySharedFile) {
    TSPACE_NEEDS_SHARED("bad");
    for (const char* folder : {"bad", "models"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(shared(folder))) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".glb" && extension != ".gltf" && extension != ".obj") continue;
            Result<Inspection> result = inspectFile(entry.path().string());
            if (result) continue;
            const Error& error = result.error();
            EXPECT_TRUE(error.code == ErrorCode::invalidFile || error.code == ErrorCode::unsupportedFile ||
                        error.code == ErrorCode::forbiddenPath || error.code == ErrorCode::cannotRead)
                << entry.path() << ": " << errorName(error.code) << " " << error.message;
            EXPECT_FALSE(error.message.empty());
            EXPECT_EQ(error.message.find('\n'), std::string::npos) << entry.path();
        }
    }
}

}  // namespace
}  // namespace tspace::test
