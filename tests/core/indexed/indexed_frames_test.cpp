// SPDX-License-Identifier: MIT
// An indexed mesh with frames, computed by one call, equals the result of the single steps.
#include "tspace/indexed_frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/indexed/lists_mesh.h"
#include "tspace/tspace.hpp"

namespace tspace::test {
namespace {

IndexedFramesOptions gltfOptions(Method method = Method::mikktspace) {
    return {.tangents = {.method = method, .convention = conventions::gltf}};
}

/// Returns tangents per corner, computed by the single steps.
std::vector<Vec4> tangentsAtCorners(const MeshView& mesh, const TangentOptions& options) {
    std::vector<Vec4> tangents(mesh.cornerCount());
    EXPECT_TRUE(generateTangents(mesh, options, {tangents}));
    EXPECT_TRUE(sanitizeTangents(mesh, {}, tangents));
    return tangents;
}

template <class T>
std::vector<T> atCorners(const IndexedFrames& frames, const std::vector<T>& values) {
    std::vector<T> result;
    for (const std::uint32_t vertex : frames.indices) result.push_back(values[vertex]);
    return result;
}

/// Checks that every corner keeps its position, and that every vertex either is used by its source corner or is unused.
void expectSources(const MeshView& mesh, const IndexedFrames& frames) {
    ASSERT_EQ(frames.indices.size(), mesh.cornerCount());
    ASSERT_EQ(frames.source_corners.size(), frames.vertexCount());
    ASSERT_EQ(frames.normals.size(), frames.vertexCount());
    ASSERT_EQ(frames.tangents.size(), frames.vertexCount());
    for (std::size_t c = 0; c < frames.indices.size(); ++c) {
        ASSERT_LT(frames.indices[c], frames.vertexCount());
        ASSERT_LE(frames.source_corners[frames.indices[c]], c);
        const Vec3 &copied = mesh.positions[frames.source_vertices[frames.indices[c]]],
                   &own = mesh.positions[mesh.indices[c]];
        ASSERT_EQ(copied, own);
    }
    for (std::size_t v = 0; v < frames.vertexCount(); ++v) {
        const std::uint32_t corner = frames.source_corners[v];
        ASSERT_TRUE(corner == kNoCorner || frames.indices[corner] == v);
    }
}

TEST(IndexedFrames, EqualTheSingleSteps) {
    const UnrolledMesh mesh{ListsMesh(1, 90)};
    for (const Method method : {Method::mikktspace, Method::lengyel, Method::flat, Method::best, Method::basis}) {
        const auto frames = makeIndexedFrames(mesh.view(), gltfOptions(method));
        ASSERT_TRUE(frames) << frames.error().message;
        expectSources(mesh.view(), *frames);
        EXPECT_FALSE(frames->report.normals_made);
        EXPECT_TRUE(sameBits(atCorners(*frames, frames->tangents),
                             tangentsAtCorners(mesh.view(), gltfOptions(method).tangents)));
        for (std::size_t v = 0; v < frames->vertexCount(); ++v) {
            EXPECT_TRUE(v >= mesh.positions.size() || frames->source_vertices[v] == v);
            EXPECT_EQ(frames->normals[v], mesh.normals[frames->source_vertices[v]]);
        }
    }
}

TEST(IndexedFrames, TakeAnIndexListPerAttribute) {
    const ListsMesh lists(2, 90);
    const UnrolledMesh unrolled(lists);
    const auto frames = makeIndexedFrames(lists.view(), gltfOptions());
    ASSERT_TRUE(frames) << frames.error().message;
    expectSources(lists.view(), *frames);
    EXPECT_TRUE(
        sameBits(atCorners(*frames, frames->tangents), tangentsAtCorners(unrolled.view(), gltfOptions().tangents)));
    for (std::size_t v = 0; v < frames->vertexCount(); ++v) {
        ASSERT_NE(frames->source_corners[v], kNoCorner);
        EXPECT_EQ(frames->normals[v], lists.normals[lists.normal_indices[frames->source_corners[v]]]);
    }
}

TEST(IndexedFrames, ComputeMissingAndRequestedNormals) {
    const ListsMesh lists(3, 60);
    MeshView without = lists.view();
    without.normals = {};
    without.normal_indices = {};
    IndexedFramesOptions options = gltfOptions();
    options.normals.crease_angle_deg = 40;
    std::vector<Vec3> normals(lists.cornerCount());
    ASSERT_TRUE(generateNormals(without, {.crease_angle_deg = 40}, normals));
    const auto made = makeIndexedFrames(without, options);
    ASSERT_TRUE(made) << made.error().message;
    expectSources(without, *made);
    EXPECT_TRUE(made->report.normals_made);
    EXPECT_EQ(made->report.normals.face_count, lists.face_sizes.size());
    EXPECT_TRUE(sameBits(atCorners(*made, made->normals), normals));
    MeshView with_them = without;
    with_them.normals = normals;
    with_them.normal_indices = {nullptr, 0, IndexType::corners};
    EXPECT_TRUE(sameBits(atCorners(*made, made->tangents), tangentsAtCorners(with_them, options.tangents)));

    options.make_normals = true;
    const auto replaced = makeIndexedFrames(lists.view(), options);
    ASSERT_TRUE(replaced);
    EXPECT_TRUE(replaced->report.normals_made);
    EXPECT_TRUE(sameBits(atCorners(*replaced, replaced->normals), normals));
}

TEST(IndexedFrames, TheConventionDefinesTheOutside) {
    const ListsMesh lists(3, 30);
    MeshView mesh = lists.view();
    mesh.normals = {};
    mesh.normal_indices = {};
    const auto gltf = makeIndexedFrames(mesh, gltfOptions());
    const auto unreal = makeIndexedFrames(mesh, {.tangents = {.convention = conventions::unreal}});
    ASSERT_TRUE(gltf && unreal);
    const std::vector<Vec3> a = atCorners(*gltf, gltf->normals), b = atCorners(*unreal, unreal->normals);
    for (std::size_t c = 0; c < a.size(); ++c) EXPECT_EQ(a[c], (Vec3{-b[c].x, -b[c].y, -b[c].z}));
}

/// The values of a vertex that decide whether it is merged with another one.
using VertexKey = std::array<float, 12>;

TEST(IndexedFrames, AMeshWithoutIndicesGetsThem) {
    const ListsMesh lists(4, 200);
    std::vector<Vec3> positions, normals;
    std::vector<Vec2> uvs;
    for (std::size_t c = 0; c < lists.cornerCount(); ++c) {
        positions.push_back(lists.positions[lists.indices[c]]);
        normals.push_back(lists.normals[lists.normal_indices[c]]);
        uvs.push_back(lists.uvs[lists.uv_indices[c]]);
    }
    MeshView soup;
    soup.positions = positions;
    soup.normals = normals;
    soup.uvs = uvs;
    soup.face_sizes = lists.face_sizes;
    const auto frames = makeIndexedFrames(soup, gltfOptions());
    ASSERT_TRUE(frames) << frames.error().message;
    expectSources(soup, *frames);
    EXPECT_LT(frames->vertexCount(), positions.size());
    EXPECT_TRUE(sameBits(atCorners(*frames, frames->tangents), tangentsAtCorners(soup, gltfOptions().tangents)));
    std::set<VertexKey> different;
    for (std::size_t v = 0; v < frames->vertexCount(); ++v) {
        const std::uint32_t c = frames->source_corners[v];
        const Vec4& t = frames->tangents[v];
        different.insert({positions[c].x, positions[c].y, positions[c].z, normals[c].x, normals[c].y, normals[c].z,
                          uvs[c].x, uvs[c].y, t.x, t.y, t.z, t.w});
    }
    EXPECT_EQ(different.size(), frames->vertexCount());

    std::vector<float> colors(positions.size());
    for (std::size_t c = 0; c < colors.size(); ++c) colors[c] = static_cast<float>(c);
    const CornerAttribute color{colors.data(), sizeof(float), 1};
    IndexedFramesOptions apart = gltfOptions();
    apart.keep_apart = {&color, 1};
    const auto kept = makeIndexedFrames(soup, apart);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->vertexCount(), positions.size());
}

TEST(IndexedFrames, UnusedVerticesKeepTheirPositionAndGetAFrame) {
    UnrolledMesh mesh{ListsMesh(5, 20)};
    mesh.positions.push_back({9, 9, 9});
    mesh.normals.push_back({0, 1, 0});
    mesh.uvs.push_back({0, 0});
    const std::size_t unused = mesh.positions.size() - 1;
    const auto frames = makeIndexedFrames(mesh.view(), gltfOptions());
    ASSERT_TRUE(frames);
    EXPECT_EQ(frames->source_vertices[unused], unused);
    EXPECT_EQ(frames->source_corners[unused], kNoCorner);
    const Vec4& t = frames->tangents[unused];
    EXPECT_NEAR(std::hypot(t.x, t.y, t.z), 1, 1e-6);
    EXPECT_NEAR(t.y, 0, 1e-6);
    EXPECT_EQ(std::abs(t.w), 1);
}

TEST(IndexedFrames, GiveTheSameForAnyNumberOfThreads) {
    const ListsMesh lists(6, 60000);
    const auto one = makeIndexedFrames(lists.view(), gltfOptions());
    const auto three = makeIndexedFrames(lists.view(), gltfOptions(), {.thread_count = 3});
    ASSERT_TRUE(one && three);
    EXPECT_EQ(one->indices, three->indices);
    EXPECT_EQ(one->source_vertices, three->source_vertices);
    EXPECT_TRUE(sameBits(one->tangents, three->tangents));
}

TEST(IndexedFrames, ReportErrors) {
    const ListsMesh lists(7, 20);
    const auto codeOf = [](const MeshView& mesh, const IndexedFramesOptions& options) {
        const auto frames = makeIndexedFrames(mesh, options);
        return frames ? ErrorCode::ok : frames.error().code;
    };
    EXPECT_EQ(codeOf(lists.view(), {}), ErrorCode::invalidOption);  // the convention is missing
    IndexedFramesOptions per_vertex = gltfOptions(Method::lengyel);
    per_vertex.tangents.domain = OutputDomain::vertex;
    EXPECT_EQ(codeOf(lists.view(), per_vertex), ErrorCode::invalidOption);
    MeshView bad = lists.view();
    bad.uvs = {};
    bad.uv_indices = {};
    EXPECT_EQ(codeOf(bad, gltfOptions()), ErrorCode::missingAttribute);
    EXPECT_EQ(codeOf(bad, gltfOptions(Method::basis)), ErrorCode::ok);
    EXPECT_EQ(codeOf({}, gltfOptions()), ErrorCode::ok);
}

}  // namespace
}  // namespace tspace::test
