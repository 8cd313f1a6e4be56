// SPDX-License-Identifier: MIT
// The vertex path: nodes whose corners are listed after all and grouped node by node. It takes those that one pass
// leaves complex: several groups, fans of too many parts, triangles without UV area that groups of both orientations
// reach, sums that do not show that nothing splits, corners of degenerate triangles, the reference's last bucket. And
// it takes all nodes, to make a plan.
#pragma once

#include <span>

#include "tangents/mikktspace/evaluation_plan.h"
#include "tangents/mikktspace/node_results.h"
#include "tangents/mikktspace/node_sums.h"

namespace tspace::mikk {

struct VertexPath {
    const NodeSetting& setting;
    const LastBucket& bucket;
    /// Ascending. They must have the nodes of triangles without UV area whose three nodes may have both orientations,
    /// unless no other triangle is there, and those of degenerate triangles and of faces whose triangles do not simply
    /// agree (node_sums.cpp).
    std::span<const std::uint32_t> chosen;
    NodeSums* sums = nullptr;  ///< the rows are used; null: `chosen` are all nodes
    MarkedBlocks blocks = {};  ///< those with a corner at a chosen node
    Parallel& parallel;
};

/// Writes the results of all corners at chosen nodes, by methods that estimate nothing. The report counts triangles around
/// these nodes, and their groups and corners. Takes about 210 bytes per triangle around these nodes. Throws OutOfMemory.
TangentReport writeNodes(const VertexPath& path);

/// A plan of the chosen nodes.
EvaluationPlan planChosen(const VertexPath& path, PlanUse use);

}  // namespace tspace::mikk
