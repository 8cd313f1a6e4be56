// SPDX-License-Identifier: MIT
// Picks the numbers of a range that pass a test, in order, with as many threads as there are.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/memory.h"
#include "core/parallel.h"
#include "tangents/mikktspace/faces.h"
#include "tangents/mikktspace/growing.h"

namespace tspace::mikk {

inline constexpr std::size_t kCollectBlock = 256;

/// Writes the numbers of [begin, end) for which test(i) to `to`, which must have room for all; returns how many.
template <class Test>
std::size_t collectBlock(std::size_t begin, std::size_t end, const Test& test, std::uint32_t* to) {
    std::size_t count = 0;  // to[count] is written in any case, and stays when the next one is written behind it
    for (std::size_t i = begin; i < end; ++i) {
        to[count] = static_cast<std::uint32_t>(i);
        count += test(i) ? 1 : 0;
    }
    return count;
}

/// The numbers i of [0, count), ascending, for which test(i). With threads the test is asked twice where it holds.
template <class Test>
Buffer<std::uint32_t> collect(std::size_t count, const Test& test, const Allocator* allocator, Parallel& parallel) {
    constexpr std::size_t kGrain = 256;  // blocks
    const std::size_t blocks = (count + kCollectBlock - 1) / kCollectBlock;
    const auto inBlock = [&](std::size_t block, std::uint32_t* to) {
        return collectBlock(block * kCollectBlock, std::min(count, (block + 1) * kCollectBlock), test, to);
    };
    if (parallel.width() == 1 || blocks < 2 * kGrain) {
        Growing<std::uint32_t> found(allocator);
        for (std::size_t block = 0; block < blocks; ++block) {
            std::uint32_t* to = found.extend(kCollectBlock);
            found.drop(kCollectBlock - inBlock(block, to));
        }
        return found.exact();
    }
    Buffer<std::uint32_t> ends(allocator, blocks);  // first how many, then where they end
    parallel.forRanges(blocks, kGrain, [&](std::size_t begin, std::size_t end) {
        std::array<std::uint32_t, kCollectBlock> unused;
        for (std::size_t block = begin; block < end; ++block)
            ends[block] = static_cast<std::uint32_t>(inBlock(block, unused.data()));
    });
    for (std::size_t block = 1; block < blocks; ++block) ends[block] += ends[block - 1];
    Buffer<std::uint32_t> found(allocator, ends[blocks - 1]);
    parallel.forRanges(blocks, kGrain, [&](std::size_t begin, std::size_t end) {
        std::array<std::uint32_t, kCollectBlock> block_found;
        for (std::size_t block = begin; block < end; ++block) {
            const std::uint32_t first = block == 0 ? 0 : ends[block - 1];
            if (first == ends[block]) continue;
            std::copy_n(block_found.data(), inBlock(block, block_found.data()), found.data() + first);
        }
    });
    return found;
}

/// Marks of vertices or nodes, a byte each: looked up in the middle of lists, where taking a bit out of a word costs more
/// than the memory does.
using Marks = Buffer<std::uint8_t>;
inline Marks noMarks(const Allocator* allocator, std::size_t count) {
    Marks marks(allocator, count);
    std::fill_n(marks.data(), count, std::uint8_t{0});
    return marks;
}

/// Calls body(vertexOf), where vertexOf(i) is the vertex of entry i of the corner list (3 per triangle). The usual kind
/// of mesh gets code of its own.
template <class Body>
auto withListedVertices(const MeshView& mesh, const TriangleList& triangles, const Body& body) {
    if (mesh.indices.type == IndexType::u32 && triangles.corners.empty()) {
        const auto* indices = static_cast<const std::uint32_t*>(mesh.indices.data);
        return body([indices](std::size_t i) { return indices[i]; });
    }
    return body([&mesh, &triangles](std::size_t i) { return mesh.indices[triangles.corner(i)]; });
}

/// The triangles of which at least `least` corners are at marked vertices, ascending.
inline Buffer<std::uint32_t> collectTriangles(const MeshView& mesh, const TriangleList& triangles, const Marks& marks,
                                              unsigned least, const Allocator* allocator, Parallel& parallel) {
    return withListedVertices(mesh, triangles, [&](auto vertexOf) {
        const std::uint8_t* marked = marks.data();
        const auto enough = [=](std::size_t t) {
            const unsigned count =
                unsigned{marked[vertexOf(3 * t)]} + marked[vertexOf(3 * t + 1)] + marked[vertexOf(3 * t + 2)];
            return count >= least;
        };
        return collect(triangles.count, enough, allocator, parallel);
    });
}

}  // namespace tspace::mikk
