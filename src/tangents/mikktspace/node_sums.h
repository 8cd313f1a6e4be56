// SPDX-License-Identifier: MIT
// The sums of all nodes, filled by one pass over the triangles in their order.
#pragma once

#include "core/parallel.h"
#include "core/scratch_block.h"
#include "tangents/mikktspace/corner_terms.h"
#include "tangents/mikktspace/faces.h"
#include "tangents/mikktspace/fan.h"
#include "tangents/mikktspace/grouped_plan.h"
#include "tangents/mikktspace/weld.h"

namespace tspace::mikk {

/// What is known of a node: half a cache line.
struct alignas(32) NodeSum {
    float s[4] = {0, 0, 0, 0};  ///< sum of weighted tangents, and of weights
    Fan fan;
};

/// The rest, when more than tangents is asked for.
struct alignas(16) NodeRest {
    float t[4] = {0, 0, 0, 0};  ///< sum of weighted bitangents, and of weighted |dP/du|
};

struct NodeSums {
    Buffer<NodeSum> nodes;
    Buffer<std::uint16_t> marks;  ///< one per node: those that all its corners have (corner_terms.h); 0: left
                                  ///< aside, as all nodes of degenerate triangles are
    Buffer<NodeRest> rest;        ///< empty when tangents_only
    Buffer<float> lengths_t;      ///< sums of weighted |dP/dv|; empty when tangents_only
    /// Triangles without usable UV area. They add nothing, and mark nothing, but link what lies on both
    /// sides.
    Buffer<std::uint8_t> flat;  ///< one per triangle: 1 for those; brief
    bool scattered = false;     ///< consecutive triangles lie far apart in memory
    std::uint64_t degenerate_count = 0, no_uv_area_count = 0, mirrored_count = 0;

    /// Whether no triangle adds to the node: there are none, or all are flat.
    [[nodiscard]] bool isEmpty(std::size_t node) const {
        return (marks[node] & (kFacesUp | kFacesDown)) == (kFacesUp | kFacesDown);
    }
    /// Whether all corners of the node are one group. `may_split`: the reference's angular test applies to
    /// it.
    [[nodiscard]] bool isOneGroup(std::size_t node, const Vec3& normal, bool may_split) const;
};

/// Whether a sum of several tangents and their weights (corner_terms.h), and the marks that they have in
/// common, show that the angular test separates none of them.
bool sumCannotSplit(const float* sum, std::uint32_t marks, const Vec3& normal);

/// `nodes` must be tame, and nodes.vertex() valid. `brief`: for what is not needed any more when tangents are
/// written; with 32 bytes per node in it, triangles in random order are read faster.
NodeSums sumNodes(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes, const CornerSource& source,
                  CornerTermsFunction terms, ScratchBlock& brief, const Allocator* allocator, Parallel& parallel);

}  // namespace tspace::mikk
