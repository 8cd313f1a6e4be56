// SPDX-License-Identifier: MIT
#include "tangents/mikktspace/generate.h"

#include <algorithm>
#include <utility>

#include "core/scratch_block.h"
#include "tangents/mikktspace/evaluation_plan.h"
#include "tangents/mikktspace/faces.h"
#include "tangents/mikktspace/one_pass.h"
#include "tangents/mikktspace/splits.h"
#include "tangents/mikktspace/weld.h"

namespace tspace::mikk {

namespace {

/// For meshes of fewer corners the many small allocations would take a fifth of the time. A corner needs
/// about so many bytes, of which no more than a fixed number are asked for: the system takes pages of large
/// blocks back each time.
constexpr std::size_t kSmallMesh = 4096, kBytesPerCorner = 128, kLeastBlock = 8192, kLargestBlock = 98304;

/// Tangents are written last, so until then their memory can serve.
std::span<std::byte> unwritten(const TangentOutput& out) {
    if (out.tangents.stride_bytes != sizeof(Vec4)) return {};
    return {reinterpret_cast<std::byte*>(out.tangents.data), out.tangents.count * sizeof(Vec4)};
}

TangentReport generateWith(const MeshView& mesh, const TangentOptions& options, const TangentOutput& out,
                           Parallel& parallel) {
    const Allocator* allocator = options.execution.allocator;
    TriangleList triangles = cutFaces(mesh, options.ngons, allocator);
    ScratchBlock brief(allocator, unwritten(out));
    Nodes nodes = weld(mesh, triangles, allocator, parallel, brief.allocator());
    TangentOptions general = options;
    general.execution.allocator = brief.allocator();
    if (!needsReferenceOrder(mesh, general, triangles, nodes, parallel)) general.pairing = Pairing::corrected;
    general.execution.allocator = allocator;
    const bool has_threshold =
        options.method == Method::mikktspace && thresholdCosine(options.angular_threshold_deg) != -1.0f;
    if (nodes.tame && general.pairing == Pairing::corrected && !has_threshold) {
        listVertices(nodes, allocator, parallel);
        const auto report = evaluateInOnePass(mesh, options, triangles, nodes, out, brief, parallel);
        if (report) return *report;
    }
    const std::size_t count = nodes.count;
    const EvaluationPlan plan = planNodes(mesh, general, std::move(triangles), nodes, count, PlanUse::once, parallel);
    return evaluateGroups(plan, {mesh.positions, mesh.normals}, out, options.execution, parallel);
}

}  // namespace

TangentReport generateGrouped(const MeshView& mesh, const TangentOptions& options, const TangentOutput& out,
                              Parallel& parallel) {
    const std::size_t corners = mesh.cornerCount();
    if (corners > kSmallMesh) return generateWith(mesh, options, out, parallel);
    ScratchBlock scratch(options.execution.allocator, std::min(kLeastBlock + corners * kBytesPerCorner, kLargestBlock));
    TangentOptions small = options;
    small.execution.allocator = scratch.allocator();
    return generateWith(mesh, small, out, parallel);
}

}  // namespace tspace::mikk
