// SPDX-License-Identifier: MIT
// Marks of vertices and nodes, and the triangles that have them, with as many threads as there are.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include "core/memory.h"
#include "core/parallel.h"
#include "tangents/mikktspace/faces.h"
#include "tangents/mikktspace/weld.h"

namespace tspace::mikk {

inline constexpr std::size_t kCollectBlock = 64;                 ///< triangles, a bit each
inline constexpr std::size_t kBlockCorners = 3 * kCollectBlock;  ///< of the mesh

/// The numbers of the bits that are set, ascending: bitsOf(block) has kCollectBlock of them for each block.
template <class BitsOf>
Buffer<std::uint32_t> collectBits(std::size_t block_count, const BitsOf& bitsOf, const Allocator* allocator,
                                  Parallel& parallel) {
    constexpr std::size_t kGrain = 256;  // blocks
    if (block_count == 0) return {};
    Buffer<std::uint64_t> passed(allocator, block_count);
    Buffer<std::uint32_t> ends(allocator, block_count);  // first how many, then where they end
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

/// 0, 1, 2, ...
inline Buffer<std::uint32_t> numbersBelow(std::size_t count, const Allocator* allocator) {
    Buffer<std::uint32_t> numbers(allocator, count);
    for (std::size_t i = 0; i < count; ++i) numbers[i] = static_cast<std::uint32_t>(i);
    return numbers;
}

/// Calls body(vertexOf), where vertexOf(i) is the vertex of entry i of the corner list (3 per triangle). The
/// usual kinds of mesh get code of their own.
template <class Body>
auto withListedVertices(const MeshView& mesh, const TriangleList& triangles, const Body& body) {
    if (mesh.indices.type == IndexType::u32 && triangles.corners.empty()) {
        const auto* indices = static_cast<const std::uint32_t*>(mesh.indices.data);
        return body([indices](std::size_t i) { return indices[i]; });
    }
    if (mesh.indices.type == IndexType::u32) {
        const auto* indices = static_cast<const std::uint32_t*>(mesh.indices.data);
        const std::uint32_t* corners = triangles.corners.data();
        return body([indices, corners](std::size_t i) { return indices[corners[i]]; });
    }
    return body([&mesh, &triangles](std::size_t i) { return mesh.indices[triangles.corner(i)]; });
}

/// Marks of vertices or nodes, a byte each: looked up in the middle of lists, where taking a bit out of a
/// word costs more than the memory does.
using Marks = Buffer<std::uint8_t>;
inline Marks noMarks(const Allocator* allocator, std::size_t count) { return Marks(allocator, count, std::uint8_t{0}); }

/// Of each block of kBlockCorners corners of the mesh, 0 when none is at a marked vertex or node; empty: not known.
using MarkedBlocks = std::span<const std::uint8_t>;

/// The triangles with a corner at a marked vertex, ascending; with a corner at a marked node, where `node_of` is not
/// null, which has the node of each vertex.
Buffer<std::uint32_t> collectTriangles(const MeshView& mesh, const TriangleList& triangles, const Marks& marks,
                                       const std::uint32_t* node_of, MarkedBlocks blocks, const Allocator* allocator,
                                       Parallel& parallel);

/// By marked nodes.
inline Buffer<std::uint32_t> collectAround(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes,
                                           const Marks& marks, MarkedBlocks blocks, const Allocator* allocator,
                                           Parallel& parallel) {
    return collectTriangles(mesh, triangles, marks, nodes.of_vertex.data(), blocks, allocator, parallel);
}

}  // namespace tspace::mikk
