// SPDX-License-Identifier: MIT
// A mesh in its own pose in one call, and a plan for others.
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

/// For meshes of fewer corners the many small allocations would take a fifth of the time. A corner mostly needs so many
/// bytes, of which no more than a fixed number are asked for: the system takes pages of large blocks back each time. The
/// vertex path may ask for more.
constexpr std::size_t kSmallMesh = 4096, kBytesPerCorner = 32, kLeastBlock = 4096, kLargestBlock = 98304,
                      kStackRoom = 8192;

/// Tangents are written last, so until then their memory can serve.
std::span<std::byte> unwritten(const TangentOutput& out) {
    if (out.tangents.stride_bytes != sizeof(Vec4)) return {};
    return {reinterpret_cast<std::byte*>(out.tangents.data), out.tangents.count * sizeof(Vec4)};
}

/// Where it is asked for. What is not finite has no order there.
LastBucket lastBucketOf(const WeldedMesh& welded, const Call<TangentOptions>& options, const Allocator* transient,
                        Parallel& parallel) {
    if (!isMikktspace(options.method) || options.pairing != Pairing::reference || !welded.nodes.all_finite) return {};
    return findLastBucket(welded, transient, options.execution.allocator, parallel);
}

/// By a plan for this call alone.
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
