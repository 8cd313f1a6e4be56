// SPDX-License-Identifier: MIT
// The two entries of this folder: generateGrouped for a mesh in its own pose, planGrouped for plans of other poses.
#include "core/tangents/mikktspace/evaluation_plan.h"

#include <algorithm>
#include <utility>

#include "core/base/scratch_block.h"
#include "core/tangents/method_kind.h"
#include "core/tangents/mikktspace/collect.h"
#include "core/tangents/mikktspace/faces.h"
#include "core/tangents/mikktspace/last_bucket.h"
#include "core/tangents/mikktspace/splits.h"
#include "core/tangents/mikktspace/vertex_path.h"
#include "core/tangents/mikktspace/weld.h"

namespace tspace::mikk {

namespace {

/// Meshes of at most kSmallMesh corners take their scratch memory from one block: many small allocations would take a fifth of
/// the time. Most need kBytesPerCorner; blocks above kLargestBlock are not taken, because the system unmaps them after each
/// call. The vertex path may need more memory, which comes from the caller's allocator.
constexpr std::size_t kSmallMesh = 4096, kBytesPerCorner = 32, kLeastBlock = 4096, kLargestBlock = 98304,
                      kStackRoom = 8192;

/// The memory of the tangents, which serves as scratch memory until they are written at the end.
std::span<std::byte> unwritten(const TangentOutput& out) {
    if (out.tangents.stride_bytes != sizeof(Vec4)) return {};
    return {reinterpret_cast<std::byte*>(out.tangents.data), out.tangents.count * sizeof(Vec4)};
}

/// The last bucket, for Pairing::reference and finite meshes: the reference's order of others is not reproduced.
LastBucket lastBucketOf(const WeldedMesh& welded, const Call<TangentOptions>& options, const Allocator* transient,
                        Parallel& parallel) {
    if (!isMikktspace(options.method) || options.pairing != Pairing::reference || !welded.nodes.all_finite) return {};
    return findLastBucket(welded, transient, options.execution.allocator, parallel);
}

/// Generates by a plan for this call alone: for angular thresholds, and where one pass is not compiled in.
TangentReport planAndEvaluate(const MeshView& mesh, const Call<TangentOptions>& options, const TangentOutput& out,
                              Parallel& parallel) {
    const EvaluationPlan plan = planGrouped(mesh, options, parallel, PlanUse::once);
    return evaluateGroups(plan, {mesh.positions, mesh.normals}, mesh.uvs, out, options.execution, parallel);
}

TangentReport generateWith(const MeshView& mesh, const Call<TangentOptions>& options, const TangentOutput& out,
                           Parallel& parallel) {
    if (isMikktspace(options.method) && thresholdCosine(options.angular_threshold_deg) != -1.0f)
        return planAndEvaluate(mesh, options, out, parallel);
    const Allocator* allocator = options.execution.allocator;
    const TriangleList triangles = cutFaces(mesh, options.ngons, allocator);
    ScratchBlock transient(allocator, unwritten(out));
    Nodes nodes = weld(mesh, triangles, allocator, parallel, transient.allocator());
    const LastBucket bucket = lastBucketOf({mesh, triangles, nodes}, options, transient.allocator(), parallel);
    listVertices(nodes, allocator);
    return evaluateInOnePass({{mesh, triangles, nodes}, options, bucket}, out, transient, parallel);
}

}  // namespace

TangentReport generateGrouped(const MeshView& mesh, const Call<TangentOptions>& options, const TangentOutput& out,
                              Parallel& parallel) {
    if (!kHasOnePass) return planAndEvaluate(mesh, options, out, parallel);
    const std::size_t corners = mesh.cornerCount();
    if (corners > kSmallMesh) return generateWith(mesh, options, out, parallel);
    const std::size_t bytes = std::min(kLeastBlock + corners * kBytesPerCorner, kLargestBlock);
    const Allocator* allocator = options.execution.allocator;
    alignas(kMemoryAlignment) std::byte room[kStackRoom];
    ScratchBlock scratch =
        bytes <= kStackRoom ? ScratchBlock(allocator, std::span(room)) : ScratchBlock(allocator, bytes);
    Call<TangentOptions> small = options;
    small.execution.allocator = scratch.allocator();
    return generateWith(mesh, small, out, parallel);
}

EvaluationPlan planGrouped(const MeshView& mesh, const Call<TangentOptions>& options, Parallel& parallel, PlanUse use) {
    const Allocator* allocator = options.execution.allocator;
    TriangleList triangles = cutFaces(mesh, options.ngons, allocator);
    Nodes nodes = weld(mesh, triangles, allocator, parallel);
    const LastBucket bucket = lastBucketOf({mesh, triangles, nodes}, options, allocator, parallel);
    listVertices(nodes, allocator);
    const Buffer<std::uint32_t> all = numbersBelow(nodes.count, allocator);
    const NodeSetting setting{{mesh, triangles, nodes}, options, bucket};
    EvaluationPlan plan = planChosen({setting, {all.data(), all.size()}, true, use, parallel});
    plan.skipped_corners = std::move(triangles.skipped_corners);
    plan.report.triangle_count = triangles.count;
    plan.report.skipped_face_count = triangles.skipped_face_count;
    plan.report.reference_order_abandoned |= bucket.abandoned;
    return plan;
}

}  // namespace tspace::mikk
