// SPDX-License-Identifier: MIT
// Sums at vertices in parallel, with the same bits for any number of tasks: each task has a range of vertices
// of its own, walks all triangles in order, and adds to its own vertices only. Here is what lets it skip most
// triangles: a mark for each block of triangles says which ranges its vertices are in.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/early_lines.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "tspace/mesh.h"

namespace tspace {

struct VertexRange {
    std::uint32_t begin = 0, end = 0;

    [[nodiscard]] bool has(std::uint32_t vertex) const { return vertex - begin < end - begin; }
};

/// Kernels read whole groups of triangles, so the last one is filled up. The triangles' vertices: `vertices`, or
/// `buffer`, which may be the same.
inline const std::uint32_t* fillGroup(const std::uint32_t* vertices, std::size_t count, std::size_t group,
                                      std::uint32_t* buffer) {
    const std::size_t end = (count + group - 1) / group * group;
    if (end == count) return vertices;
    if (vertices != buffer) std::copy_n(vertices, 3 * count, buffer);
    std::fill(buffer + 3 * count, buffer + 3 * end, buffer[0]);
    return buffer;
}

/// Vertices of some triangles as 32-bit numbers: in `buffer`, of 3 * count, where they are not that already.
inline const std::uint32_t* blockVertices(const IndexView& vertices, std::size_t first_triangle, std::size_t count,
                                          std::uint32_t* buffer) {
    const std::size_t first = 3 * first_triangle;
    if (vertices.type == IndexType::u32) return static_cast<const std::uint32_t*>(vertices.data) + first;
    for (std::size_t i = 0; i < 3 * count; ++i) buffer[i] = vertices[first + i];
    return buffer;
}

class VertexRanges {
  public:
    static constexpr std::size_t kBlock = 64;    ///< triangles
    static constexpr unsigned kMostRanges = 64;  ///< bits of a mark

    /// One range, all vertices. At least one.
    explicit VertexRanges(std::size_t vertex_count) : vertex_count_(vertex_count) {}

    /// Cuts into about `wanted` ranges. vertices(first_triangle, count, buffer) gives the vertices of a
    /// block: 3 * count numbers, in `buffer` or anywhere else.
    template <class Vertices>
    void cut(unsigned wanted, std::size_t triangle_count, const Vertices& vertices, const Allocator* allocator,
             Parallel& parallel) {
        const std::size_t most = std::clamp(wanted, 1u, kMostRanges);
        shift_ = 0;
        while (((vertex_count_ - 1) >> shift_) >= most) ++shift_;
        count_ = static_cast<unsigned>((vertex_count_ - 1) >> shift_) + 1;
        const std::size_t block_count = (triangle_count + kBlock - 1) / kBlock;
        marks_ = Buffer<std::uint64_t>(allocator, block_count);
        constexpr std::size_t kGrain = 256;
        parallel.forRanges(block_count, kGrain, [&](std::size_t begin, std::size_t end) {
            std::uint32_t buffer[3 * kBlock];
            for (std::size_t block = begin; block < end; ++block) {
                const std::size_t size = std::min(kBlock, triangle_count - block * kBlock);
                const std::uint32_t* const v = vertices(block * kBlock, size, buffer);
                askForLines(v, 3 * kBlock * sizeof *v);
                marks_[block] = markOf(v, 3 * size);
            }
        });
    }

    [[nodiscard]] unsigned count() const { return count_; }
    [[nodiscard]] VertexRange range(unsigned index) const {
        const auto edge = [&](std::uint64_t i) {
            return static_cast<std::uint32_t>(std::min<std::uint64_t>(i << shift_, vertex_count_));
        };
        return {edge(index), edge(index + 1)};
    }

    /// Whether a block names vertices of a range, and whether only those.
    [[nodiscard]] bool names(std::size_t block, unsigned range) const {
        return marks_.empty() || (marks_[block] >> range & 1) != 0;
    }
    [[nodiscard]] bool namesOnly(std::size_t block, unsigned range) const {
        return marks_.empty() || marks_[block] == std::uint64_t{1} << range;
    }

  private:
    [[nodiscard]] std::uint64_t markOf(const std::uint32_t* v, std::size_t count) const {
        std::uint32_t any = v[0], all = v[0];
        for (std::size_t i = 0; i < count; ++i) {
            any |= v[i];
            all &= v[i];
        }
        std::uint64_t mark = std::uint64_t{1} << (v[0] >> shift_);
        if ((any ^ all) >> shift_ == 0) return mark;  // mostly so, and found without a loop over bits
        for (std::size_t i = 1; i < count; ++i) mark |= std::uint64_t{1} << (v[i] >> shift_);
        return mark;
    }

    std::size_t vertex_count_;
    unsigned count_ = 1;
    unsigned shift_ = 32;          ///< a vertex v is in range v >> shift_
    Buffer<std::uint64_t> marks_;  ///< empty for one range
};

}  // namespace tspace
