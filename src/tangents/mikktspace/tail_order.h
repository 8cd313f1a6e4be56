// SPDX-License-Identifier: MIT
// The defect of the reference's edge list. Its edges are sorted by their lower end, then by the
// higher end, then by triangle; but the loops that do the second and third sort never reach the last bucket:
// the edges whose lower end is the largest of all. There equal edges may lie apart, and those pairs are not
// found.
#pragma once

#include <algorithm>

#include "core/memory.h"
#include "tangents/mikktspace/faces.h"
#include "tangents/mikktspace/weld.h"
#include "tangents/mikktspace/words.h"

namespace tspace::mikk {

/// The links of the last bucket's half-edges, where they may differ from those that linking by nodes finds. Empty for
/// most meshes.
struct TailPairs {
    Buffer<std::uint32_t> half_edges;  ///< ascending
    Buffer<std::uint32_t> partners;    ///< one per half-edge; kNone: no neighbour
    Buffer<std::uint32_t> nodes;       ///< ascending: ends of these edges
    bool abandoned = false;  ///< the input drives the reference's sort into quadratic time; pairs are not known

    [[nodiscard]] bool concerns(std::uint32_t node) const {
        return !nodes.empty() && std::binary_search(nodes.begin(), nodes.end(), node);
    }
    /// Null when the half-edge is not in the last bucket.
    [[nodiscard]] const std::uint32_t* partnerOf(std::uint32_t half_edge) const {
        const std::uint32_t* at = std::lower_bound(half_edges.begin(), half_edges.end(), half_edge);
        return at == half_edges.end() || *at != half_edge ? nullptr : partners.data() + (at - half_edges.begin());
    }
};

/// For meshes whose values are finite.
TailPairs findTailPairs(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes,
                        const Allocator* allocator, Parallel& parallel);

}  // namespace tspace::mikk
