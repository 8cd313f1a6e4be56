// SPDX-License-Identifier: MIT
// Pairing triangles restores the quads from which they were cut, corner by corner.
#include "core/mesh/quads/quads.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/mesh/quads/quad_meshes.h"

namespace tspace::test {
namespace {

QuadFaces facesByShape(const ModelData& data) {
    const MeshView mesh = viewOf(data);
    const QuadCandidates candidates(mesh);
    return facesOfPairs(candidates, pairsByShape(mesh, candidates));
}

/// Checks that every corner of a triangle maps to a corner of a face with the same vertex.
void expectSameVertices(const QuadFaces& faces, const ModelData& data) {
    ASSERT_EQ(faces.face_corners.size(), data.indices.size());
    for (std::size_t c = 0; c < data.indices.size(); ++c) {
        const std::uint32_t a = data.indices[c], b = data.indices[faces.corners[faces.face_corners[c]]];
        ASSERT_EQ(data.positions[a], data.positions[b]) << c;
        ASSERT_EQ(data.uvs[a], data.uvs[b]) << c;
    }
}

TEST(QuadPairs, AreFoundForAnyExportOrder) {
    const PolygonMesh mesh = hills(7);
    for (const Cut& cut : kCuts) {
        for (const bool is_welded : {true, false}) {
            const ModelData data = is_welded ? trianglesOf(mesh, cut) : unwelded(trianglesOf(mesh, cut));
            const QuadFaces faces = facesByShape(data);
            EXPECT_EQ(faces.quad_count, mesh.sizes.size());
            EXPECT_EQ(faces.sizes, mesh.sizes);
            expectSameVertices(faces, data);
        }
    }
}

TEST(QuadPairs, OfRealTrianglesBetweenQuadsAreNone) {
    for (const int every : {2, 3, 7}) {
        const PolygonMesh mesh = hills(8, every);
        const ModelData data = trianglesOf(mesh, kFan);
        const QuadFaces faces = facesByShape(data);
        expectSameVertices(faces, data);
        // A half of a quad also looks like a quad with a neighboring triangle, but must be paired only with the other
        // half.
        std::size_t triangle = 0;
        for (const std::uint32_t size : faces.sizes) {
            EXPECT_TRUE(size == 3 || triangle % 2 == 0);
            triangle += size - 2;
        }
    }
}

TEST(QuadPairs, BeginWithAnEndOfTheDiagonalOrTurnedWithAnother) {
    const ModelData data = trianglesOf(hills(1), kFan);
    const QuadCandidates candidates(viewOf(data));
    std::uint32_t quad[4];
    candidates.cornersOf(0, false, quad);
    EXPECT_EQ((std::vector<std::uint32_t>(quad, quad + 4)), (std::vector<std::uint32_t>{0, 1, 2, 5}));
    candidates.cornersOf(0, true, quad);
    EXPECT_EQ((std::vector<std::uint32_t>(quad, quad + 4)), (std::vector<std::uint32_t>{1, 2, 5, 0}));
}

TEST(QuadPairs, NeedEqualNormalsUvsAndTangentsAlongTheEdge) {
    ModelData data = unwelded(trianglesOf(hills(1), kFan));
    EXPECT_EQ(QuadCandidates(viewOf(data)).count(), 1U);
    ModelData other = data;
    other.uvs[3].x += 0.5F;
    EXPECT_EQ(QuadCandidates(viewOf(other)).count(), 0U);
    other = data;
    other.normals[4] = {0, 1, 0};
    EXPECT_EQ(QuadCandidates(viewOf(other)).count(), 0U);
    std::vector<Vec4> tangents(6, Vec4{1, 0, 0, 1});
    EXPECT_EQ(QuadCandidates(viewOf(data), tangents).count(), 1U);
    tangents[3].w = -1;
    EXPECT_EQ(QuadCandidates(viewOf(data), tangents).count(), 0U);
}

TEST(QuadPairs, AreNeitherFoldedNorTheSameTriangleTwice) {
    ModelData data;
    data.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.6F, 0.1F, 0.01F}};
    data.normals.resize(4, Vec3{0, 0, 1});
    data.uvs.resize(4);
    data.indices = {0, 1, 2, 0, 2, 3};
    EXPECT_EQ(QuadCandidates(viewOf(data)).count(), 0U);
    data.indices = {0, 1, 2, 2, 1, 0};
    EXPECT_EQ(QuadCandidates(viewOf(data)).count(), 0U);
}

TEST(QuadPairs, OfOneRunMaximizeTheGain) {
    // A strip of five triangles: each of the four pairs of adjacent triangles is a candidate.
    ModelData data;
    for (int i = 0; i < 7; ++i) data.positions.push_back({static_cast<float>(i) / 2, static_cast<float>(i % 2), 0});
    data.normals.resize(7, Vec3{0, 0, 1});
    data.uvs.resize(7);
    for (std::uint32_t t = 0; t < 5; ++t)
        for (const std::uint32_t k : {0U, 1U + t % 2, 2U - t % 2}) data.indices.push_back(t + k);
    const QuadCandidates candidates(viewOf(data));
    ASSERT_EQ(candidates.count(), 4U);
    const auto chosen = [&](const std::vector<float>& gains) {
        std::vector<std::size_t> pairs;
        const QuadPairs kinds = choosePairs(candidates, gains);
        for (std::size_t t = 0; t < kinds.size(); ++t) {
            if (kinds[t] != PairKind::none) pairs.push_back(t);
        }
        return pairs;
    };
    using Pairs = std::vector<std::size_t>;
    EXPECT_EQ(chosen({1, 1, 1, 1, 0}), (Pairs{0, 2}));
    EXPECT_EQ(chosen({1, 3, 1, 1, 0}), (Pairs{1, 3}));
    EXPECT_EQ(chosen({1, 5, 1, -1, 0}), (Pairs{1}));
    EXPECT_EQ(chosen({-1, 0, -1, 0, 0}), Pairs{});
}

RC_GTEST_PROP(QuadPairs, CoverEveryTriangleOnceWhateverTheMeshIs, ()) {
    const auto vertex_count = *rc::gen::inRange<std::uint32_t>(1, 9);
    ModelData data;
    for (std::uint32_t v = 0; v < vertex_count; ++v) {
        const auto any = [] { return static_cast<float>(*rc::gen::inRange(-1, 2)); };
        data.positions.push_back({any(), any(), any()});
        data.normals.push_back({any(), any(), any()});
        data.uvs.push_back({any(), any()});
    }
    const auto triangles = *rc::gen::inRange<std::size_t>(0, 20);
    data.indices = *rc::gen::container<std::vector<std::uint32_t>>(3 * triangles,
                                                                   rc::gen::inRange<std::uint32_t>(0, vertex_count));
    const MeshView mesh = viewOf(data);
    const QuadCandidates candidates(mesh);
    QuadPairs pairs = pairsByShape(mesh, candidates);
    for (PairKind& kind : pairs) {
        if (kind != PairKind::none && *rc::gen::arbitrary<bool>()) kind = PairKind::turned;
    }
    const QuadFaces faces = facesOfPairs(candidates, pairs);
    std::size_t corner_count = 0, covered = 0;
    for (const std::uint32_t size : faces.sizes) {
        RC_ASSERT(size == 3 || size == 4);
        corner_count += size;
        covered += size - 2;
    }
    RC_ASSERT(covered == triangles);
    RC_ASSERT(faces.corners.size() == corner_count);
    RC_ASSERT(faces.face_corners.size() == data.indices.size());
    for (std::size_t c = 0; c < data.indices.size(); ++c) {
        const std::uint32_t a = data.indices[c], b = data.indices[faces.corners[faces.face_corners[c]]];
        RC_ASSERT(a == b || (data.positions[a] == data.positions[b] && data.uvs[a] == data.uvs[b]));
    }
}

TEST(QuadPairs, PolygonsOfAFileAreFacesOverTheirOwnTriangles) {
    PolygonMesh mesh = hills(2);
    mesh.corners = {0, 1, 4, 3, 1, 2, 1, 2, 5, 4, 3, 4, 5, 8, 7, 6, 3};
    mesh.sizes = {4, 2, 4, 7};
    const Result<Triangulation> cut = triangulate(mesh.view());
    ASSERT_TRUE(cut.ok());
    const QuadFaces faces = facesOfPolygons(mesh.sizes, *cut);
    EXPECT_EQ(faces.sizes, (std::vector<std::uint32_t>{4, 4, 7}));
    EXPECT_EQ(faces.quad_count, 3U);
    ASSERT_EQ(faces.face_corners.size(), cut->corners.size());
    for (std::size_t c = 0; c < cut->corners.size(); ++c) {
        const std::uint32_t again = cut->corners[faces.corners[faces.face_corners[c]]];
        EXPECT_EQ(mesh.corners[again], mesh.corners[cut->corners[c]]);
    }
}

}  // namespace
}  // namespace tspace::test
