// SPDX-License-Identifier: MIT
// Which nodes the triangles of a block can have. In a mesh in natural order a block's nodes lie together, so
// whoever looks for the triangles of some nodes can pass over most blocks without reading them.
#pragma once

#include "core/memory.h"
#include "core/parallel.h"
#include "tangents/mikktspace/faces.h"

namespace tspace::mikk {

struct Nodes;

struct NodeBlocks {
    static constexpr std::size_t kTriangles = 64;  ///< of a block

    struct Range {
        std::uint32_t first, last;
    };

    Buffer<Range> ranges;    ///< one per block: all its nodes are in it; empty: not known
    bool scattered = false;  ///< consecutive triangles lie far apart in memory
    /// log2 of the nodes of a bucket (node_buckets.h), at least. Measured: 8192 nodes 97 ns per triangle, 4096
    /// 99, 16384 102, 65536 117, 1024 137. Tests ask for others.
    unsigned bucket_shift = 13;

    [[nodiscard]] bool mayUse(std::size_t block, std::uint32_t first, std::uint32_t last) const {
        return ranges.empty() || (ranges[block].last >= first && ranges[block].first <= last);
    }
};

/// For tame nodes. The ranges are left out where they would not help: few triangles, or scattered ones. Reads
/// all indices once.
NodeBlocks findNodeBlocks(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes,
                          const Allocator* allocator, Parallel& parallel);

}  // namespace tspace::mikk
