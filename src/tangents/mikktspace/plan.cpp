// SPDX-License-Identifier: MIT
// The plan of the grouping methods: the steps in their order, one file each.
#include <algorithm>

#include "tangents/mikktspace/corner_lists.h"
#include "tangents/mikktspace/evaluation_plan.h"
#include "tangents/mikktspace/faces.h"
#include "tangents/mikktspace/grouped_plan.h"
#include "tangents/mikktspace/groups.h"
#include "tangents/mikktspace/growing.h"
#include "tangents/mikktspace/slot_writes.h"
#include "tangents/mikktspace/splits.h"
#include "tangents/mikktspace/tail_check.h"
#include "tangents/mikktspace/tail_order.h"
#include "tangents/mikktspace/triangle_pass.h"
#include "tangents/mikktspace/weld.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kGrain = 4096;  // nodes

void readNodes(const MeshView& mesh, Nodes& nodes, GroupedPlan& plan, PoseData& pose, const Allocator* allocator,
               Parallel& parallel) {
    listVertices(nodes, allocator, parallel);
    plan.node_count = nodes.count;
    plan.node_vertex = Buffer<std::uint32_t>(allocator, nodes.count);
    plan.node_uv = Buffer<Vec2>(allocator, nodes.count);
    pose.positions = Buffer<Vec3>(allocator, nodes.count);
    parallel.forRanges(nodes.count, kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
            const std::uint32_t vertex = nodes.vertex(n);
            plan.node_vertex[n] = vertex;
            plan.node_uv[n] = mesh.uvs[vertex];
            pose.positions[n] = mesh.positions[vertex];
        }
    });
}

/// Finds the first good corner of the nodes that corners of degenerate triangles copy from; kNone when there
/// is none.
void resolveCopies(const GroupedPlan& plan, TrianglePass& pass) {
    for (Copy& copy : pass.copies) {
        if ((copy.from & kMark) == 0) continue;
        const std::uint32_t node = copy.from & kValue, begin = plan.node_begin[node];
        copy.from = begin < plan.node_begin[node + 1] ? plan.slot(plan.list[begin]) : kNone;
    }
}

}  // namespace

EvaluationPlan planGrouped(const MeshView& mesh, const TangentOptions& options, Parallel& parallel) {
    const Allocator* allocator = options.execution.allocator;
    TriangleList triangles = cutFaces(mesh, options.ngons, allocator);
    Nodes nodes = weld(mesh, triangles, allocator, parallel);
    TangentOptions needed = options;
    if (!needsReferenceOrder(mesh, options, triangles, nodes, parallel)) needed.pairing = Pairing::corrected;
    return planNodes(mesh, needed, std::move(triangles), nodes, nodes.count, PlanUse::kept, parallel);
}

bool needsReferenceOrder(const MeshView& mesh, const TangentOptions& options, const TriangleList& triangles,
                         const Nodes& nodes, Parallel& parallel) {
    return options.method == Method::mikktspace && options.pairing == Pairing::reference &&
           tailMayMatter(mesh, triangles, nodes, options.execution.allocator, parallel);
}

EvaluationPlan planNodes(const MeshView& mesh, const TangentOptions& options, TriangleList triangles, Nodes& nodes,
                         std::size_t listed_count, PlanUse use, Parallel& parallel) {
    const Allocator* allocator = options.execution.allocator;
    const bool is_mikktspace = options.method == Method::mikktspace;
    GroupedPlan plan;
    plan.method = options.method;
    // The UV determinant speaks of the side that cross(P1-P0, P2-P0) points to; the sign must speak of N's
    // side.
    plan.bitangent_factor = signFactor(options.convention);
    plan.sign_factor = plan.bitangent_factor * normalFactor(options.convention);
    plan.vertex_count = mesh.vertexCount();
    plan.corner_count = mesh.cornerCount();

    plan.skipped_corners = std::move(triangles.skipped_corners);
    plan.report.triangle_count = triangles.count;
    plan.report.skipped_face_count = triangles.skipped_face_count;
    plan.listed_count = listed_count;
    PoseData pose;
    readNodes(mesh, nodes, plan, pose, allocator, parallel);
    TrianglePass pass = passTriangles(mesh, triangles, nodes, plan, pose, allocator, parallel);
    listCorners(plan, allocator);
    TailPairs tail;
    if (is_mikktspace && options.pairing == Pairing::reference) {
        tail = findTailPairs(mesh, triangles, nodes, plan, allocator, parallel);
        plan.report.reference_order_abandoned = tail.abandoned;
    }
    resolveCopies(plan, pass);
    formGroups(plan, tail, allocator, parallel);
    if (is_mikktspace) {
        const Pose own{mesh.positions, mesh.normals};
        findSplits(plan, thresholdCosine(options.angular_threshold_deg), own, pose, pass.faces, allocator, parallel);
    }
    planSlotWrites(plan, pass, allocator);
    pose = {};
    return makeEvaluationPlan(std::move(plan), mesh, use, allocator, parallel);
}

}  // namespace tspace::mikk
