// SPDX-License-Identifier: MIT
// The order of the reference, where it decides something: representatives of nodes, and the last bucket of its edges.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/tangents/mikktspace/welded_mesh.h"

namespace tspace::mikk {

// The defect of the reference's edge list. A bucket is the edges with one lower end. The reference sorts all edges by their
// lower end, and then within each bucket by the higher end and by triangle; but the loops of the second and third sort never
// reach the last bucket, whose lower end is the largest of all. There equal edges may lie apart, and the reference does not
// pair them. Nearly always that changes nothing, which last_bucket.cpp shows without a list of edges or of corners.

/// The half-edges of the last bucket that the reference pairs otherwise than a sorted list would. Empty for most meshes.
struct LastBucket {
    struct Link {
        std::uint32_t half_edge;  ///< 3 * triangle + k, of the triangle list
        std::uint32_t partner;    ///< kNone: no neighbour
    };
    Buffer<Link> links;           ///< ascending by half-edge
    Buffer<std::uint32_t> nodes;  ///< ends of these edges, ascending; some more than once
    bool abandoned = false;       ///< the input drives the reference's sort into quadratic time: no links were computed

    [[nodiscard]] bool concerns(std::uint32_t node) const {
        return !nodes.empty() && std::binary_search(nodes.begin(), nodes.end(), node);
    }
    /// Null when the half-edge keeps its usual link.
    [[nodiscard]] const std::uint32_t* partnerOf(std::uint32_t half_edge) const {
        const Link* at = std::lower_bound(links.begin(), links.end(), half_edge,
                                          [](const Link& link, std::uint32_t h) { return link.half_edge < h; });
        return at == links.end() || at->half_edge != half_edge ? nullptr : &at->partner;
    }
};

/// Nodes must be all finite. Takes about two bytes per vertex, four per node, and 16 per corner in a few cells of the
/// reference's grid; mostly reads all vertices and indices once. Where the order of the bucket matters, up to 60 bytes per
/// triangle. `transient`: allocates all but the result.
LastBucket findLastBucket(const WeldedMesh& welded, const Allocator* transient, const Allocator* allocator,
                          Parallel& parallel);

/// A mesh of at most 64 triangles, which are its faces, none of them degenerate; valid after listVertices.
struct FewTriangles {
    const WeldedMesh& welded;
    const std::uint32_t* nodes;   ///< three per triangle; fewer than 192 in all
    const std::uint64_t* around;  ///< one per node: the set of its triangles, which may be empty
};

/// Whether findLastBucket may find links. A quick and nearly exact test (small_bucket.cpp).
bool lastBucketMayMatter(const FewTriangles& mesh);

}  // namespace tspace::mikk
