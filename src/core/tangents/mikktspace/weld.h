// SPDX-License-Identifier: MIT
// Welding: vertices with equal position, normal and UV become one node. A NaN equals its
// own bits, so that a file may store such a vertex once or twice.
#pragma once

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/tangents/mikktspace/faces.h"

namespace tspace::mikk {

/// Nodes are numbered by their first vertices, ascending. A vertex that no triangle uses has a node as well,
/// which then may have no corners.
struct Nodes {
    std::size_t count = 0;
    /// No corner has a NaN, an infinity or a huge position.
    bool all_finite = true;
    /// Some node mixes -0 and +0: the node's data are those of vertex(node), not those of any vertex of it.
    bool mixed = false;
    Buffer<std::uint32_t> of_vertex;  ///< node of each vertex; empty: no two vertices are equal, node == vertex
    /// One per node: the vertex whose data stand for it. There when `mixed`, and after
    /// listVertices; empty: node == vertex.
    Buffer<std::uint32_t> vertices;

    [[nodiscard]] std::uint32_t ofVertex(std::uint32_t vertex) const {
        return of_vertex.empty() ? vertex : of_vertex[vertex];
    }
    /// The nodes of some vertices. Returns `some` where each vertex is its own node, else writes to `to` and returns it.
    const std::uint32_t* ofVertices(const std::uint32_t* some, std::size_t some_count, std::uint32_t* to) const {
        for (std::size_t i = 0; !of_vertex.empty() && i < some_count; ++i) to[i] = of_vertex[some[i]];
        return of_vertex.empty() ? some : to;
    }
    /// Valid after listVertices.
    [[nodiscard]] std::uint32_t vertex(std::size_t node) const {
        return vertices.empty() ? static_cast<std::uint32_t>(node) : vertices[node];
    }
};

/// A mesh whose faces are cut and whose vertices are welded.
struct WeldedMesh {
    const MeshView& mesh;
    const TriangleList& triangles;
    const Nodes& nodes;

    [[nodiscard]] std::uint32_t vertexAt(std::size_t half_edge) const {
        return mesh.indices[triangles.corner(half_edge)];
    }
    [[nodiscard]] std::uint32_t nodeAt(std::size_t half_edge) const { return nodes.ofVertex(vertexAt(half_edge)); }
};

/// Memory: findRoots of core/base/weld.h; up to 4 bytes per vertex remain. `transient` allocates what does not remain; null:
/// `allocator`.
Nodes weld(const MeshView& mesh, const TriangleList& triangles, const Allocator* allocator, Parallel& parallel,
           const Allocator* transient = nullptr);

/// Makes nodes.vertex() valid.
void listVertices(Nodes& nodes, const Allocator* allocator);

}  // namespace tspace::mikk
