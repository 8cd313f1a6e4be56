// SPDX-License-Identifier: MIT
// Sums at vertices, or at points where several vertices are one, range by range: the same bits for any number of
// ranges, since each adds the triangles in their order to its own vertices only. A range's sums stay in the cache, and
// each task has ranges of its own. Here is which triangles these are: blocks, by a few ranges; core/range_lists.h lists
// those of many.
#pragma once

#include <algorithm>
#include <cstdint>

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

class VertexRanges {
  public:
    static constexpr std::size_t kBlock = 64;  ///< triangles
    static constexpr unsigned kMost = 63;      ///< ranges; a bit each, and one for what hasRepeated says

    /// One range, all points, of which there is at least one. `points`: the point of each vertex, null when each is its
    /// own.
    VertexRanges(const IndexView& vertices, std::size_t triangle_count, std::size_t point_count,
                 const std::uint32_t* points = nullptr);

    /// Whether blocks of triangles mostly name points of one range only, if points are cut into about `wanted`
    /// ranges. Looks at some blocks. Here and in cut() vertices need not have been checked.
    [[nodiscard]] bool wouldBeCompact(std::size_t wanted) const;

    /// Cuts into about `wanted` ranges, at least one. Takes 12 bytes per block, or 4 more for each further
    /// range of a block. False when there is no such vertex as a corner names. Throws OutOfMemory.
    [[nodiscard]] bool cut(std::size_t wanted, const Allocator* allocator, Parallel& parallel);

    [[nodiscard]] unsigned count() const { return count_; }
    [[nodiscard]] VertexRange range(unsigned index) const {
        const auto edge = [&](std::uint64_t i) {
            return static_cast<std::uint32_t>(i << shift_ < point_count_ ? i << shift_ : point_count_);
        };
        return {edge(index), edge(index + 1)};
    }

    /// body(block) for the blocks that name a point of the range, ascending.
    template <class Body>
    void forBlocks(unsigned range, const Body& body) const {
        if (marks_.empty()) {
            for (std::size_t block = 0; block < block_count_; ++block) body(block);
        } else {
            for (std::size_t i = begins_[range]; i < begins_[range + 1]; ++i) body(std::size_t{blocks_[i]});
        }
    }
    /// Whether a block that names points of a range names no others.
    [[nodiscard]] bool isWithinOne(std::size_t block) const {
        return marks_.empty() || (marks_[block] & (marks_[block] - 1) & ~kRepeated) == 0;
    }
    /// Whether the point of any of a block's vertices is another vertex.
    [[nodiscard]] bool hasRepeated(std::size_t block) const {
        return points_ != nullptr && (marks_.empty() || (marks_[block] & kRepeated) != 0);
    }

  private:
    static constexpr std::uint64_t kRepeated = std::uint64_t{1} << kMost;

    [[nodiscard]] std::size_t blockSize(std::size_t block) const {
        const std::size_t left = triangle_count_ - block * kBlock;
        return left < kBlock ? left : kBlock;
    }
    [[nodiscard]] unsigned shiftFor(std::size_t wanted) const;
    /// 0 when a vertex does not exist.
    [[nodiscard]] std::uint64_t markOf(std::size_t block, unsigned shift) const;
    void list(const Allocator* allocator);

    IndexView vertices_;
    std::size_t triangle_count_, block_count_, point_count_;
    std::uint32_t limit_;
    const std::uint32_t* points_;
    unsigned count_ = 1, shift_ = 32;  ///< a point p is in range p >> shift_
    Buffer<std::uint64_t> marks_;      ///< per block a bit for each of its ranges, and kRepeated; empty for one range
    Buffer<std::uint32_t> blocks_;     ///< range after range
    std::size_t begins_[kMost + 1] = {};
};

}  // namespace tspace
