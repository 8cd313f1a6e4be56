// SPDX-License-Identifier: MIT
// Collects the triangles that have a marked vertex or node, with several threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdint>
#include <span>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/tangents/mikktspace/faces.h"
#include "core/tangents/mikktspace/weld.h"

namespace tspace::mikk {

inline constexpr std::size_t kCollectBlock = 64;                 ///< triangles, a bit each
inline constexpr std::size_t kBlockCorners = 3 * kCollectBlock;  ///< of the mesh

/// 0, 1, 2, ...
inline Buffer<std::uint32_t> numbersBelow(std::size_t count, const Allocator* allocator) {
    Buffer<std::uint32_t> numbers(allocator, count);
    for (std::size_t i = 0; i < count; ++i) numbers[i] = static_cast<std::uint32_t>(i);
    return numbers;
}

/// Marks of vertices or nodes, a byte each: they are read in random order, where extracting a bit costs more than the memory.
using Marks = Buffer<std::uint8_t>;
inline Marks noMarks(const Allocator* allocator, std::size_t count) { return Marks(allocator, count, std::uint8_t{0}); }

/// The triangles, ascending, with a vertex for which markOf(vertex) has a bit of `mask`. `any` gets the bits of all marks.
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
    constexpr std::size_t kGrain = 256;  // blocks
    const std::size_t block_count = (triangles.count + kCollectBlock - 1) / kCollectBlock;
    if (block_count == 0) return {};
    Buffer<std::uint64_t> passed(allocator, block_count);
    Buffer<std::uint32_t> ends(allocator, block_count);  // counts first, then where each block's triangles end
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
