// SPDX-License-Identifier: MIT
// Frames computed on quads: the corners of the triangles get the tangents that mikktspace gives to the polygons.
#include <gtest/gtest.h>

#include "core/base/vec_math.h"
#include "core/mesh/pools/pools.h"
#include "core/mesh/quads/quad_meshes.h"

namespace tspace {
namespace {

using namespace test;

OwnedMesh poolOf(const ModelData& data) {
    return {.positions = data.positions, .normals = data.normals, .uvs = data.uvs};
}

FramesOptions onFaces(Faces faces) {
    FramesOptions options;
    options.faces = faces;
    return options;
}

/// Returns the tangents of all corners of the triangles.
std::vector<Vec4> atCorners(const PoolFrames& frames) {
    std::vector<Vec4> tangents;
    for (const std::uint32_t v : frames.indices[0]) tangents.push_back(frames.tangents[v]);
    return tangents;
}

/// Cuts polygons into triangles, recomputes tangents, and returns the share of corners that get the tangents of the
/// polygons.
double shareLikePolygons(const PolygonMesh& mesh, const Cut& cut, Faces faces) {
    const FramesOptions options = onFaces(faces);
    std::vector<Vec4> on_polygons(mesh.corners.size()), old_tangents;
    EXPECT_TRUE(generateTangents(mesh.view(), options.tangents, {.tangents = std::span(on_polygons)}));
    for (const std::uint32_t corner : cutQuads(mesh, cut)) old_tangents.push_back(on_polygons[corner]);
    const ModelData data = unwelded(trianglesOf(mesh, cut));
    const OwnedMesh pool = poolOf(data);
    PoolView view(pool);
    view.old_tangents = old_tangents;
    const PrimitiveGeometry geometry{.indices = data.indices};
    FramesReport report;
    const Result<PoolFrames> frames = computeFrames(view, {&geometry, 1}, options, {&report, 1});
    EXPECT_TRUE(frames.ok());
    EXPECT_EQ(report.faces, Faces::quads);
    EXPECT_GT(report.quad_count, 0U);
    std::size_t near = 0;
    const std::vector<Vec4> tangents = atCorners(*frames);
    for (std::size_t c = 0; c < tangents.size(); ++c)
        near += dot(xyz(tangents[c]), xyz(old_tangents[c])) > 0.9998F && tangents[c].w == old_tangents[c].w;
    return static_cast<double>(near) / static_cast<double>(tangents.size());
}

TEST(Faces, QuadsGiveTheTangentsOfThePolygons) {
    for (const Faces faces : {Faces::quads, Faces::automatic}) {
        for (const Cut& cut : {kFan, kOtherFan, kCuts[2]}) EXPECT_EQ(shareLikePolygons(hills(9), cut, faces), 1);
        for (const Cut& cut : {kFan, kCuts[2]}) EXPECT_GE(shareLikePolygons(hills(9, 4), cut, faces), 0.99);
    }
}

TEST(Faces, OfTheirOwnAccordAreTriangles) {
    const ModelData data = trianglesOf(hills(9), kFan);
    const PrimitiveGeometry geometry{.indices = data.indices};
    const PoolOutcome plain = compute(poolOf(data), {geometry}, FramesOptions{});
    const PoolOutcome automatic = compute(poolOf(data), {geometry}, onFaces(Faces::automatic));
    EXPECT_EQ(plain.reports[0].faces, Faces::triangles);
    EXPECT_EQ(plain.reports[0].quad_count, 0U);
    EXPECT_EQ(automatic.reports[0].faces, Faces::triangles);
    EXPECT_TRUE(sameBits(plain.frames.tangents, automatic.frames.tangents));
    const PoolOutcome quads = compute(poolOf(data), {geometry}, onFaces(Faces::quads));
    EXPECT_EQ(quads.reports[0].faces, Faces::quads);
    EXPECT_EQ(quads.reports[0].quad_count, 81U);
    EXPECT_EQ(quads.reports[0].triangle_count, 162U);
    EXPECT_FALSE(sameBits(plain.frames.tangents, quads.frames.tangents));
    FramesOptions other = onFaces(Faces::quads);
    other.tangents.method = Method::area;
    EXPECT_EQ(compute(poolOf(data), {geometry}, other).reports[0].faces, Faces::triangles);
}

TEST(Faces, PolygonsOfAFileAreQuadsAsTheyAre) {
    const PolygonMesh mesh = hills(5, 3);
    const PrimitiveGeometry geometry{.indices = mesh.corners, .face_sizes = mesh.sizes};
    const PoolOutcome quads = compute(poolOf(mesh.data), {geometry}, onFaces(Faces::quads));
    const auto count = static_cast<std::uint64_t>(std::count(mesh.sizes.begin(), mesh.sizes.end(), 4U));
    EXPECT_EQ(quads.reports[0].quad_count, count);
    // The quads are cut by MikkTSpace's own rule, so the triangles give the same result here, except for the last bits
    // of sums.
    const std::vector<Vec4> a = atCorners(compute(poolOf(mesh.data), {geometry}, FramesOptions{}).frames),
                            b = atCorners(quads.frames);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t c = 0; c < a.size(); ++c) EXPECT_GT(dot(xyz(a[c]), xyz(b[c])), 0.999999F);
}

TEST(Faces, MorphTargetsTakeTheQuadsOfTheirBase) {
    const ModelData data = trianglesOf(hills(9), kFan);
    ModelData moved = data;
    std::vector<Vec3> offsets, turns;
    for (const Vec3& position : data.positions) {
        offsets.push_back({0, 0, 0.2F * position.x * position.y});
        turns.push_back({-0.2F * position.y, -0.2F * position.x, 0});
    }
    const OwnedMesh mesh = poolOf(data);
    PoolView pool(mesh);
    pool.targets = {
        1, [&](std::size_t) -> Result<MorphOffsets> { return MorphOffsets{.positions = offsets, .normals = turns}; }};
    const PrimitiveGeometry geometry{.indices = data.indices};
    const PoolOutcome morphed = compute(pool, {geometry}, onFaces(Faces::quads));
    ASSERT_EQ(morphed.frames.morphs.size(), 1U);
    // Expected result: the frames of the displaced shape, with quads detected on it.
    for (std::size_t v = 0; v < moved.positions.size(); ++v) {
        moved.positions[v] = moved.positions[v] + offsets[v];
        const Vec3 n = moved.normals[v] + turns[v];
        moved.normals[v] = (1 / length(n)) * n;
    }
    const PoolOutcome own = compute(poolOf(moved), {geometry}, onFaces(Faces::quads));
    const VertexOffsets& deltas = morphed.frames.morphs[0].tangents;
    std::vector<Vec3> sums(morphed.frames.tangents.size());
    for (std::size_t v = 0; v < sums.size(); ++v) sums[v] = xyz(morphed.frames.tangents[v]);
    for (std::size_t i = 0; i < deltas.vertices.size(); ++i)
        sums[deltas.vertices[i]] = sums[deltas.vertices[i]] + deltas.offsets[i];
    std::size_t near = 0;
    for (std::size_t c = 0; c < data.indices.size(); ++c) {
        near += dot(sums[morphed.frames.indices[0][c]], xyz(own.frames.tangents[own.frames.indices[0][c]])) > 0.9999F;
    }
    EXPECT_GE(near * 100, data.indices.size() * 99);
}

TEST(Faces, ChangeNothingWithTheNumberOfThreads) {
    const ModelData data = trianglesOf(hills(60), kFan);
    const PrimitiveGeometry geometry{.indices = data.indices};
    FramesOptions options = onFaces(Faces::quads);
    options.execution.thread_count = 1;
    const PoolOutcome one = compute(poolOf(data), {geometry}, options);
    options.execution.thread_count = 4;
    EXPECT_TRUE(sameBits(one.frames.tangents, compute(poolOf(data), {geometry}, options).frames.tangents));
}

}  // namespace
}  // namespace tspace
