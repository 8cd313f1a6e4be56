// SPDX-License-Identifier: MIT
#include "tangents/mikktspace/collect.h"

namespace tspace::mikk {

Buffer<std::uint32_t> collectTriangles(const MeshView& mesh, const TriangleList& triangles, const Marks& marks,
                                       const std::uint32_t* node_of, MarkedBlocks blocks, const Allocator* allocator,
                                       Parallel& parallel) {
    const std::uint8_t* const mark = marks.data();
    const bool has_polygons = !triangles.corners.empty();
    const auto bitsOf = [&](std::size_t block) -> std::uint64_t {
        if (!has_polygons && !blocks.empty() && blocks[block] == 0) return 0;
        const std::size_t first = block * kCollectBlock, count = std::min(kCollectBlock, triangles.count - first);
        unsigned any = !has_polygons || blocks.empty() ? 1 : 0;
        for (std::size_t i = 3 * first; any == 0 && i < 3 * (first + count); ++i)
            any |= blocks[triangles.corners[i] / kBlockCorners];
        if (any == 0) return 0;
        std::uint32_t buffer[kBlockCorners];
        const std::uint32_t* const vertex = readTriangles(mesh, triangles, first, count, buffer);
        std::uint8_t marked[kCollectBlock], some = 0;
        const auto look = [&](const auto& placeOf) {
            for (std::size_t t = 0; t < count; ++t) {
                const std::uint32_t* at = vertex + 3 * t;
                some |= marked[t] = mark[placeOf(at[0])] | mark[placeOf(at[1])] | mark[placeOf(at[2])];
            }
        };
        if (node_of == nullptr) {
            look([](std::uint32_t v) { return v; });
        } else {
            look([=](std::uint32_t v) { return node_of[v]; });
        }
        std::uint64_t bits = 0;
        for (std::size_t t = 0; some != 0 && t < count; ++t) bits |= std::uint64_t{marked[t] != 0 ? 1u : 0u} << t;
        return bits;
    };
    return collectBits((triangles.count + kCollectBlock - 1) / kCollectBlock, bitsOf, allocator, parallel);
}

}  // namespace tspace::mikk
