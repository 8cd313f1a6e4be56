// SPDX-License-Identifier: MIT
// Counts of a report, and TangentOutput::has_tangent: a single call gives the same values as a plan and its evaluation.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/tangents/golden_mesh.h"
#include "core/tangents/shapes.h"
#include "support/thread_team.h"

namespace tspace::test {
namespace {

constexpr Method kMethods[] = {Method::mikktspace, Method::uniform, Method::angle, Method::area, Method::fast,
                               Method::best,       Method::lengyel, Method::flat,  Method::basis};

float smallNumber() { return 0.5f * static_cast<float>(*rc::gen::inRange(-2, 3)); }

/// Returns faces of 1 to 9 corners over few vertices. Corners coincide, UVs are mirrored or have no area, and sometimes
/// a position or a UV is NaN.
SimpleMesh polygons() {
    SimpleMesh shape;
    const int vertices = *rc::gen::inRange(3, 24);
    const auto rarely = [](float value) { return *rc::gen::inRange(0, 40) == 0 ? std::nanf("") : value; };
    for (int v = 0; v < vertices; ++v) {
        shape.addVertex({rarely(smallNumber()), smallNumber(), smallNumber()}, {smallNumber(), smallNumber(), 1},
                        {rarely(smallNumber()), smallNumber()});
    }
    const bool triangles_only = *rc::gen::inRange(0, 4) == 0;
    for (int left = *rc::gen::inRange(1, 60); left > 0; --left) {
        std::vector<std::uint32_t> face(
            static_cast<std::size_t>(triangles_only ? 3 : *rc::gen::element(1, 2, 3, 4, 4, 5, 5, 6, 9)));
        for (auto& corner : face) corner = static_cast<std::uint32_t>(*rc::gen::inRange(0, vertices));
        if (*rc::gen::inRange(0, 4) == 0) face.back() = face.front();
        shape.addFace(face);
    }
    return shape;
}

void expectEqualCounts(const TangentReport& a, const TangentReport& b) {
    RC_ASSERT(a.triangle_count == b.triangle_count);
    RC_ASSERT(a.degenerate_triangle_count == b.degenerate_triangle_count);
    RC_ASSERT(a.degenerate_uv_count == b.degenerate_uv_count);
    RC_ASSERT(a.mirrored_count == b.mirrored_count);
    RC_ASSERT(a.skipped_face_count == b.skipped_face_count);
    RC_ASSERT(a.group_count == b.group_count);
    RC_ASSERT(a.default_corner_count == b.default_corner_count);
    RC_ASSERT(a.not_finite_count == b.not_finite_count);
    RC_ASSERT(a.reference_order_abandoned == b.reference_order_abandoned);
}

RC_GTEST_PROP(ReportCounts, AreTheSameInOneCallAndByPlanAndEvaluation, ()) {
    const SimpleMesh shape = polygons();
    const MeshView mesh = shape.view();
    for (const Method method : kMethods) {
        for (const unsigned threads : {1u, 3u}) {
            const TangentOptions options{.method = method, .convention = conventions::opengl};
            const Execution execution{.executor = test::threadTeam(threads)};
            Outputs one_call(mesh.cornerCount()), planned(mesh.cornerCount());
            const auto report = generateTangents(mesh, options, one_call.view(), execution);
            const auto plan = planTangents(mesh, options, execution);
            RC_ASSERT(report.ok() && plan.ok());
            const auto evaluated = evaluateTangents(*plan, {mesh.positions, mesh.normals}, planned.view(), execution);
            RC_ASSERT(evaluated.ok());
            expectEqualCounts(*report, *evaluated);
        }
    }
}

/// Results of a single call or of a plan, with the has_tangent mask. Its entries are initially 7, which no method
/// writes.
struct Masked {
    Outputs outputs;
    std::vector<std::uint8_t> has_tangent;
    TangentReport report;

    Masked(const MeshView& mesh, const TangentOptions& options, bool is_planned, unsigned threads)
        : outputs(options.domain == OutputDomain::vertex ? mesh.vertexCount() : mesh.cornerCount()),
          has_tangent(outputs.tangents.size(), 7) {
        const Execution execution{.executor = threadTeam(threads)};
        TangentOutput out = outputs.view();
        out.has_tangent = has_tangent;
        if (is_planned) {
            const auto plan = planTangents(mesh, options, execution);
            report = *evaluateTangents(*plan, {mesh.positions, mesh.normals}, out, execution);
        } else {
            report = *generateTangents(mesh, options, out, execution);
        }
    }
    [[nodiscard]] std::uint64_t countOf(std::uint8_t value) const {
        return static_cast<std::uint64_t>(std::count(has_tangent.begin(), has_tangent.end(), value));
    }
};

/// Returns the number of entries whose corner or vertex belongs to no used face.
std::uint64_t clearedEntries(const Masked& made) {
    return static_cast<std::uint64_t>(
        std::count_if(made.outputs.tangents.begin(), made.outputs.tangents.end(),
                      [](const Vec4& t) { return t.x == 0 && t.y == 0 && t.z == 0 && t.w == 0; }));
}

RC_GTEST_PROP(HasTangent, IsZeroForDefaultsAndClearedEntriesAlone, ()) {
    const SimpleMesh shape = polygons();
    const MeshView mesh = shape.view();
    for (const Method method : kMethods) {
        const TangentOptions options{.method = method,
                                     .convention = conventions::opengl,
                                     .ngons = *rc::gen::element(Ngons::triangulate, Ngons::skip)};
        const Masked one_call(mesh, options, false, 1), threaded(mesh, options, false, 3),
            planned(mesh, options, true, 3);
        RC_ASSERT(one_call.has_tangent == threaded.has_tangent);
        RC_ASSERT(one_call.has_tangent == planned.has_tangent);
        RC_ASSERT(one_call.countOf(0) + one_call.countOf(1) == one_call.has_tangent.size());
        RC_ASSERT(one_call.countOf(0) == one_call.report.default_corner_count + clearedEntries(one_call));
    }
}

RC_GTEST_PROP(HasTangent, IsTheSameForVerticesAndForTheirCorners, ()) {
    const SimpleMesh shape = polygons();
    const MeshView mesh = shape.view();
    for (const Method method : {Method::lengyel, Method::basis}) {
        TangentOptions options{.method = method, .convention = conventions::opengl};
        const Masked corners(mesh, options, false, 1);
        options.domain = OutputDomain::vertex;
        const Masked vertices(mesh, options, false, 1), planned(mesh, options, true, 3);
        RC_ASSERT(vertices.has_tangent == planned.has_tangent);
        RC_ASSERT(vertices.countOf(0) == vertices.report.default_corner_count + clearedEntries(vertices));
        for (std::size_t c = 0; c < mesh.cornerCount(); ++c) {
            const bool is_cleared = corners.outputs.tangents[c].w == 0;
            RC_ASSERT(is_cleared || corners.has_tangent[c] == vertices.has_tangent[mesh.indices[c]]);
        }
    }
}

TEST(HasTangent, IsZeroWhereNoTriangleOfTheVertexHasUvArea) {
    // Two separate triangles; the UVs of the second one are a single point.
    SimpleMesh shape = gridOf(2);
    const std::uint32_t a = shape.addVertex({5, 0, 0}, kUp, {0.5f, 0.5f});
    shape.addVertex({6, 0, 0}, kUp, {0.5f, 0.5f});
    shape.addVertex({5, 1, 0}, kUp, {0.5f, 0.5f});
    shape.addTriangle(a, a + 1, a + 2);
    const std::vector<std::uint8_t> expected{1, 1, 1, 1, 1, 1, 0, 0, 0};
    for (const Method method : kMethods) {
        if (method == Method::basis) continue;  // does not use UVs
        const TangentOptions options{.method = method, .convention = conventions::opengl};
        EXPECT_EQ(Masked(shape.view(), options, false, 1).has_tangent, expected) << methodName(method);
        EXPECT_EQ(Masked(shape.view(), options, true, 1).has_tangent, expected) << methodName(method);
    }
}

TEST(SkippedFaces, GetZeroFromEveryMethod) {
    SimpleMesh shape = gridOf(2);
    for (std::size_t i = 0; i < shape.indices.size(); i += 3) shape.face_sizes.push_back(3);
    shape.addFace({1, 2});
    shape.addFace({0});
    shape.addFace({0, 1, 3, 2, 1});
    const std::size_t first = 6;
    for (const Method method : kMethods) {
        for (const bool is_planned : {false, true}) {
            const TangentOptions options{.method = method, .convention = conventions::opengl, .ngons = Ngons::skip};
            const Masked made(shape.view(), options, is_planned, 1);
            for (std::size_t c = 0; c < made.has_tangent.size(); ++c) {
                EXPECT_EQ(made.has_tangent[c], c < first ? 1 : 0) << methodName(method) << ' ' << c;
                EXPECT_TRUE(c < first || made.outputs.tangents[c].w == 0) << methodName(method) << ' ' << c;
            }
        }
    }
}

TEST(HasTangent, IsStridedAndCheckedLikeTheOtherOutputs) {
    const SimpleMesh shape = someWithoutUvArea(200);
    const MeshView mesh = shape.view();
    const TangentOptions options{.convention = conventions::opengl};
    const Masked tight(mesh, options, false, 1);
    ASSERT_GT(tight.countOf(0), 0u);
    Outputs outputs(mesh.cornerCount());
    std::vector<std::uint8_t> bytes(3 * mesh.cornerCount(), 7);
    TangentOutput out = outputs.view();
    out.has_tangent = {bytes.data() + 1, mesh.cornerCount(), 3};
    ASSERT_TRUE(generateTangents(mesh, options, out).ok());
    for (std::size_t c = 0; c < mesh.cornerCount(); ++c) {
        EXPECT_EQ(bytes[3 * c + 1], tight.has_tangent[c]);
        EXPECT_EQ(bytes[3 * c], 7);
        EXPECT_EQ(bytes[3 * c + 2], 7);
    }
    --out.has_tangent.count;
    EXPECT_EQ(generateTangents(mesh, options, out).error().code, ErrorCode::countMismatch);
}

}  // namespace
}  // namespace tspace::test
