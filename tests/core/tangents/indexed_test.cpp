// SPDX-License-Identifier: MIT
// The methods lengyel, flat and basis, with and without plans.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <random>

#include "core/tangents/indexed_methods.h"
#include "support/simple_mesh.h"
#include "support/thread_team.h"

namespace tspace {
namespace {

using test::SimpleMesh;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct Outputs {
    std::vector<Vec4> tangents;
    std::vector<Vec3> bitangents;
    std::vector<float> magnitudes_s, magnitudes_t;
    TangentReport report;
};

Outputs tangentsOf(const MeshView& mesh, const TangentOptions& options, const Execution& execution = {}) {
    const std::size_t corners = mesh.cornerCount();
    Outputs out{std::vector<Vec4>(corners, Vec4{9, 9, 9, 9}),
                std::vector<Vec3>(corners, Vec3{9, 9, 9}),
                std::vector<float>(corners, 9.0f),
                std::vector<float>(corners, 9.0f),
                {}};
    Parallel parallel(execution);
    const IndexedPlan plan = planIndexed(mesh, {options, execution}, parallel);
    EXPECT_GE(plan.memoryBytes(), 4 * corners);
    out.report = evaluateIndexed(plan, {mesh.positions, mesh.normals},
                                 {out.tangents, out.bitangents, out.magnitudes_s, out.magnitudes_t}, {}, parallel);
    return out;
}

void expectNear(const Vec3& a, const Vec3& b, double tolerance = 1e-6) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

/// Returns a unit square in z = 0 with N = +z, divided along its diagonal 0-2. UVs are (2 x, 4 y).
SimpleMesh square() {
    SimpleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.uvs = {{0, 0}, {2, 0}, {2, 4}, {0, 4}};
    mesh.addFace({0, 1, 2});
    mesh.addFace({0, 2, 3});
    return mesh;
}

/// Returns the square with both u and v mirrored.
SimpleMesh mirroredSquare() {
    SimpleMesh mesh = square();
    for (Vec2& uv : mesh.uvs) uv.x = -uv.x;
    return mesh;
}

TEST(Lengyel, GivesFrameSignAndMagnitudesOfAPlane) {
    for (const Method method : {Method::lengyel, Method::flat}) {
        const Outputs out = tangentsOf(square().view(), {.method = method, .convention = conventions::opengl});
        for (std::size_t c = 0; c < 6; ++c) {
            EXPECT_EQ(out.tangents[c], (Vec4{1, 0, 0, 1}));
            EXPECT_EQ(out.bitangents[c], (Vec3{0, 1, 0}));
            EXPECT_EQ(out.magnitudes_s[c], 0.5f);
            EXPECT_EQ(out.magnitudes_t[c], 0.25f);
        }
        EXPECT_EQ(out.report.triangle_count, 2u);
        EXPECT_EQ(out.report.mirrored_count, 0u);
        EXPECT_EQ(out.report.default_corner_count, 0u);
    }
}

TEST(Lengyel, GivesMirroredFacesTheSignMinusOne) {
    for (const Method method : {Method::lengyel, Method::flat}) {
        const Outputs out = tangentsOf(mirroredSquare().view(), {.method = method, .convention = conventions::opengl});
        for (std::size_t c = 0; c < 6; ++c) {
            EXPECT_EQ(out.tangents[c], (Vec4{-1, 0, 0, -1}));
            EXPECT_EQ(out.bitangents[c], (Vec3{0, 1, 0}));
        }
        EXPECT_EQ(out.report.mirrored_count, 2u);
    }
}

TEST(Lengyel, GivesTheNumbersOfItsPage) {
    // docs/concepts/methods/simple.md computes this triangle step by step.
    SimpleMesh mesh;
    mesh.positions = {{0, 0, 0}, {4, 1, 0}, {0, 2, 0}};
    mesh.normals = {{0.6f, 0, 0.8f}, {0, 0, 1}, {0, 0, 1}};
    mesh.uvs = {{0, 0}, {0.5f, 0.25f}, {0, 0.5f}};
    mesh.addFace({0, 1, 2});
    const Outputs out = tangentsOf(mesh.view(), {.method = Method::lengyel, .convention = conventions::opengl});
    expectNear(xyz(out.tangents[0]), {0.8f, 0, -0.6f}, 1e-7);
    EXPECT_EQ(out.tangents[0].w, 1);
    EXPECT_EQ(out.tangents[1], (Vec4{1, 0, 0, 1}));
    EXPECT_EQ(out.tangents[2], (Vec4{1, 0, 0, 1}));
    EXPECT_EQ(out.magnitudes_s[1], 8);
    EXPECT_EQ(out.magnitudes_t[1], 4);

    mesh.uvs[1].x = -0.5f;
    for (const Vec4& t :
         tangentsOf(mesh.view(), {.method = Method::lengyel, .convention = conventions::opengl}).tangents)
        EXPECT_EQ(t.w, -1);
    const TangentOptions gltf{.method = Method::lengyel, .convention = conventions::gltf};
    for (const Vec4& t : tangentsOf(mesh.view(), gltf).tangents) EXPECT_EQ(t.w, 1);
}

TEST(Lengyel, GivesParallelDerivativesTheSignOne) {
    // A triangle without area: dP/du and dP/dv are parallel to z, so their determinant with the normal is exactly 0.
    for (const Method method : {Method::lengyel, Method::flat}) {
        for (int i = 0; i < 200; ++i) {
            const auto part = [&](int k) { return static_cast<float>((i * k) % 37 - 18) / 19.0f; };
            SimpleMesh mesh;
            mesh.positions = {{0, 0, 0}, {0, 0, 0.3f}, {0, 0, 0}};
            mesh.normals.assign(3, {part(7), part(11) + 0.01f, part(13)});
            mesh.uvs = {{0, 0}, {0.7f, 0.1f}, {0.2f, 0.9f}};
            mesh.addFace({0, 1, 2});
            const Outputs out = tangentsOf(mesh.view(), {.method = method, .convention = conventions::opengl});
            for (const Vec4& t : out.tangents) EXPECT_EQ(t.w, 1) << i;
            EXPECT_EQ(out.report.degenerate_triangle_count, 1u);
        }
    }
}

TEST(Lengyel, SumsUnnormalizedDerivatives) {
    // At vertex 0 one face has T = (1, 0, 0) and the other T = (0, 3, 0), which has three times the weight because it
    // is longer.
    SimpleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 3, 0}, {-1, 0, 0}};
    mesh.normals.assign(5, {0, 0, 1});
    mesh.uvs = {{0, 0}, {1, 0}, {0, 1}, {1, 0}, {0, 1}};
    mesh.addFace({0, 1, 2});
    mesh.addFace({0, 3, 4});
    const Outputs out = tangentsOf(mesh.view(), {.method = Method::lengyel, .convention = conventions::opengl});
    const float l = std::sqrt(10.0f);
    expectNear(xyz(out.tangents[0]), {1 / l, 3 / l, 0});
    EXPECT_EQ(out.tangents[0], out.tangents[3]);
    EXPECT_NEAR(out.magnitudes_s[0], l / 2, 1e-6);
    EXPECT_EQ(out.magnitudes_s[1], 1);
    const Outputs flat = tangentsOf(mesh.view(), {.method = Method::flat, .convention = conventions::opengl});
    EXPECT_EQ(flat.tangents[0], (Vec4{1, 0, 0, 1}));
    EXPECT_EQ(flat.tangents[3], (Vec4{0, 1, 0, 1}));
}

TEST(Lengyel, SubtractsTheVectorAlongN) {
    SimpleMesh mesh = square();
    const float k = std::sqrt(0.5f);
    mesh.normals.assign(4, {k, 0, k});
    for (const Method method : {Method::lengyel, Method::flat}) {
        expectNear(xyz(tangentsOf(mesh.view(), {.method = method, .convention = conventions::opengl}).tangents[0]),
                   {k, 0, -k});
    }
}

TEST(Lengyel, IgnoresFacesWithoutUvAreaAndInvalidOnes) {
    SimpleMesh mesh = square();
    mesh.positions.push_back({kNan, 0, 0});
    mesh.normals.push_back({0, 0, 1});
    mesh.uvs.push_back({7, 1});
    mesh.positions.push_back({5, 5, 5});
    mesh.normals.push_back({0, 0, 1});
    mesh.uvs.push_back({1, 0});
    mesh.addFace({0, 1, 4});
    mesh.addFace({0, 1, 5});  // all of its UVs have v = 0
    const Outputs out = tangentsOf(mesh.view(), {.method = Method::lengyel, .convention = conventions::opengl});
    EXPECT_EQ(out.tangents[0], (Vec4{1, 0, 0, 1}));
    EXPECT_EQ(out.magnitudes_s[0], 0.5f);
    EXPECT_EQ(out.tangents[8], (Vec4{1, 0, 0, 1}));
    EXPECT_EQ(out.report.degenerate_uv_count, 1u);
    EXPECT_EQ(out.report.default_corner_count, 2u);
}

TEST(Defaults, AreWrittenIfNoFaceContributes) {
    SimpleMesh mesh = square();
    mesh.uvs.assign(4, {0.5f, 0.5f});
    for (const Method method : {Method::lengyel, Method::flat}) {
        const Outputs out = tangentsOf(mesh.view(), {.method = method, .convention = conventions::gltf});
        for (std::size_t c = 0; c < 6; ++c) {
            EXPECT_EQ(out.tangents[c], (Vec4{1, 0, 0, -1}));
            EXPECT_EQ(out.bitangents[c], (Vec3{0, -1, 0}));
            EXPECT_EQ(out.magnitudes_s[c], 1);
            EXPECT_EQ(out.magnitudes_t[c], 1);
        }
        EXPECT_EQ(out.report.degenerate_uv_count, 2u);
        EXPECT_EQ(out.report.default_corner_count, 6u);
        EXPECT_EQ(out.report.not_finite_count, 0u);
    }
}

TEST(Conventions, MultiplySignAndBitangentOnly) {
    for (const Method method : {Method::lengyel, Method::flat, Method::basis}) {
        const Outputs raw = tangentsOf(mirroredSquare().view(), {.method = method, .convention = conventions::opengl});
        const Outputs gltf = tangentsOf(mirroredSquare().view(), {.method = method, .convention = conventions::gltf});
        for (std::size_t c = 0; c < 6; ++c) {
            EXPECT_EQ(xyz(gltf.tangents[c]), xyz(raw.tangents[c]));
            EXPECT_EQ(gltf.tangents[c].w, -raw.tangents[c].w);
            EXPECT_EQ(gltf.bitangents[c], (Vec3{-raw.bitangents[c].x, -raw.bitangents[c].y, -raw.bitangents[c].z}));
            EXPECT_EQ(gltf.magnitudes_t[c], raw.magnitudes_t[c]);
        }
    }
}

TEST(Flat, DoesNotDependOnWhereAPolygonBegins) {
    SimpleMesh mesh;
    mesh.positions = {{0, 0, 0}, {2, 0, 1}, {3, 2, 0}, {1, 3, 1}, {-1, 2, 0}};
    mesh.normals.assign(5, {0, 0, 1});
    mesh.uvs = {{0, 0}, {1, 0.2f}, {1, 1}, {0.4f, 1.5f}, {-0.3f, 1}};
    for (const std::uint32_t start : {0u, 1u, 2u, 3u, 4u}) {
        mesh.addFace({start, (start + 1) % 5, (start + 2) % 5, (start + 3) % 5, (start + 4) % 5});
    }
    const Outputs out = tangentsOf(mesh.view(), {.method = Method::flat, .convention = conventions::opengl});
    for (std::size_t c = 1; c < 25; ++c) expectNear(xyz(out.tangents[c]), xyz(out.tangents[0]));
    EXPECT_EQ(out.report.triangle_count, 15u);
    EXPECT_EQ(out.report.group_count, 5u);
}

TEST(Faces, ThatAreSkippedGetZeroInEveryOutput) {
    SimpleMesh mesh = square();
    mesh.addFace({0, 1});
    mesh.addFace({0});
    mesh.addFace({0, 1, 2, 3, 0});
    for (const Method method : {Method::lengyel, Method::flat, Method::basis}) {
        const Outputs out =
            tangentsOf(mesh.view(), {.method = method, .convention = conventions::opengl, .ngons = Ngons::skip});
        for (std::size_t c = 6; c < 14; ++c) {
            EXPECT_EQ(out.tangents[c], Vec4{});
            EXPECT_EQ(out.bitangents[c], Vec3{});
            EXPECT_EQ(out.magnitudes_s[c], 0);
            EXPECT_EQ(out.magnitudes_t[c], 0);
        }
        EXPECT_EQ(out.report.skipped_face_count, 3u);
        EXPECT_EQ(out.report.triangle_count, 2u);
        EXPECT_EQ(tangentsOf(mesh.view(), {.method = method, .convention = conventions::opengl}).report.triangle_count,
                  5u);
        EXPECT_EQ(tangentsOf(mesh.view(), {.method = method, .convention = conventions::opengl}).tangents[9].w, 1);
    }
}

TEST(Reports, CountTrianglesWithTwoCornersAtOnePosition) {
    SimpleMesh mesh = square();
    mesh.positions[3] = mesh.positions[0];
    EXPECT_EQ(tangentsOf(mesh.view(), {.method = Method::lengyel, .convention = conventions::opengl})
                  .report.degenerate_triangle_count,
              1u);
    EXPECT_EQ(tangentsOf(square().view(), {.method = Method::lengyel, .convention = conventions::opengl})
                  .report.degenerate_triangle_count,
              0u);
}

TEST(Reports, CountGroupsAsFacesForFlatAndAsUsedVerticesElse) {
    SimpleMesh mesh = square();
    mesh.positions.push_back({});
    mesh.normals.push_back({});
    mesh.uvs.push_back({});
    EXPECT_EQ(
        tangentsOf(mesh.view(), {.method = Method::lengyel, .convention = conventions::opengl}).report.group_count, 4u);
    EXPECT_EQ(tangentsOf(mesh.view(), {.method = Method::basis, .convention = conventions::opengl}).report.group_count,
              4u);
    EXPECT_EQ(tangentsOf(mesh.view(), {.method = Method::flat, .convention = conventions::opengl}).report.group_count,
              2u);
}

TEST(VertexDomain, GivesUnusedVerticesZeroAndCountsOutputs) {
    SimpleMesh mesh = square();
    mesh.positions.resize(7);
    mesh.normals.resize(7, {0, 0, 1});
    mesh.uvs.resize(7);
    mesh.addFace({4, 5});     // ignored, because it has two corners
    mesh.addFace({0, 1, 6});  // collapsed in UV: vertex 6 is used, but has no tangent
    mesh.uvs[6] = mesh.uvs[0];
    for (const Method method : {Method::lengyel, Method::basis}) {
        std::vector<Vec4> tangents(7, Vec4{9, 9, 9, 9});
        std::vector<Vec3> bitangents(7, Vec3{9, 9, 9});
        const auto report = generateTangents(
            mesh.view(), {.method = method, .convention = conventions::opengl, .domain = OutputDomain::vertex},
            {.tangents = tangents, .bitangents = bitangents});
        ASSERT_TRUE(report);
        EXPECT_EQ(report->group_count, 5u);
        EXPECT_EQ(report->default_corner_count, method == Method::lengyel ? 1u : 0u);
        for (const std::size_t v : {4u, 5u}) {
            EXPECT_EQ(tangents[v], Vec4{});
            EXPECT_EQ(bitangents[v], Vec3{});
        }
        EXPECT_EQ(tangents[6], (Vec4{1, 0, 0, 1}));
        EXPECT_EQ(tangents[0], (Vec4{1, 0, 0, 1}));
    }
}

TEST(VertexDomain, IsRejectedForMethodsThatMaySplitAVertex) {
    const SimpleMesh mesh = square();
    std::vector<Vec4> tangents(4);
    const auto codeOf = [&](Method method, OutputDomain domain, std::size_t count) {
        const StridedSpan<Vec4> out(tangents.data(), count);
        const auto result = generateTangents(
            mesh.view(), {.method = method, .convention = conventions::opengl, .domain = domain}, {.tangents = out});
        return result ? ErrorCode::ok : result.error().code;
    };
    for (const Method method : {Method::mikktspace, Method::uniform, Method::angle, Method::area, Method::flat}) {
        EXPECT_EQ(codeOf(method, OutputDomain::vertex, 4), ErrorCode::invalidOption);
    }
    EXPECT_EQ(codeOf(Method::lengyel, static_cast<OutputDomain>(2), 4), ErrorCode::invalidOption);
    EXPECT_EQ(codeOf(Method::lengyel, OutputDomain::vertex, 3), ErrorCode::countMismatch);
    EXPECT_EQ(codeOf(Method::lengyel, OutputDomain::vertex, 4), ErrorCode::ok);
}

TEST(OneCall, CopiesNeitherIndicesNorUvs) {
    struct Count {
        std::size_t live = 0, peak = 0;
    } count;
    const Allocator allocator{[](void* user, std::size_t bytes, std::size_t alignment) -> void* {
                                  auto& c = *static_cast<Count*>(user);
                                  c.peak = std::max(c.peak, c.live += bytes);
                                  return ::operator new(bytes, std::align_val_t(alignment));
                              },
                              [](void* user, void* memory, std::size_t bytes, std::size_t alignment) {
                                  static_cast<Count*>(user)->live -= bytes;
                                  ::operator delete(memory, std::align_val_t(alignment));
                              },
                              &count};
    SimpleMesh mesh = square();
    mesh.face_sizes.clear();
    std::vector<Vec4> tangents(6);
    for (const OutputDomain domain : {OutputDomain::corner, OutputDomain::vertex}) {
        const StridedSpan<Vec4> out(tangents.data(), domain == OutputDomain::vertex ? 4 : 6);
        count.peak = 0;
        ASSERT_TRUE(generateTangents(mesh.view(),
                                     {.method = Method::lengyel, .convention = conventions::opengl, .domain = domain},
                                     {.tangents = out}, {.thread_count = 1, .allocator = &allocator}));
        // Scratch memory holds a part of each vertex's sum (the rest is in the output memory) and, with domain corner,
        // a mark.
        EXPECT_EQ(count.peak, 4 * (domain == OutputDomain::vertex ? 8u : 17u));
    }
    EXPECT_EQ(count.live, 0u);
}

TEST(Lengyel, LosesNoDigitsAtExtremeScales) {
    // The computation must switch to double where float would overflow, underflow or cancel.
    const SimpleMesh plain = square();
    for (const float space : {1e-30f, 1.0f, 1e25f}) {
        for (const float texture : {1e-18f, 1e-6f, 1.0f, 1e12f}) {
            SimpleMesh mesh = plain;
            for (Vec3& p : mesh.positions) p = {space * p.x, space * p.y, 0};
            for (Vec2& uv : mesh.uvs) uv = {texture * uv.x, texture * uv.y};
            const Outputs out = tangentsOf(mesh.view(), {.method = Method::lengyel, .convention = conventions::opengl});
            for (std::size_t c = 0; c < 6; ++c) {
                const double expected = 0.5 * (double{space} / texture);
                if (expected < 1e-37 || expected > 1e37) continue;  // float cannot represent it
                EXPECT_EQ(out.tangents[c], (Vec4{1, 0, 0, 1})) << space << " " << texture;
                EXPECT_NEAR(out.magnitudes_s[c] / expected, 1, 1e-5) << space << " " << texture;
            }
        }
    }
}

TEST(Lengyel, DistinguishesUvSliversFromCollinearUvs) {
    SimpleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.addFace({0, 1, 2});
    for (const int bits : {0, 8, 16, 22}) {
        const float height = std::ldexp(1.0f, -bits);
        // In UV space the triangle is a sliver along the diagonal, whose determinant is exactly `height`.
        mesh.uvs = {{0, 0}, {1, 1}, {1, 1 + height}};
        const Outputs out = tangentsOf(mesh.view(), {.method = Method::lengyel, .convention = conventions::opengl});
        // dP/du = ((1 + h) E1 - E2) / h, dP/dv = (E2 - E1) / h
        const double x = 1 + double{height}, l = std::sqrt(x * x + 1);
        expectNear(xyz(out.tangents[0]), {static_cast<float>(x / l), static_cast<float>(-1 / l), 0}, 2e-7);
        EXPECT_NEAR(out.magnitudes_s[0] * height / l, 1, 1e-5) << bits;
        EXPECT_EQ(out.report.mirrored_count, 0u);
        mesh.uvs[2] = {1 + height, 1 + height};
        EXPECT_EQ(tangentsOf(mesh.view(), {.method = Method::lengyel, .convention = conventions::opengl})
                      .report.degenerate_uv_count,
                  1u)
            << bits;
    }
}

TEST(Plan, EvaluatesAnotherPoseWithItsOwnUvs) {
    const SimpleMesh rest = square();
    SimpleMesh bent = rest;
    for (Vec3& p : bent.positions) p = {0, p.x, 2 * p.y};
    bent.normals.assign(4, {1, 0, 0});
    Parallel parallel(Execution{.thread_count = 1});
    for (const Method method : {Method::lengyel, Method::flat, Method::basis}) {
        const IndexedPlan plan = planIndexed(rest.view(), {{.method = method}}, parallel);
        std::vector<Vec4> tangents(6);
        evaluateIndexed(plan, {bent.view().positions, bent.view().normals}, {.tangents = tangents}, {}, parallel);
        EXPECT_EQ(tangents, tangentsOf(bent.view(), {.method = method, .convention = conventions::opengl}).tangents);
    }
}

TEST(Plan, AfterAMoveEqualsThatOfAnEmptyMesh) {
    const SimpleMesh mesh = square();
    const MeshView view = mesh.view();
    std::vector<Vec4> tangents(view.cornerCount());
    const Pose pose{view.positions, view.normals};
    for (const Method method : {Method::mikktspace, Method::best, Method::lengyel}) {
        Result<TangentPlan> made = planTangents(view, {.method = method, .convention = conventions::gltf});
        Result<TangentPlan> other = planTangents(view, {.convention = conventions::gltf});
        ASSERT_TRUE(made && other);
        *other = *std::move(made);
        EXPECT_EQ(other->method(), method);
        EXPECT_TRUE(evaluateTangents(*other, pose, {.tangents = tangents}));
        const TangentPlan& left = *made;
        EXPECT_EQ(left.vertexCount(), 0u);
        EXPECT_EQ(left.cornerCount(), 0u);
        EXPECT_EQ(left.outputCount(), 0u);
        EXPECT_LT(left.memoryBytes(), 100u);
        EXPECT_EQ(evaluateTangents(left, pose, {.tangents = tangents}).error().code, ErrorCode::planMismatch);
        EXPECT_TRUE(evaluateTangents(left, {}, {}));
        // A plan can be assigned again, even to itself.
        *made = *std::move(other);
        EXPECT_TRUE(evaluateTangents(*made, pose, {.tangents = tangents}));
        TangentPlan& same = *made;
        *made = std::move(same);
        EXPECT_EQ(made->method(), method);
        EXPECT_EQ(made->cornerCount(), view.cornerCount());
    }
}

TEST(Plan, RunsOutOfMemoryByItsOwnExceptionOnly) {
    int budget = 0;
    const Allocator allocator{[](void* user, std::size_t bytes, std::size_t alignment) -> void* {
                                  if ((*static_cast<int*>(user))-- <= 0) return nullptr;
                                  return ::operator new(bytes, std::align_val_t(alignment));
                              },
                              [](void*, void* memory, std::size_t, std::size_t alignment) {
                                  ::operator delete(memory, std::align_val_t(alignment));
                              },
                              &budget};
    Parallel parallel(Execution{.thread_count = 1});
    const SimpleMesh mesh = square();
    std::vector<Vec4> tangents(6);
    int failures = 0;
    for (bool done = false; !done; ++failures) {
        budget = failures;
        try {
            const IndexedPlan plan =
                planIndexed(mesh.view(), {{.method = Method::lengyel}, {.allocator = &allocator}}, parallel);
            evaluateIndexed(plan, {mesh.view().positions, mesh.view().normals}, {.tangents = tangents},
                            {.allocator = &allocator}, parallel);
            done = true;
        } catch (const OutOfMemory&) {
            ASSERT_LT(failures, 20);
        }
    }
    EXPECT_GT(failures, 3);
}

TEST(Threads, FindTheFirstBadIndexOfALargeMesh) {
    SimpleMesh mesh = square();
    mesh.face_sizes.clear();
    mesh.indices.assign(900'000, 1);
    std::vector<Vec4> tangents(mesh.indices.size());
    const auto run = [&](unsigned threads) {
        return generateTangents(mesh.view(), {.method = Method::lengyel, .convention = conventions::opengl},
                                {.tangents = tangents}, {.thread_count = threads});
    };
    EXPECT_TRUE(run(3));
    mesh.indices[700'001] = mesh.indices[899'999] = 4;
    for (const unsigned threads : {1u, 2u, 3u}) {
        const auto report = run(threads);
        ASSERT_FALSE(report);
        EXPECT_EQ(report.error().code, ErrorCode::indexOutOfRange);
        EXPECT_EQ(report.error().element, 700'001u);
    }
}

TEST(Threads, DoNotChangeABit) {
    std::mt19937 random(11);
    SimpleMesh mesh;
    const auto value = [&] { return static_cast<float>(random() % 2001) / 1000 - 1; };
    for (int v = 0; v < 9000; ++v) {
        const float a = value(), b = value(), c = value(), d = value(), e = value(), f = value(), g = value();
        mesh.positions.push_back({a, b, c});
        mesh.normals.push_back({d, e, f});
        mesh.uvs.push_back({g, value()});
    }
    for (int f = 0; f < 30'000; ++f) {
        const auto vertex = [&] { return static_cast<std::uint32_t>(random() % 9000); };
        const std::uint32_t a = vertex(), b = vertex(), c = vertex();
        if (f % 3 == 0)
            mesh.addFace({a, b, c, vertex()});
        else
            mesh.addFace({a, b, c});
    }
    for (const Method method : {Method::lengyel, Method::flat, Method::basis}) {
        const TangentOptions options{.method = method, .convention = conventions::opengl};
        const Outputs one = tangentsOf(mesh.view(), options);
        for (const unsigned threads : {2u, 3u, 8u}) {
            const Outputs many = tangentsOf(mesh.view(), options, {.executor = test::threadTeam(threads)});
            EXPECT_EQ(std::memcmp(one.tangents.data(), many.tangents.data(), one.tangents.size() * sizeof(Vec4)), 0);
            EXPECT_EQ(std::memcmp(one.bitangents.data(), many.bitangents.data(), one.bitangents.size() * sizeof(Vec3)),
                      0);
            EXPECT_EQ(one.magnitudes_s, many.magnitudes_s);
            EXPECT_EQ(one.magnitudes_t, many.magnitudes_t);
            EXPECT_EQ(one.report.mirrored_count, many.report.mirrored_count);
            EXPECT_EQ(one.report.degenerate_triangle_count, many.report.degenerate_triangle_count);
        }
    }
}

}  // namespace
}  // namespace tspace
