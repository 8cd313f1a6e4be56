// SPDX-License-Identifier: MIT
// A second look at the nodes that one pass leaves unclear: several groups, fans of too many parts,
// triangles without UV area that groups of both orientations reach, sums that do not show that nothing
// splits, corners of degenerate triangles. Their corners are listed after all and grouped node by node.
#pragma once

#include <span>

#include "tangents/mikktspace/collect.h"
#include "tangents/mikktspace/growing.h"
#include "tangents/mikktspace/node_sums.h"
#include "tspace/tangents.h"

namespace tspace::mikk {

struct WalkedNodes {
    Buffer<std::uint8_t> left;  ///< one per given node: 1 where it is left to the general steps
    std::size_t left_count = 0;
    Growing<std::uint32_t> around_left;  ///< the triangles around those, ascending
    std::uint64_t group_count = 0, default_corner_count = 0;
    std::uint64_t degenerate_count = 0, no_uv_area_count = 0,
                  mirrored_count = 0;  ///< of the triangles around all of them

    explicit WalkedNodes(const Allocator* allocator) : around_left(allocator) {}
};

/// Writes the results of all corners at `chosen` nodes (ascending), but for those of nodes that are left.
/// `chosen` must have the nodes of triangles without UV area whose three nodes may have both orientations,
/// unless no other triangle is there, and those of degenerate triangles and of faces whose triangles do not
/// simply agree (node_sums.cpp). `source` is that of the sums, by vertices. Uses the rows of `sums`; without sums
/// `chosen` must have all nodes. Takes about 210 bytes per triangle around these nodes. Throws OutOfMemory.
WalkedNodes walkNodes(const MeshView& mesh, const TangentOptions& options, const TriangleList& triangles,
                      const Nodes& nodes, std::span<const std::uint32_t> chosen, const CornerSource& source,
                      CornerTermsFunction terms, NodeSums* sums, MarkedBlocks blocks, const TangentOutput& out,
                      Parallel& parallel);

}  // namespace tspace::mikk
