// SPDX-License-Identifier: MIT
// Picks the numbers of a range that pass a test, in order, with as many threads as there are.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>

#include "core/memory.h"
#include "core/parallel.h"
#include "tangents/mikktspace/faces.h"
#include "tangents/mikktspace/growing.h"
#include "tangents/mikktspace/weld.h"

namespace tspace::mikk {

inline constexpr std::size_t kCollectBlock = NodeBlocks::kTriangles;

/// Writes the numbers of [begin, end) for which test(i) to `to`, which must have room for all; returns how
/// many.
template <class Test>
std::size_t collectBlock(std::size_t begin, std::size_t end, const Test& test, std::uint32_t* to) {
    std::size_t count = 0;  // to[count] is written in any case, and stays when the next one is written behind it
    for (std::size_t i = begin; i < end; ++i) {
        to[count] = static_cast<std::uint32_t>(i);
        count += test(i) ? 1 : 0;
    }
    return count;
}

/// Writes the numbers of the bits that are set, plus `first`, to `to`.
inline void listBits(std::uint64_t bits, std::size_t first, std::uint32_t* to) {
    for (; bits != 0; bits &= bits - 1)
        *to++ = static_cast<std::uint32_t>(first + static_cast<std::size_t>(std::countr_zero(bits)));
}

/// The numbers i of [0, count), ascending, for which test(i). mayHold(begin, end) is asked first, for each
/// block: when it says no, no test in the block may hold.
template <class Test, class MayHold>
Buffer<std::uint32_t> collect(std::size_t count, const Test& test, const MayHold& mayHold, const Allocator* allocator,
                              Parallel& parallel) {
    constexpr std::size_t kGrain = 256;  // blocks
    static_assert(kCollectBlock == 64);  // bits
    const std::size_t blocks = (count + kCollectBlock - 1) / kCollectBlock;
    if (parallel.width() == 1 || blocks < 2 * kGrain) {
        Growing<std::uint32_t> found(allocator);
        for (std::size_t block = 0; block < blocks; ++block) {
            const std::size_t begin = block * kCollectBlock, end = std::min(count, begin + kCollectBlock);
            if (!mayHold(begin, end)) continue;
            const std::size_t number = collectBlock(begin, end, test, found.extend(kCollectBlock));
            found.drop(kCollectBlock - number);
        }
        return found.exact();
    }
    Buffer<std::uint64_t> passed(allocator, blocks);  // a bit each
    Buffer<std::uint32_t> ends(allocator, blocks);    // first how many, then where they end
    parallel.forRanges(blocks, kGrain, [&](std::size_t first_block, std::size_t end_block) {
        for (std::size_t block = first_block; block < end_block; ++block) {
            const std::size_t begin = block * kCollectBlock, end = std::min(count, begin + kCollectBlock);
            std::uint64_t bits = 0;
            if (mayHold(begin, end)) {
                for (std::size_t i = begin; i < end; ++i) bits |= std::uint64_t{test(i) ? 1u : 0u} << (i - begin);
            }
            passed[block] = bits;
            ends[block] = static_cast<std::uint32_t>(std::popcount(bits));
        }
    });
    for (std::size_t block = 1; block < blocks; ++block) ends[block] += ends[block - 1];
    Buffer<std::uint32_t> found(allocator, ends[blocks - 1]);
    parallel.forRanges(blocks, kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t block = begin; block < end; ++block) {
            listBits(passed[block], kCollectBlock * block, found.data() + (block == 0 ? 0 : ends[block - 1]));
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
    if (mesh.indices.type == IndexType::none && triangles.corners.empty()) {
        return body([](std::size_t i) { return static_cast<std::uint32_t>(i); });
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
inline Marks noMarks(const Allocator* allocator, std::size_t count) {
    Marks marks(allocator, count);
    std::fill_n(marks.data(), count, std::uint8_t{0});
    return marks;
}

/// Vertices with their nodes' marks.
inline Marks marksOfVertices(Marks at_nodes, const Nodes& nodes, const Allocator* allocator, Parallel& parallel) {
    constexpr std::size_t kGrain = 65536;
    if (nodes.of_vertex.empty()) return at_nodes;
    Marks marks(allocator, nodes.of_vertex.size());
    parallel.forRanges(marks.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) marks[v] = at_nodes[nodes.of_vertex[v]];
    });
    return marks;
}

/// Which parts of the nodes have marked vertices.
class MarkedParts {
  public:
    /// nodeOf(i): the node of mark i.
    template <class NodeOf>
    MarkedParts(const Marks& marks, std::size_t node_count, const NodeOf& nodeOf, const Allocator* allocator)
        : before_(allocator, node_count / kPart + 2, 0u) {
        constexpr std::size_t kRun = 64;  // marks; of most none is set
        for (std::size_t begin = 0; begin < marks.size(); begin += kRun) {
            const std::size_t end = std::min(begin + kRun, marks.size());
            unsigned any = 0;
            for (std::size_t i = begin; i < end; ++i) any |= marks[i];
            for (std::size_t i = begin; any != 0 && i < end; ++i) {
                if (marks[i] != 0) before_[nodeOf(i) / kPart + 1] = 1;
            }
        }
        for (std::size_t part = 1; part < before_.size(); ++part) before_[part] += before_[part - 1];
    }
    /// Whether there may be marks at the nodes [first, last].
    [[nodiscard]] bool any(std::uint32_t first, std::uint32_t last) const {
        return before_[last / kPart + 1] != before_[first / kPart];
    }

  private:
    static constexpr std::size_t kPart = 64;
    Buffer<std::uint32_t> before_;  // how many parts before this one have marks
};

/// Of each block of kCollectBlock triangles, 0 when none is to be found there; empty: not known.
using MarkedBlocks = std::span<const std::uint8_t>;

/// The triangles t for which isMarked(3 * t + k) for some corner k, ascending. `parts`, where the nodes of blocks
/// are known, those with marks: where triangles of a block use nodes that lie together, it is known without a
/// look at them that none is marked.
template <class IsMarked>
Buffer<std::uint32_t> collectMarked(const TriangleList& triangles, const NodeBlocks& blocks,
                                    const std::optional<MarkedParts>& parts, const IsMarked& isMarked,
                                    MarkedBlocks marked_blocks, const Allocator* allocator, Parallel& parallel) {
    const auto anyMarked = [&](std::size_t begin, std::size_t) {
        if (!marked_blocks.empty()) return marked_blocks[begin / kCollectBlock] != 0;
        if (!parts) return true;
        const NodeBlocks::Range range = blocks.ranges[begin / NodeBlocks::kTriangles];
        return parts->any(range.first, range.last);
    };
    const auto test = [=](std::size_t t) { return (isMarked(3 * t) | isMarked(3 * t + 1) | isMarked(3 * t + 2)) != 0; };
    return collect(triangles.count, test, anyMarked, allocator, parallel);
}

/// The triangles with a corner at a marked vertex, ascending.
inline Buffer<std::uint32_t> collectTriangles(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes,
                                              const Marks& marks, MarkedBlocks blocks, const Allocator* allocator,
                                              Parallel& parallel) {
    std::optional<MarkedParts> parts;
    const auto nodeOf = [&](std::size_t v) { return nodes.ofVertex(static_cast<std::uint32_t>(v)); };
    if (blocks.empty() && !nodes.blocks.ranges.empty()) parts.emplace(marks, nodes.count, nodeOf, allocator);
    return withListedVertices(mesh, triangles, [&](auto vertexOf) {
        const std::uint8_t* marked = marks.data();
        const auto isMarked = [=](std::size_t i) -> unsigned { return marked[vertexOf(i)]; };
        return collectMarked(triangles, nodes.blocks, parts, isMarked, blocks, allocator, parallel);
    });
}

/// The triangles with a corner at a marked node, ascending. Nodes must be tame.
inline Buffer<std::uint32_t> collectAround(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes,
                                           Marks at_nodes, MarkedBlocks blocks, const Allocator* allocator,
                                           Parallel& parallel) {
    if (mesh.indices.type != IndexType::none || !triangles.corners.empty() || nodes.of_vertex.empty()) {
        const Marks marks = marksOfVertices(std::move(at_nodes), nodes, allocator, parallel);
        return collectTriangles(mesh, triangles, nodes, marks, blocks, allocator, parallel);
    }
    // Each vertex is looked at once, so there is nothing to gain from marks of vertices, which are six times as many.
    std::optional<MarkedParts> parts;
    const auto nodeOf = [](std::size_t node) { return node; };
    if (blocks.empty() && !nodes.blocks.ranges.empty()) parts.emplace(at_nodes, nodes.count, nodeOf, allocator);
    const std::uint8_t* marked = at_nodes.data();
    const std::uint32_t* node_of = nodes.of_vertex.data();
    const auto isMarked = [=](std::size_t i) -> unsigned { return marked[node_of[i]]; };
    return collectMarked(triangles, nodes.blocks, parts, isMarked, blocks, allocator, parallel);
}

}  // namespace tspace::mikk
