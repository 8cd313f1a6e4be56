// SPDX-License-Identifier: MIT
// Meshes with an index list per attribute give the same results as the mesh with one list.
#include <gtest/gtest.h>

#include "core/indexed/lists_mesh.h"
#include "tspace/tspace.hpp"

namespace tspace::test {
namespace {

constexpr Method kAllMethods[] = {Method::mikktspace, Method::lengyel, Method::uniform, Method::angle, Method::area,
                                  Method::flat,       Method::basis,   Method::fast,    Method::best};

struct Results {
    explicit Results(std::size_t count) : tangents(count), bitangents(count), magnitudes_s(count), has_tangent(count) {}
    [[nodiscard]] TangentOutput view() { return {tangents, bitangents, magnitudes_s, {}, has_tangent}; }

    std::vector<Vec4> tangents;
    std::vector<Vec3> bitangents;
    std::vector<float> magnitudes_s;
    std::vector<std::uint8_t> has_tangent;
};

void expectSame(const Results& a, const Results& b, Method method) {
    EXPECT_TRUE(sameBits(a.tangents, b.tangents)) << methodName(method);
    EXPECT_TRUE(sameBits(a.bitangents, b.bitangents)) << methodName(method);
    EXPECT_TRUE(sameBits(a.magnitudes_s, b.magnitudes_s)) << methodName(method);
    EXPECT_EQ(a.has_tangent, b.has_tangent) << methodName(method);
}

TEST(IndexLists, GiveTheTangentsOfTheUnrolledMesh) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        const ListsMesh mesh(seed, 90);
        const UnrolledMesh unrolled(mesh);
        for (const Method method : kAllMethods) {
            Results got(mesh.cornerCount()), want(mesh.cornerCount());
            const TangentOptions options{.method = method, .convention = conventions::gltf};
            const auto report = generateTangents(mesh.view(), options, got.view());
            ASSERT_TRUE(report) << report.error().message;
            const auto wanted = generateTangents(unrolled.view(), options, want.view());
            ASSERT_TRUE(wanted);
            expectSame(got, want, method);
            EXPECT_EQ(report->group_count, wanted->group_count);
        }
    }
}

TEST(IndexLists, APlanEvaluatesPosesOfTheLists) {
    const ListsMesh mesh(4, 90);
    const UnrolledMesh unrolled(mesh);
    ListsMesh moved = mesh;
    for (Vec3& p : moved.positions) p = {p.x + 0.2f * p.y, 1.5f * p.y, p.z - p.x};
    UnrolledMesh moved_unrolled = unrolled;
    for (std::size_t v = 0; v < unrolled.positions.size(); ++v)
        moved_unrolled.positions[v] = moved.positions[unrolled.source_positions[v]];
    for (const Method method : kAllMethods) {
        for (const FrameShape frame : {FrameShape::gramSchmidt, FrameShape::symmetric}) {
            if (frame == FrameShape::symmetric && (method == Method::mikktspace || method == Method::basis)) continue;
            const TangentOptions options{.method = method, .convention = conventions::opengl, .frame = frame};
            const auto plan = planTangents(mesh.view(), options);
            ASSERT_TRUE(plan) << plan.error().message;
            EXPECT_EQ(plan->vertexCount(), mesh.positions.size());
            const auto wanted_plan = planTangents(unrolled.view(), options);
            ASSERT_TRUE(wanted_plan);
            Results got(mesh.cornerCount()), want(mesh.cornerCount());
            const auto report = evaluateTangents(*plan, {moved.positions, moved.normals}, got.view());
            ASSERT_TRUE(report) << report.error().message;
            ASSERT_TRUE(
                evaluateTangents(*wanted_plan, {moved_unrolled.positions, moved_unrolled.normals}, want.view()));
            expectSame(got, want, method);
            EXPECT_EQ(evaluateTangents(*plan, {moved.positions, moved.positions}, got.view()).error().code,
                      ErrorCode::planMismatch);
        }
    }
}

TEST(IndexLists, EntriesPerCornerCountAsOneWhereTheirBitsAreEqual) {
    const ListsMesh lists(5, 90);
    std::vector<Vec3> corner_normals;
    for (const std::uint16_t n : lists.normal_indices) corner_normals.push_back(lists.normals[n]);
    MeshView mesh = lists.view();
    mesh.normals = corner_normals;
    mesh.normal_indices = {nullptr, 0, IndexType::corners};
    for (const Method method : kAllMethods) {
        const TangentOptions options{.method = method, .convention = conventions::opengl};
        Results got(lists.cornerCount()), want(lists.cornerCount());
        const auto report = generateTangents(mesh, options, got.view());
        ASSERT_TRUE(report) << report.error().message;
        ASSERT_TRUE(generateTangents(lists.view(), options, want.view()));
        expectSame(got, want, method);
    }
}

TEST(IndexLists, AreSupportedByNormalsSanitizeAndTriangulate) {
    const ListsMesh mesh(6, 90);
    const UnrolledMesh unrolled(mesh);
    std::vector<Vec3> normals(mesh.cornerCount()), wanted_normals(mesh.cornerCount());
    ASSERT_TRUE(generateNormals(mesh.view(), {}, normals));
    ASSERT_TRUE(generateNormals(unrolled.view(), {}, wanted_normals));
    EXPECT_TRUE(sameBits(normals, wanted_normals));
    std::vector<Vec4> tangents(mesh.cornerCount(), Vec4{1, 0, 0, 1});
    std::vector<Vec4> wanted_tangents = tangents;
    const auto report = sanitizeTangents(mesh.view(), {.orthogonalize_all = true}, tangents);
    ASSERT_TRUE(report);
    EXPECT_GT(report->mendedCount(), 0u);
    ASSERT_TRUE(sanitizeTangents(unrolled.view(), {.orthogonalize_all = true}, wanted_tangents));
    EXPECT_TRUE(sameBits(tangents, wanted_tangents));
    const auto cut = triangulate(mesh.view()), wanted_cut = triangulate(unrolled.view());
    ASSERT_TRUE(cut && wanted_cut);
    EXPECT_EQ(cut->corners, wanted_cut->corners);
}

TEST(IndexLists, AreCheckedAsIndicesAre) {
    ListsMesh mesh(7, 20);
    const auto codeOf = [&](const MeshView& view) {
        const Result<Done> valid = validate(view);
        return valid ? ErrorCode::ok : valid.error().code;
    };
    EXPECT_EQ(codeOf(mesh.view()), ErrorCode::ok);
    mesh.uv_indices[11] = static_cast<std::uint32_t>(mesh.uvs.size());
    const Result<Done> beyond = validate(mesh.view());
    ASSERT_FALSE(beyond);
    EXPECT_EQ(beyond.error().code, ErrorCode::indexOutOfRange);
    EXPECT_EQ(beyond.error().element, 11u);
    EXPECT_NE(beyond.error().message.find("uv_indices"), std::string::npos) << beyond.error().message;
    mesh.uv_indices[11] = 0;
    MeshView view = mesh.view();
    view.normal_indices.count -= 1;
    EXPECT_EQ(codeOf(view), ErrorCode::countMismatch);
    view = mesh.view();
    view.normal_indices.data = nullptr;
    EXPECT_EQ(codeOf(view), ErrorCode::nullData);
    view = mesh.view();
    view.normal_indices.type = static_cast<IndexType>(3);
    EXPECT_EQ(codeOf(view), ErrorCode::invalidOption);
    view = mesh.view();
    view.normal_indices = {nullptr, 0, IndexType::corners};  // one normal per corner, but there are fewer
    EXPECT_EQ(codeOf(view), ErrorCode::countMismatch);
    view = mesh.view();
    view.indices.type = IndexType::corners;
    EXPECT_EQ(codeOf(view), ErrorCode::invalidOption);
    view = mesh.view();
    view.uv_indices = {};  // without their list, there are more UVs than vertices
    EXPECT_EQ(codeOf(view), ErrorCode::countMismatch);
}

TEST(IndexLists, HaveNoResultsPerVertex) {
    const ListsMesh mesh(8, 20);
    std::vector<Vec4> tangents(mesh.positions.size());
    const TangentOptions options{
        .method = Method::lengyel, .convention = conventions::opengl, .domain = OutputDomain::vertex};
    EXPECT_EQ(generateTangents(mesh.view(), options, {tangents}).error().code, ErrorCode::invalidOption);
    EXPECT_EQ(planTangents(mesh.view(), options).error().code, ErrorCode::invalidOption);
}

}  // namespace
}  // namespace tspace::test
