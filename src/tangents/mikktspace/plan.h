// SPDX-License-Identifier: MIT
// Groups written down as a plan, which can be evaluated in any pose (evaluation_plan.h).
#pragma once

#include "tangents/mikktspace/evaluation_plan.h"
#include "tangents/mikktspace/groups.h"
#include "tangents/mikktspace/node_results.h"
#include "tangents/plan_use.h"

namespace tspace::mikk {

/// What a plan is made from.
struct PlanSource {
    const NodeSetting& setting;
    std::span<const std::uint32_t> chosen;  ///< the nodes that the corners are read of
    const VertexCorners& corners;
    const Grouping& grouping;
    std::span<const std::uint8_t> planned;  ///< one per chosen node: 1 where it is planned; empty: all are
    float threshold_cosine = -1;
    PlanUse use = PlanUse::kept;
};

/// The plan of some nodes. Skipped corners are left out, and corners of degenerate triangles; of these, the report has
/// only groups and default corners. Throws OutOfMemory.
EvaluationPlan planNodes(const PlanSource& source);

}  // namespace tspace::mikk
