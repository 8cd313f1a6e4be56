// SPDX-License-Identifier: MIT
// What a report counts does not depend on the way: in one call, or by plan and evaluation.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "core/tangents/golden_mesh.h"
#include "core/tangents/shapes.h"
#include "support/thread_team.h"

namespace tspace::test {
namespace {

float smallNumber() { return 0.5f * static_cast<float>(*rc::gen::inRange(-2, 3)); }

/// Faces of 1 to 9 corners over few vertices: corners fall together, UVs are mirrored or have no area, and
/// now and then a position or a UV is no number.
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
    for (const Method method : {Method::mikktspace, Method::uniform, Method::angle, Method::area, Method::fast,
                                Method::best, Method::lengyel, Method::flat, Method::basis}) {
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

}  // namespace
}  // namespace tspace::test
