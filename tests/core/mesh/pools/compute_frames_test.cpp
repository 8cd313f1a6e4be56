// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <ctime>

#include "core/base/vec_math.h"
#include "core/mesh/pools/pools.h"

namespace tspace {
namespace {

using namespace test;

RC_GTEST_PROP(ComputeFrames, ReproducesItselfOnItsOwnOutput, ()) {
    const OwnedMesh pool = anyPool();
    const std::vector<PrimitiveGeometry> primitives = anyFaces(pool);
    const FramesOptions options = anyOptions();
    const PoolOutcome first = compute(pool, primitives, options);
    const OwnedMesh written = rebuilt(pool, first.frames);
    const PoolOutcome second = compute(written, rebuilt(first.frames), options);
    RC_ASSERT(!second.frames.wasSplit(written.positions.size()));
    RC_ASSERT(second.frames.indices == first.frames.indices);
    RC_ASSERT(sameBits(second.frames.tangents, first.frames.tangents));
    RC_ASSERT(sameBits(second.frames.bitangents, first.frames.bitangents));
}

RC_GTEST_PROP(ComputeFrames, WritesOnlyUnitBitangentsOnTheSideOfTheSign, ()) {
    const OwnedMesh pool = anyPool();
    FramesOptions options = anyOptions();
    options.sanitize = options.bitangents = true;
    const PoolFrames frames = compute(pool, anyTriangles(pool), options).frames;
    RC_ASSERT(frames.bitangents.size() == frames.tangents.size());
    const std::vector<Vec3> normals = rebuilt(pool, frames).normals;
    for (std::size_t v = 0; v < frames.tangents.size(); ++v) {
        const DVec3 b = toDouble(frames.bitangents[v]), t = toDouble(xyz(frames.tangents[v])), n = toDouble(normals[v]);
        RC_ASSERT(std::abs(length(b) - 1) <= 5e-4);
        if (!(dot(n, n) > 0) || !std::isfinite(dot(n, n))) continue;
        RC_ASSERT(double{frames.tangents[v].w} * dot(cross(n, t), b) > 0);
    }
}

RC_GTEST_PROP(ComputeFrames, WritesOnlyUnitTangentsWithOneSignPerFace, ()) {
    const OwnedMesh pool = anyPool();
    FramesOptions options = anyOptions();
    options.tangents.method = *rc::gen::element(options.tangents.method, Method::lengyel);
    options.sanitize = true;
    const PoolOutcome result = compute(pool, anyTriangles(pool), options);
    for (const Vec4& t : result.frames.tangents) {
        const double length = std::sqrt(double{t.x} * t.x + double{t.y} * t.y + double{t.z} * t.z);
        RC_ASSERT(std::abs(length - 1) <= 5e-4);
        RC_ASSERT(t.w == 1.0f || t.w == -1.0f);
    }
    for (const Indices& corners : result.frames.indices) {
        for (std::size_t c = 0; c < corners.size(); ++c) {
            RC_ASSERT(result.frames.tangents[corners[c]].w == result.frames.tangents[corners[c - c % 3]].w);
        }
    }
}

RC_GTEST_PROP(ComputeFrames, KeepsCornersAtTheirVerticesAndAppendsCopies, ()) {
    const OwnedMesh pool = anyPool();
    const std::vector<PrimitiveGeometry> primitives = anyTriangles(pool);
    const PoolOutcome result = compute(pool, primitives, anyOptions());
    for (std::size_t v = 0; v < pool.positions.size(); ++v) RC_ASSERT(result.frames.source_vertices[v] == v);
    for (std::size_t p = 0; p < primitives.size(); ++p) {
        Indices sources;
        for (const std::uint32_t v : result.frames.indices[p]) sources.push_back(result.frames.source_vertices[v]);
        RC_ASSERT(sources == primitives[p].indices);
        RC_ASSERT(result.reports[p].triangle_count == primitives[p].indices.size() / 3);
        RC_ASSERT(result.reports[p].vertices_before == pool.positions.size());
        RC_ASSERT(result.reports[p].vertices_after == result.frames.source_vertices.size());
    }
}

RC_GTEST_PROP(ComputeFrames, ComputesEachPrimitiveSeparately, ()) {
    const OwnedMesh pool = anyPool();
    const std::vector<PrimitiveGeometry> primitives = anyTriangles(pool);
    const FramesOptions options = anyOptions();
    // With NaN and huge values, results may depend on the other primitives of the pool.
    RC_PRE(isOrdinary(pool));
    const PoolOutcome together = compute(pool, primitives, options);
    for (std::size_t p = 0; p < primitives.size(); ++p) {
        const PoolOutcome alone = compute(pool, {primitives[p]}, options);
        for (std::size_t c = 0; c < primitives[p].indices.size(); ++c) {
            const Vec4& a = together.frames.tangents[together.frames.indices[p][c]];
            const Vec4& b = alone.frames.tangents[alone.frames.indices[0][c]];
            RC_ASSERT(std::memcmp(&a, &b, sizeof a) == 0);
        }
    }
}

TEST(ComputeFrames, StoresTheSignOfTheConvention) {
    const std::vector<PrimitiveGeometry> primitives{{.indices = {0, 1, 2, 2, 1, 3}}};
    for (const Method method : {Method::mikktspace, Method::lengyel, Method::flat, Method::angle}) {
        const PoolOutcome result = compute(square(), primitives, withMethod(method));
        EXPECT_FALSE(result.frames.wasSplit(4));
        EXPECT_EQ(result.frames.indices[0], (Indices{0, 1, 2, 2, 1, 3}));
        // v points up in the pool; glTF interprets it as pointing down.
        for (const Vec4& t : result.frames.tangents) EXPECT_EQ(t, (Vec4{1, 0, 0, -1}));
    }
}

TEST(ComputeFrames, MakesTangentsOrthogonalIfUvsHaveNoArea) {
    OwnedMesh pool = square();
    const Vec3 tilted{0.8f, 0, 0.6f};
    for (const float x : {5.0f, 6.0f, 7.0f}) {
        pool.positions.push_back({x, x * x, 0});
        pool.normals.push_back(tilted);
        pool.uvs.push_back({0.5f, 0.5f});
    }
    const std::vector<PrimitiveGeometry> primitives{{.indices = {0, 1, 2, 2, 1, 3, 4, 5, 6}}};
    const PoolOutcome mended = compute(pool, primitives, {}), raw = compute(pool, primitives, {.sanitize = false});
    EXPECT_EQ(mended.reports[0].sanitize.placeholder_count, 3u);
    for (std::size_t v = 0; v < 4; ++v) EXPECT_EQ(mended.frames.tangents[v], raw.frames.tangents[v]);
    for (std::size_t v = 4; v < 7; ++v) {
        EXPECT_EQ(xyz(raw.frames.tangents[v]), (Vec3{1, 0, 0}));
        EXPECT_NEAR(dot(xyz(mended.frames.tangents[v]), tilted), 0, 1e-6);
    }
}

TEST(ComputeFrames, SplitsTheVerticesOfAMirroredSeam) {
    OwnedMesh pool = square();
    pool.positions.push_back({2, 0, 0});
    pool.normals.push_back({0, 0, 1});
    pool.uvs.push_back({0, 0});
    const PoolOutcome result = compute(pool, {{.indices = {0, 1, 2, 2, 1, 3, 1, 4, 3}}}, {});
    EXPECT_EQ(result.frames.source_vertices, (Indices{0, 1, 2, 3, 4, 1, 3}));
    EXPECT_EQ(result.frames.indices[0], (Indices{0, 1, 2, 2, 1, 3, 5, 4, 6}));
    EXPECT_EQ(result.frames.tangents[1], (Vec4{1, 0, 0, -1}));
    EXPECT_EQ(result.frames.tangents[5], (Vec4{-1, 0, 0, 1}));
}

TEST(ComputeFrames, GivesVerticesThatNoCornerUsesAFrame) {
    OwnedMesh pool = square();
    for (const Vec3& normal : {Vec3{0, 5, 0}, Vec3{0, 0, 0}, Vec3{std::nanf(""), 0, 1}}) {
        pool.positions.push_back({});
        pool.normals.push_back(normal);
        pool.uvs.push_back({});
    }
    const PoolOutcome result = compute(pool, {{.indices = {0, 1, 2}}}, {});
    ASSERT_EQ(result.frames.tangents.size(), 7u);
    for (const Vec4& t : result.frames.tangents) {
        EXPECT_NEAR(std::hypot(t.x, t.y, t.z), 1.0f, 1e-6f);
        EXPECT_EQ(t.w, -1.0f);
    }
    EXPECT_NEAR(result.frames.tangents[4].y, 0.0f, 1e-6f);
}

TEST(ComputeFrames, GeneratesNormalsEvenWithoutUvs) {
    OwnedMesh pool = square();
    pool.normals.clear();
    pool.uvs.clear();
    pool.positions[3].z = 1;
    const PoolOutcome result = compute(pool, {{.indices = {0, 1, 2, 2, 1, 3}}}, {});
    EXPECT_TRUE(result.frames.normals_generated);
    EXPECT_TRUE(result.reports[0].normals_generated);
    EXPECT_TRUE(result.frames.tangents.empty());
    EXPECT_EQ(result.frames.source_vertices, (Indices{0, 1, 2, 3, 2, 1}));
    EXPECT_EQ(result.frames.normals.size(), 6u);
    EXPECT_EQ(result.frames.normals[0], (Vec3{0, 0, 1}));
    EXPECT_EQ(compute(pool, {{.indices = {0, 1, 2}}}, withMethod(Method::basis)).frames.tangents.size(), 4u);
}

TEST(ComputeFrames, TakesSmoothingGroupsFromThePrimitive) {
    OwnedMesh pool = square();
    pool.normals.clear();
    pool.positions[3].z = 1;
    FramesOptions options;
    options.normals.weighting = NormalWeighting::angle;
    PrimitiveGeometry primitive{.indices = {0, 1, 2, 2, 1, 3}, .smoothing_groups = {1, 1}};
    const auto distinctNormals = [&] {
        const PoolOutcome result = compute(pool, {primitive}, options);
        const Indices& corners = result.frames.indices[0];
        return result.frames.normals[corners[1]] != result.frames.normals[corners[4]];
    };
    EXPECT_FALSE(distinctNormals());
    primitive.smoothing_groups = {1, 2};
    EXPECT_TRUE(distinctNormals());
}

TEST(ComputeFrames, TriangulatesPolygonsAndSkipsFacesWithoutArea) {
    OwnedMesh pool;
    for (int k = 0; k < 6; ++k) {
        const float x = std::cos(1.0471976f * static_cast<float>(k));
        const float y = std::sin(1.0471976f * static_cast<float>(k));
        pool.positions.push_back({x, y, 0});
        pool.uvs.push_back({x, y});
    }
    const PrimitiveGeometry primitive{.indices = {5, 4, 0, 1, 2, 3, 4, 5, 0, 2, 1, 3}, .face_sizes = {2, 6, 1, 3}};
    const PoolOutcome result = compute(pool, {primitive}, {});
    const Indices& corners = result.frames.indices[0];
    ASSERT_EQ(corners.size(), 15u);
    EXPECT_EQ(result.reports[0].triangle_count, 5u);
    Indices last;
    for (std::size_t c = 12; c < 15; ++c) last.push_back(result.frames.source_vertices[corners[c]]);
    EXPECT_EQ(last, (Indices{2, 1, 3}));
    for (const Vec4& t : result.frames.tangents) EXPECT_NEAR(std::hypot(t.x, t.y, t.z), 1.0f, 5e-4f);
    // The hexagon faces up. The triangle has the opposite winding, faces down, and shares no vertex with the hexagon.
    for (std::size_t c = 0; c < 15; ++c) EXPECT_EQ(result.frames.normals[corners[c]].z, c < 12 ? 1.0f : -1.0f);
}

TEST(ComputeFrames, AcceptsPoolsAndPrimitivesWithNothingInThem) {
    EXPECT_TRUE(compute({}, {}, {}).frames.source_vertices.empty());
    EXPECT_TRUE(compute({}, {{}}, {}).frames.indices[0].empty());
    const PoolOutcome unused = compute(square(), {{}, {.indices = {0, 1}, .face_sizes = {2, 0}}}, {});
    EXPECT_EQ(unused.frames.tangents.size(), 4u);
    EXPECT_TRUE(unused.frames.indices[1].empty());
}

TEST(ComputeFrames, RejectsMismatchingIndicesAndCounts) {
    const auto code = [](const OwnedMesh& pool, const PrimitiveGeometry& primitive) {
        std::vector<FramesReport> reports(1);
        return computeFrames(pool, {&primitive, 1}, {}, reports).error().code;
    };
    EXPECT_EQ(code(square(), {.indices = {0, 1, 4}}), ErrorCode::indexOutOfRange);
    EXPECT_EQ(code(square(), {.indices = {0, 1}}), ErrorCode::countMismatch);
    OwnedMesh pool = square();
    pool.uvs.pop_back();
    EXPECT_EQ(code(pool, {.indices = {0, 1, 2}}), ErrorCode::countMismatch);
}

/// An implementation that processes the whole pool for each primitive would exceed the test's time limit.
TEST(ComputeFramesTime, StaysLinearWhenManyPrimitivesShareALargePool) {
    OwnedMesh pool;
    std::vector<PrimitiveGeometry> primitives;
    for (std::uint32_t p = 0; p < 30000; ++p) {
        primitives.push_back({.indices = {3 * p, 3 * p + 1, 3 * p + 2}});
        for (const Vec2& uv : {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}}) {
            pool.positions.push_back({uv.x, uv.y, static_cast<float>(p)});
            pool.normals.push_back({0, 0, 1});
            pool.uvs.push_back(uv);
        }
    }
    FramesOptions options;
    EXPECT_FALSE(compute(pool, primitives, options).frames.wasSplit(pool.positions.size()));
}

/// Returns the processor time, in seconds, of computing normals and tangents for a grid of 20,000 triangles that is
/// divided into `primitive_count` primitives.
double secondsForPrimitives(std::uint32_t primitive_count) {
    constexpr std::uint32_t kCells = 100;
    OwnedMesh pool;
    for (std::uint32_t i = 0; i < (kCells + 1) * (kCells + 1); ++i) {
        const auto x = static_cast<float>(i % (kCells + 1)), y = static_cast<float>(i / (kCells + 1));
        pool.positions.push_back({x, y, 0.01F * x * y});
        pool.uvs.push_back({x, y});
    }
    std::vector<PrimitiveGeometry> primitives(primitive_count);
    for (std::uint32_t i = 0; i < kCells * kCells; ++i) {
        const std::uint32_t a = i / kCells * (kCells + 1) + i % kCells, b = a + kCells + 1;
        Indices& indices = primitives[i * primitive_count / (kCells * kCells)].indices;
        indices.insert(indices.end(), {a, a + 1, b + 1, a, b + 1, b});
    }
    const std::clock_t begin = std::clock();
    compute(pool, primitives, {});
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

TEST(ComputeFramesTime, DoesNotGrowWithTheNumberOfPrimitivesOfAPool) {
    // A search through all vertices for each primitive would take a hundred times as long.
    EXPECT_LT(secondsForPrimitives(1000), 8 * secondsForPrimitives(1) + 0.05);
}

}  // namespace
}  // namespace tspace
