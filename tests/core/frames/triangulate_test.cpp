// SPDX-License-Identifier: MIT
#include "tspace/mesh.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

namespace tspace {
namespace {

using Numbers = std::vector<std::uint32_t>;

TEST(Triangulate, KeepsTriangles) {
    const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    const Numbers indices{0, 1, 2, 2, 1, 3};
    MeshView mesh;
    mesh.positions = positions;
    mesh.indices = IndexView(std::span<const std::uint32_t>(indices));
    const Result<Triangulation> result = triangulate(mesh);
    ASSERT_TRUE(result.ok());
    EXPECT_EQ(result->corners, (Numbers{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(result->faces, (Numbers{0, 1}));
}

TEST(Triangulate, SkipsFacesWithoutAnAreaAndNamesTheFaceOfEachTriangle) {
    const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}};
    const Numbers sizes{2, 4, 0, 1, 3};
    const Numbers indices{0, 1, 0, 1, 2, 3, 4, 1, 4, 2};
    MeshView mesh;
    mesh.positions = positions;
    mesh.indices = IndexView(std::span<const std::uint32_t>(indices));
    mesh.face_sizes = sizes;
    const Result<Triangulation> result = triangulate(mesh);
    ASSERT_TRUE(result.ok());
    EXPECT_EQ(result->corners, (Numbers{2, 3, 4, 2, 4, 5, 7, 8, 9}));
    EXPECT_EQ(result->faces, (Numbers{1, 1, 4}));
}

TEST(Triangulate, SplitsQuadsByTheirUvs) {
    const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const std::vector<Vec2> uvs{{0, 0}, {0.5f, 0.4f}, {1, 1}, {0.5f, 0.6f}};
    MeshView mesh;
    mesh.positions = positions;
    mesh.face_size = 4;
    EXPECT_EQ(triangulate(mesh)->corners, (Numbers{0, 1, 2, 0, 2, 3}));
    mesh.uvs = uvs;
    EXPECT_EQ(triangulate(mesh)->corners, (Numbers{0, 1, 3, 1, 2, 3}));
}

TEST(Triangulate, RejectsAnInvalidMesh) {
    const std::vector<Vec3> positions(4);
    MeshView mesh;
    mesh.positions = positions;
    EXPECT_EQ(triangulate(mesh).error().code, ErrorCode::countMismatch);
}

RC_GTEST_PROP(Triangulate, CoversEachFaceOfAMixedMesh, ()) {
    const Numbers sizes = *rc::gen::container<Numbers>(rc::gen::inRange<std::uint32_t>(0, 9));
    std::vector<Vec3> positions;
    for (const std::uint32_t size : sizes) {
        for (std::uint32_t k = 0; k < size; ++k) {
            const double angle = 2 * 3.14159265358979 * k / size;
            positions.push_back({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0});
        }
    }
    MeshView mesh;
    mesh.positions = positions;
    mesh.face_sizes = sizes;
    const Result<Triangulation> result = triangulate(mesh);
    RC_ASSERT(result.ok());
    std::vector<double> areas(sizes.size(), 0.0);
    for (std::size_t t = 0; t < result->faces.size(); ++t) {
        const Vec3& a = positions[result->corners[3 * t]];
        const Vec3& b = positions[result->corners[3 * t + 1]];
        const Vec3& c = positions[result->corners[3 * t + 2]];
        const double area = 0.5 * (double{b.x - a.x} * (c.y - a.y) - double{b.y - a.y} * (c.x - a.x));
        RC_ASSERT(area > 0);
        areas[result->faces[t]] += area;
        if (t > 0) RC_ASSERT(result->faces[t - 1] <= result->faces[t]);
    }
    for (std::size_t f = 0; f < sizes.size(); ++f) {
        const double n = sizes[f];
        const double regular = sizes[f] < 3 ? 0 : 0.5 * n * std::sin(2 * 3.14159265358979 / n);
        RC_ASSERT(std::abs(areas[f] - regular) < 1e-5);
    }
}

}  // namespace
}  // namespace tspace
