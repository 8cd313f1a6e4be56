// SPDX-License-Identifier: MIT
// The order of the reference, if it affects the result: representatives of nodes, and the last bucket of its edges.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/tangents/mikktspace/welded_mesh.h"

namespace tspace::mikk {

// This file handles a bug in the reference's edge list. A bucket consists of the edges with the same smaller vertex
// index. The reference sorts all edges by their smaller index, and then each bucket by the larger index and by
// triangle; but the loops of the second and third sort never reach the last bucket, which has the largest smaller
// index. In that bucket, edges with the same two vertices may not be adjacent, and the reference then does not pair
// them. This almost never changes the result: last_bucket.cpp can prove for a mesh that it does not, without building a
// list of edges or corners.

/// The half-edges of the last bucket that the reference pairs differently than a sorted list would. Empty for most
/// meshes.
struct LastBucket {
    struct Link {
        std::uint32_t half_edge;  ///< number of the half-edge in the triangle list: 3 * triangle + k
        std::uint32_t partner;    ///< half-edge that the reference pairs it with; kNone: no neighbor
    };
    Buffer<Link> links;           ///< changed links, ascending by half-edge
    Buffer<std::uint32_t> nodes;  ///< nodes at the ends of the changed links' edges, ascending, with some repetitions
    bool abandoned = false;       ///< the input makes the reference's sort quadratic: no links were computed

    [[nodiscard]] bool concerns(std::uint32_t node) const {
        return !nodes.empty() && std::binary_search(nodes.begin(), nodes.end(), node);
    }
    /// Returns the partner of a half-edge, or null if the half-edge keeps its usual link.
    [[nodiscard]] const std::uint32_t* partnerOf(std::uint32_t half_edge) const {
        const Link* at = std::lower_bound(links.begin(), links.end(), half_edge,
                                          [](const Link& link, std::uint32_t h) { return link.half_edge < h; });
        return at == links.end() || at->half_edge != half_edge ? nullptr : &at->partner;
    }
};

/// Finds the last bucket. All nodes must be finite. Uses about two bytes per vertex, four per node, and 16 per corner
/// in a few cells of the reference's grid; usually reads all vertices and indices once. If the order of the bucket
/// matters, uses up to 60 bytes per triangle. `transient`: allocator of everything except the result.
LastBucket findLastBucket(const WeldedMesh& welded, const Allocator* transient, const Allocator* allocator,
                          Parallel& parallel);

/// Triangles of a mesh of at most 64 faces, which are all triangles, and not degenerate; valid after listVertices.
struct FewTriangles {
    const WeldedMesh& welded;
    const std::uint32_t* nodes;   ///< three nodes per triangle; fewer than 192 nodes in total
    const std::uint64_t* around;  ///< set of the triangles at each node, which may be empty
};

/// Returns whether findLastBucket may find links: a fast and nearly exact test (small_bucket.cpp).
bool lastBucketMayMatter(const FewTriangles& mesh);

}  // namespace tspace::mikk
