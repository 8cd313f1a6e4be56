// SPDX-License-Identifier: MIT
// Step 5: the defect of the reference's edge list. Its edges are sorted by their lower end, then by the
// higher end, then by triangle; but the loops that do the second and third sort never reach the last bucket:
// the edges whose lower end is the largest of all. There equal edges may lie apart, and those pairs are not
// found.
#pragma once

#include "core/memory.h"
#include "tangents/mikktspace/faces.h"
#include "tangents/mikktspace/grouped_plan.h"
#include "tangents/mikktspace/pairing.h"
#include "tangents/mikktspace/weld.h"

namespace tspace::mikk {

/// The links of the last bucket's half-edges, where they may differ from those that pairing finds. Empty for
/// most meshes.
struct TailPairs {
    Buffer<std::uint32_t> half_edges;  ///< ascending
    Buffer<std::uint32_t> partners;    ///< one per half-edge; kNone: no neighbour
    Buffer<std::uint32_t> nodes;       ///< ascending: ends of these edges
    bool abandoned = false;  ///< the input drives the reference's sort into quadratic time; pairs are not known

    /// Replaces the links of a node that pairing has filled.
    void apply(std::uint32_t node, Around& around) const;
};

/// Needs plan.nodes and plan.list as listCorners left it.
TailPairs findTailPairs(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes,
                        const GroupedPlan& plan, const Allocator* allocator, Parallel& parallel);

}  // namespace tspace::mikk
