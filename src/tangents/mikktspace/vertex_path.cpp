// SPDX-License-Identifier: MIT
#include "tangents/mikktspace/vertex_path.h"

#include <atomic>
#include <utility>

#include "tangents/method_kind.h"
#include "tangents/mikktspace/node_results.h"
#include "tangents/mikktspace/splits.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kNodeGrain = 512;

/// Terms are read where they decide on something.
VertexCorners read(const VertexPath& path, bool needs_sums) {
    const NodeSetting& setting = path.setting;
    const bool tangents_only = !setting.maySplit() && !setting.hasPolygons() && wantsTangentsOnly(setting.out);
    CornerSource source = cornerSource({setting.mesh.positions, setting.mesh.normals}, setting.mesh.uvs,
                                       setting.options.method, tangents_only);
    source.adding_only = true;
    if (!needs_sums && !setting.maySplit()) source.weighting = Weighting::none;
    return readCorners(path, source);
}

/// Corners of degenerate triangles: what they copy, or the default where that is one or where there is nothing to copy.
/// `is_default`: one per corner of the mesh.
void planCopies(const Growing<Copy>& copies, Marks& is_default, const Allocator* allocator, EvaluationPlan& plan) {
    if (copies.empty()) return;
    for (const std::uint32_t corner : plan.default_corners) is_default[corner] = 1;
    Growing<std::uint32_t> defaults(allocator);
    std::copy_n(plan.default_corners.data(), plan.default_corners.size(), defaults.extend(plan.default_corners.size()));
    Growing<Copy> kept(allocator);
    for (const Copy& copy : copies) {
        if (copy.from == kNone || is_default[copy.from] != 0) {
            defaults.push(copy.to);
        } else {
            kept.push(copy);
        }
    }
    plan.copies = kept.exact();
    plan.default_corners = defaults.exact();
    plan.report.default_corner_count = plan.default_corners.size();
}

float cosineOf(const TangentOptions& options) {
    return isMikktspace(options.method) ? thresholdCosine(options.angular_threshold_deg) : -1.0f;
}

Marks cornerMarks(const VertexPath& path, const VertexCorners& corners) {
    const Allocator* allocator = path.setting.options.execution.allocator;
    return corners.copies.empty() ? Marks{} : noMarks(allocator, path.setting.mesh.cornerCount());
}

}  // namespace

TangentReport writeNodes(const VertexPath& path) {
    const NodeSetting& setting = path.setting;
    const Allocator* allocator = setting.options.execution.allocator;
    const float threshold_cosine = cosineOf(setting.options);
    VertexCorners corners = read(path, true);
    const Grouping grouping(path, corners);
    Marks is_default = cornerMarks(path, corners);
    const NodeResults results(path, corners, threshold_cosine, is_default);
    Marks left(allocator, path.chosen.size());  // 1: needs a plan
    std::atomic<std::uint64_t> groups{0}, default_corners{0}, left_count{0};
    path.parallel.forRanges(left.size(), kNodeGrain, [&](std::size_t begin, std::size_t end) {
        GroupRoom room;
        NodeCounts counts;
        std::uint64_t left_here = 0;
        for (std::size_t place = begin; place < end; ++place) {
            const bool is_small = corners.around(place).size() <= kSmallNode;
            const bool written = is_small && results.write(place, grouping.groupsOf(place, room), counts);
            left[place] = written ? 0 : 1;
            left_here += written ? 0 : 1;
        }
        groups += counts.groups;
        default_corners += counts.default_corners;
        left_count += left_here;
    });
    TangentReport report = corners.report;
    if (left_count != 0 || !corners.copies.empty()) {
        EvaluationPlan plan =
            planNodes({path, corners, grouping, {left.data(), left.size()}, threshold_cosine, PlanUse::once});
        planCopies(corners.copies, is_default, allocator, plan);
        report = evaluateGroups(plan, {setting.mesh.positions, setting.mesh.normals}, setting.mesh.uvs, setting.out,
                                setting.options.execution, path.parallel);
    }
    report.group_count += groups;
    report.default_corner_count += default_corners;
    return report;
}

EvaluationPlan planChosen(const VertexPath& path, PlanUse use) {
    const NodeSetting& setting = path.setting;
    const Allocator* allocator = setting.options.execution.allocator;
    VertexCorners corners = read(path, false);
    const Grouping grouping(path, corners);
    EvaluationPlan plan = planNodes({path, corners, grouping, {}, cosineOf(setting.options), use});
    Marks is_default = cornerMarks(path, corners);
    planCopies(corners.copies, is_default, allocator, plan);
    plan.triangles = std::move(corners.found);
    return plan;
}

}  // namespace tspace::mikk
