// SPDX-License-Identifier: MIT
// A mesh whose faces are triangulated and whose equal vertices are welded to nodes.
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdint>
#include <span>

#include "core/base/memory.h"
#include "core/base/mesh_loops.h"
#include "core/base/parallel.h"
#include "tspace/tangents.h"

namespace tspace::mikk {

// List of the triangles of all faces, after triangulation.

/// Triangles of a mesh, including degenerate ones, in face order.
struct TriangleList {
    std::size_t count = 0;
    /// three corners of the mesh per triangle; empty: triangle t has the corners 3t, 3t+1, 3t+2
    Buffer<std::uint32_t> corners;
    Buffer<std::uint32_t> faces;  ///< face of each triangle; empty: triangle t is face t
    Buffer<std::uint32_t> skipped_corners;
    std::uint64_t skipped_face_count = 0;

    [[nodiscard]] std::uint32_t corner(std::size_t i) const {
        return corners.empty() ? static_cast<std::uint32_t>(i) : corners[i];
    }
    [[nodiscard]] std::uint32_t face(std::size_t t) const {
        return faces.empty() ? static_cast<std::uint32_t>(t) : faces[t];
    }
};

/// Returns the vertices of triangles like readTriangles, for triangulated polygons.
const std::uint32_t* readCutTriangles(const MeshView& mesh, const TriangleList& triangles, std::size_t first,
                                      std::size_t count, std::uint32_t* buffer);

/// Returns the vertices of the triangles [first, first + count), three each: a pointer into the indices if they can be
/// read in place, otherwise `buffer`.
inline const std::uint32_t* readTriangles(const MeshView& mesh, const TriangleList& triangles, std::size_t first,
                                          std::size_t count, std::uint32_t* buffer) {
    if (triangles.corners.empty()) return readIndices(mesh.indices, 3 * first, 3 * count, buffer);
    return readCutTriangles(mesh, triangles, first, count, buffer);
}

// Welded vertices: vertices with equal position, normal and UV become one node. NaNs with equal bits are equal, so the
// result does not depend on whether a file stores such a vertex once or repeatedly.

/// Nodes of a mesh, numbered by their first vertices, ascending. An unused vertex also has a node, which may then have
/// no corners.
struct Nodes {
    std::size_t count = 0;
    /// true: no corner has a NaN, an infinity or a huge position.
    bool all_finite = true;
    /// true: some nodes mix -0 and +0; the data of such a node are those of vertex(node), not those of an arbitrary
    /// vertex.
    bool mixed = false;
    Buffer<std::uint32_t> of_vertex;  ///< node of each vertex; empty: no two vertices are equal, node == vertex
    /// Vertex that provides the data of each node. Available if `mixed`, and after listVertices; empty: node == vertex.
    Buffer<std::uint32_t> vertices;

    [[nodiscard]] std::uint32_t ofVertex(std::uint32_t vertex) const {
        return of_vertex.empty() ? vertex : of_vertex[vertex];
    }
    /// Returns the nodes of some vertices: `some` itself if each vertex is its own node; otherwise writes the nodes to
    /// `to` and returns it.
    const std::uint32_t* ofVertices(const std::uint32_t* some, std::size_t some_count, std::uint32_t* to) const {
        for (std::size_t i = 0; !of_vertex.empty() && i < some_count; ++i) to[i] = of_vertex[some[i]];
        return of_vertex.empty() ? some : to;
    }
    /// Returns the vertex that provides a node's data. Valid after listVertices.
    [[nodiscard]] std::uint32_t vertex(std::size_t node) const {
        return vertices.empty() ? static_cast<std::uint32_t>(node) : vertices[node];
    }
};

/// A mesh whose faces are triangulated and whose vertices are welded.
struct WeldedMesh {
    const MeshView& mesh;
    const TriangleList& triangles;
    const Nodes& nodes;

    [[nodiscard]] std::uint32_t vertexAt(std::size_t half_edge) const {
        return mesh.indices[triangles.corner(half_edge)];
    }
    [[nodiscard]] std::uint32_t nodeAt(std::size_t half_edge) const { return nodes.ofVertex(vertexAt(half_edge)); }
};

// Collection of the triangles that have a marked vertex or node, on several threads.

inline constexpr std::size_t kCollectBlock = 64;                 ///< triangles per block, one bit each
inline constexpr std::size_t kBlockCorners = 3 * kCollectBlock;  ///< corners of the mesh in a block

/// Returns the numbers 0, 1, 2, ... below `count`.
inline Buffer<std::uint32_t> numbersBelow(std::size_t count, const Allocator* allocator) {
    Buffer<std::uint32_t> numbers(allocator, count);
    for (std::size_t i = 0; i < count; ++i) numbers[i] = static_cast<std::uint32_t>(i);
    return numbers;
}

/// Marks of vertices or nodes, one byte each: they are read in random order, where extracting a bit would cost more
/// than the additional memory.
using Marks = Buffer<std::uint8_t>;
inline Marks noMarks(const Allocator* allocator, std::size_t count) { return Marks(allocator, count, std::uint8_t{0}); }

/// Returns the triangles, ascending, with a vertex for which markOf(vertex) has a bit of `mask`. `any` receives the
/// bits of all marks.
template <class MarkOf>
Buffer<std::uint32_t> collectTriangles(const MeshView& mesh, const TriangleList& triangles, const MarkOf& markOf,
                                       std::uint32_t mask, const Allocator* allocator, Parallel& parallel,
                                       std::atomic<std::uint32_t>* any = nullptr) {
    const auto bitsOf = [&](std::size_t block) -> std::uint64_t {
        const std::size_t first = block * kCollectBlock, count = std::min(kCollectBlock, triangles.count - first);
        std::uint32_t buffer[kBlockCorners];
        const std::uint32_t* const vertex = readTriangles(mesh, triangles, first, count, buffer);
        std::uint32_t marked[kCollectBlock], some = 0;
        for (std::size_t t = 0; t < count; ++t)
            some |= marked[t] = markOf(vertex[3 * t]) | markOf(vertex[3 * t + 1]) | markOf(vertex[3 * t + 2]);
        if (any != nullptr && (some & ~any->load(std::memory_order_relaxed)) != 0)
            any->fetch_or(some, std::memory_order_relaxed);
        std::uint64_t bits = 0;
        for (auto t = (some & mask) != 0 ? count : 0; t-- > 0;) bits = 2 * bits + ((marked[t] & mask) != 0 ? 1 : 0);
        return bits;
    };
    constexpr std::size_t kGrain = 256;  // blocks per task
    const std::size_t block_count = (triangles.count + kCollectBlock - 1) / kCollectBlock;
    if (block_count == 0) return {};
    Buffer<std::uint64_t> passed(allocator, block_count);
    // for each block, first the number of its triangles, then the end of its triangles
    Buffer<std::uint32_t> ends(allocator, block_count);
    parallel.forRanges(block_count, kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t block = begin; block < end; ++block) {
            passed[block] = bitsOf(block);
            ends[block] = static_cast<std::uint32_t>(std::popcount(passed[block]));
        }
    });
    for (std::size_t block = 1; block < block_count; ++block) ends[block] += ends[block - 1];
    Buffer<std::uint32_t> found(allocator, ends[block_count - 1]);
    parallel.forRanges(block_count, kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t block = begin; block < end; ++block) {
            std::uint32_t* to = found.data() + (block == 0 ? 0 : ends[block - 1]);
            for (std::uint64_t bits = passed[block]; bits != 0; bits &= bits - 1)
                *to++ = static_cast<std::uint32_t>(kCollectBlock * block +
                                                   static_cast<std::size_t>(std::countr_zero(bits)));
        }
    });
    return found;
}

}  // namespace tspace::mikk
