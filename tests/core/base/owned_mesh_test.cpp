// SPDX-License-Identifier: MIT
#include "core/base/owned_mesh.h"

#include <gtest/gtest.h>

namespace tspace {
namespace {

TEST(OwnedMesh, ItsViewIsUnchanged) {
    const OwnedMesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                         .normals = {4, Vec3{0, 0, 1}},
                         .uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                         .indices = {3, 2, 1, 0},
                         .face_sizes = {4}};
    const MeshView view = mesh.view();
    EXPECT_TRUE(validate(view).ok());
    EXPECT_EQ(view.positions.data, mesh.positions.data());
    EXPECT_EQ(view.normals.data, mesh.normals.data());
    EXPECT_EQ(view.uvs.data, mesh.uvs.data());
    EXPECT_EQ(view.indices[0], 3u);
    EXPECT_EQ(view.cornerCount(), 4u);
    EXPECT_EQ(view.faceCount(), 1u);
}

TEST(OwnedMesh, HasAVertexPerCornerWithoutIndicesAndTrianglesWithoutSizes) {
    const OwnedMesh mesh{.positions = std::vector<Vec3>(6)};
    EXPECT_TRUE(validate(mesh.view()).ok());
    EXPECT_EQ(mesh.view().cornerCount(), 6u);
    EXPECT_EQ(mesh.view().faceCount(), 2u);
    EXPECT_EQ(mesh.view().indices[4], 4u);
    EXPECT_TRUE(OwnedMesh{}.view().normals.empty());
}

TEST(OwnedMesh, TakesOverVerticesInTheArraysThatTheOtherHas) {
    const OwnedMesh other{.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, .uvs = {{0, 0}, {1, 0}, {2, 0}}};
    OwnedMesh mesh{.positions = {{7, 0, 0}}, .uvs = {{7, 0}}};
    mesh.addVertices(other, 1, 2);
    EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{7, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
    EXPECT_EQ(mesh.uvs, (std::vector<Vec2>{{7, 0}, {1, 0}, {2, 0}}));
    EXPECT_TRUE(mesh.normals.empty() && mesh.tangents.empty());
}

}  // namespace
}  // namespace tspace
