// SPDX-License-Identifier: MIT
#include "tangents/mikktspace/node_blocks.h"

#include <algorithm>
#include <cstdlib>

#include "tangents/mikktspace/collect.h"
#include "tangents/mikktspace/weld.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kFew = 4096;           // triangles; to read all of them costs less
constexpr std::size_t kBlocksPerTask = 256;  // blocks

/// Judged by a sample.
bool isScattered(const MeshView& mesh, const TriangleList& triangles) {
    constexpr std::size_t kSamples = 1024;
    constexpr std::int64_t kFar = 2048;                                      // vertices
    if (triangles.count < 2 || mesh.vertexCount() < 4 * kFar) return false;  // nothing is far
    std::size_t far = 0;
    for (std::size_t i = 0; i < kSamples; ++i) {
        const std::size_t t = (triangles.count - 1) * i / kSamples;
        const std::int64_t a = mesh.indices[triangles.corner(3 * t)], b = mesh.indices[triangles.corner(3 * t + 3)];
        far += std::abs(a - b) > kFar;
    }
    return far > kSamples / 4;
}

using Range = NodeBlocks::Range;

/// The least and the largest of the numbers of [begin, end). They are below 2^31, which SSE2 can compare.
template <class NumberOf>
Range rangeOf(std::size_t begin, std::size_t end, const NumberOf& numberOf) {
    auto least = static_cast<std::int32_t>(numberOf(begin)), largest = least;
    for (std::size_t i = begin + 1; i < end; ++i) {
        const auto number = static_cast<std::int32_t>(numberOf(i));
        least = std::min(least, number);
        largest = std::max(largest, number);
    }
    return {static_cast<std::uint32_t>(least), static_cast<std::uint32_t>(largest)};
}

/// Vertices to nodes, a part of the vertices at a time: much less work than each corner's own node, and good
/// enough.
class PartsOfVertices {
  public:
    PartsOfVertices(const Nodes& nodes, const Allocator* allocator, Parallel& parallel)
        : node_count_(nodes.count), parts_(allocator, (nodes.of_vertex.size() + kPart - 1) / kPart) {
        const std::uint32_t* node_of = nodes.of_vertex.data();
        parallel.forRanges(parts_.size(), kBlocksPerTask, [&](std::size_t begin, std::size_t end) {
            for (std::size_t part = begin; part < end; ++part) {
                parts_[part] = rangeOf(part * kPart, std::min((part + 1) * kPart, nodes.of_vertex.size()),
                                       [=](std::size_t v) { return node_of[v]; });
            }
        });
    }

    [[nodiscard]] Range nodesOf(Range vertices) const {
        constexpr std::size_t kMost = 16;
        if (parts_.empty()) return vertices;
        const std::size_t first = vertices.first / kPart, last = vertices.last / kPart;
        if (last - first > kMost) return {0, static_cast<std::uint32_t>(node_count_ - 1)};
        Range range = parts_[first];
        for (std::size_t part = first + 1; part <= last; ++part) {
            range.first = std::min(range.first, parts_[part].first);
            range.last = std::max(range.last, parts_[part].last);
        }
        return range;
    }

  private:
    static constexpr std::size_t kPart = 256;
    std::size_t node_count_;
    Buffer<Range> parts_;  // none: vertices are nodes
};

}  // namespace

NodeBlocks findNodeBlocks(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes,
                          const Allocator* allocator, Parallel& parallel) {
    NodeBlocks blocks;
    blocks.scattered = isScattered(mesh, triangles);
    if (triangles.count < kFew || blocks.scattered) return blocks;
    const std::size_t count = (triangles.count + NodeBlocks::kTriangles - 1) / NodeBlocks::kTriangles;
    blocks.ranges = Buffer<NodeBlocks::Range>(allocator, count);
    const PartsOfVertices parts(nodes, allocator, parallel);
    withListedVertices(mesh, triangles, [&](auto vertexOf) {
        parallel.forRanges(count, kBlocksPerTask, [&](std::size_t first, std::size_t end) {
            for (std::size_t block = first; block < end; ++block) {
                const std::size_t begin = 3 * NodeBlocks::kTriangles * block;
                blocks.ranges[block] = parts.nodesOf(
                    rangeOf(begin, std::min(begin + 3 * NodeBlocks::kTriangles, 3 * triangles.count), vertexOf));
            }
        });
    });
    return blocks;
}

}  // namespace tspace::mikk
