// SPDX-License-Identifier: MIT
#include "tangents/mikktspace/generate.h"

#include <utility>

#include "tangents/mikktspace/evaluation_plan.h"
#include "tangents/mikktspace/faces.h"
#include "tangents/mikktspace/one_pass.h"
#include "tangents/mikktspace/splits.h"
#include "tangents/mikktspace/weld.h"

namespace tspace::mikk {

TangentReport generateGrouped(const MeshView& mesh, const TangentOptions& options, const TangentOutput& out,
                              Parallel& parallel) {
    const Allocator* allocator = options.execution.allocator;
    TriangleList triangles = cutFaces(mesh, options.ngons, allocator);
    Nodes nodes = weld(mesh, triangles, allocator, parallel);
    TangentOptions general = options;
    if (!needsReferenceOrder(mesh, options, triangles, nodes, parallel)) general.pairing = Pairing::corrected;
    const bool has_threshold =
        options.method == Method::mikktspace && thresholdCosine(options.angular_threshold_deg) != -1.0f;
    if (nodes.tame && general.pairing == Pairing::corrected && !has_threshold) {
        listVertices(nodes, allocator);
        const auto report = evaluateInOnePass(mesh, options, triangles, nodes, out, parallel);
        if (report) return *report;
    }
    const std::size_t count = nodes.count;
    const EvaluationPlan plan = planNodes(mesh, general, std::move(triangles), nodes, count, parallel);
    return evaluateGroups(plan, {mesh.positions, mesh.normals}, out, options.execution, parallel);
}

}  // namespace tspace::mikk
