// SPDX-License-Identifier: MIT
// Picks the numbers of a range that pass a test, in order, with as many threads as there are.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "core/memory.h"
#include "core/parallel.h"
#include "tangents/mikktspace/faces.h"
#include "tangents/mikktspace/growing.h"

namespace tspace::mikk {

inline constexpr std::size_t kCollectBlock = 256;

/// Writes the numbers of [begin, end) for which test(i) to `to`, which must have room for all; returns how
/// many.
template <class Test>
std::size_t collectBlock(std::size_t begin, std::size_t end, const Test& test, std::uint32_t* to) {
    std::size_t count =
        0;  // to[count] is written in any case, and stays when the next one is written behind it
    for (std::size_t i = begin; i < end; ++i) {
        to[count] = static_cast<std::uint32_t>(i);
        count += test(i) ? 1 : 0;
    }
    return count;
}

/// The numbers i of [0, count), ascending, for which test(i). mayHold(begin, end) is asked first, for each
/// block: when it says no, no test in the block may hold. With threads the tests are asked twice in blocks
/// where one holds.
template <class Test, class MayHold>
Buffer<std::uint32_t> collect(std::size_t count, const Test& test, const MayHold& mayHold,
                              const Allocator* allocator, Parallel& parallel) {
    constexpr std::size_t kGrain = 256;  // blocks
    const std::size_t blocks = (count + kCollectBlock - 1) / kCollectBlock;
    const auto inBlock = [&](std::size_t block, std::uint32_t* to) {
        const std::size_t begin = block * kCollectBlock, end = std::min(count, begin + kCollectBlock);
        return mayHold(begin, end) ? collectBlock(begin, end, test, to) : 0;
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

/// Calls body(vertexOf), where vertexOf(i) is the vertex of entry i of the corner list (3 per triangle). The
/// usual kinds of mesh get code of their own.
template <class Body>
auto withListedVertices(const MeshView& mesh, const TriangleList& triangles, const Body& body) {
    if (mesh.indices.type == IndexType::u32 && triangles.corners.empty()) {
        const auto* indices = static_cast<const std::uint32_t*>(mesh.indices.data);
        return body([indices](std::size_t i) { return indices[i]; });
    }
    if (mesh.indices.type == IndexType::none && triangles.corners.empty()) {
        return body([](std::size_t i) { return static_cast<std::uint32_t>(i); });
    }
    return body([&mesh, &triangles](std::size_t i) { return mesh.indices[triangles.corner(i)]; });
}

/// Marks of vertices or nodes, a byte each: looked up in the middle of lists, where taking a bit out of a
/// word costs more than the memory does.
using Marks = Buffer<std::uint8_t>;
inline Marks noMarks(const Allocator* allocator, std::size_t count) {
    Marks marks(allocator, count);
    std::fill_n(marks.data(), count, std::uint8_t{0});
    return marks;
}

/// Which parts of some marks have any.
class MarkedParts {
  public:
    MarkedParts(const Marks& marks, const Allocator* allocator)
        : before_(allocator, marks.size() / kPart + 2) {
        before_[0] = 0;
        for (std::size_t part = 0; part + 1 < before_.size(); ++part) {
            const std::size_t end = std::min((part + 1) * kPart, marks.size());
            unsigned any = 0;
            for (std::size_t i = part * kPart; i < end; ++i) any |= marks[i];
            before_[part + 1] = before_[part] + (any != 0 ? 1u : 0u);
        }
    }
    /// Whether there may be marks in [first, last]; the last may be beyond the end.
    [[nodiscard]] bool any(std::size_t first, std::size_t last) const {
        return before_[std::min(last / kPart + 1, before_.size() - 1)] != before_[first / kPart];
    }

  private:
    static constexpr std::size_t kPart = 256;
    Buffer<std::uint32_t> before_;  // how many parts before this one have marks
};

/// The triangles of which at least `least` corners, not 0, are at marked vertices; ascending. Where triangles
/// of a block use vertices that lie together, few instructions show that none is marked.
inline Buffer<std::uint32_t> collectTriangles(const MeshView& mesh, const TriangleList& triangles,
                                              const Marks& marks, unsigned least, const Allocator* allocator,
                                              Parallel& parallel) {
    const MarkedParts parts(marks, allocator);
    return withListedVertices(mesh, triangles, [&](auto vertexOf) {
        const std::uint8_t* marked = marks.data();
        const auto enough = [=](std::size_t t) {
            const unsigned count =
                unsigned{marked[vertexOf(3 * t)]} + marked[vertexOf(3 * t + 1)] + marked[vertexOf(3 * t + 2)];
            return count >= least;
        };
        // All numbers of a block agree in the bits above the highest in which any two differ.
        const auto anyMarked = [=, &parts](std::size_t begin, std::size_t end) {
            std::uint32_t all = 0xffffffffu, some = 0;
            for (std::size_t i = 3 * begin; i < 3 * end; ++i) {
                const std::uint32_t vertex = vertexOf(i);
                all &= vertex;
                some |= vertex;
            }
            const std::uint64_t span = std::bit_ceil(std::uint64_t{all ^ some} + 1);
            return parts.any(all & ~(span - 1), some | (span - 1));
        };
        return collect(triangles.count, enough, anyMarked, allocator, parallel);
    });
}

}  // namespace tspace::mikk
