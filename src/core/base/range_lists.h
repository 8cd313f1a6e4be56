// SPDX-License-Identifier: MIT
// Owner computes: which triangles have corners in which range of groups (vertices, points, groups of corners). The data
// of all groups do not fit into a cache, and each group has one writer only; so ranges are worked on one after the
// other, or by different threads, each with the triangles that are listed for it, in their order. Results have equal
// bits for any number of ranges and threads.
#pragma once

#include <algorithm>
#include <span>

#include "core/base/memory.h"
#include "core/base/parallel.h"

namespace tspace {

/// The triangles of a call, in order, and the group that each corner adds to.
class TriangleGroups {
  public:
    explicit TriangleGroups(std::size_t triangle_count) : count(triangle_count) {}
    TriangleGroups(const TriangleGroups&) = delete;
    TriangleGroups& operator=(const TriangleGroups&) = delete;

    /// Writes three numbers per triangle to both; `vertices` may be null. A number that is no group (2^31 or
    /// more, and above all groups) means that nothing is added.
    virtual void read(std::size_t first, std::size_t triangles, std::uint32_t* vertices,
                      std::uint32_t* groups) const = 0;
    /// read() for any list of triangles.
    virtual void readSome(const std::uint32_t* numbers, std::size_t size, std::uint32_t* vertices,
                          std::uint32_t* groups) const {
        for (std::size_t i = 0; i < size; ++i)
            read(numbers[i], 1, vertices == nullptr ? nullptr : vertices + 3 * i, groups + 3 * i);
    }
    /// Pointer to the groups of these triangles, where they lie in memory and equal the vertices; else null.
    [[nodiscard]] virtual const std::uint32_t* inPlace(std::size_t, std::size_t) const { return nullptr; }

    const std::size_t count;

  protected:
    ~TriangleGroups() = default;
};

/// Kernels read whole groups of triangles: fills the last group with a valid vertex. Returns `vertices` where that is
/// not needed, else `buffer`, which may be the same.
inline const std::uint32_t* fillGroup(const std::uint32_t* vertices, std::size_t count, std::size_t group,
                                      std::uint32_t* buffer) {
    const std::size_t end = (count + group - 1) / group * group;
    if (end == count) return vertices;
    if (vertices != buffer) std::copy_n(vertices, 3 * count, buffer);
    std::fill(buffer + 3 * count, buffer + 3 * end, buffer[0]);
    return buffer;
}

/// Triangles that a kernel works on together. Beyond `count` the own arrays have stale entries.
struct TriangleBatch {
    static constexpr std::size_t kMost = 64;

    std::size_t count = 0;
    bool is_block = false;  ///< the triangles follow one another
    bool is_whole = false;  ///< and all their groups are in the range (or no groups)
    const std::uint32_t *vertices = own_vertices, *groups = own_groups;
    std::uint32_t numbers[kMost];  ///< of a block only the first number
    std::uint32_t own_vertices[3 * kMost], own_groups[3 * kMost];

    [[nodiscard]] std::uint32_t number(std::size_t t) const {
        return is_block ? numbers[0] + static_cast<std::uint32_t>(t) : numbers[t];
    }

    TriangleBatch() {}  // NOLINT: without zeros
    TriangleBatch(const TriangleBatch&) = delete;
    TriangleBatch& operator=(const TriangleBatch&) = delete;
};

struct GroupRange {
    std::uint32_t begin = 0, end = 0;

    [[nodiscard]] bool has(std::uint32_t group) const { return group - begin < end - begin; }
    [[nodiscard]] std::size_t size() const { return end - begin; }
};

class RangeLists {
  public:
    /// Ranges of `range_size` groups, a power of two; blocks of `block_size` triangles, at most TriangleBatch::kMost. Lists
    /// nothing: each range has all triangles, which suits one range, and few where triangles are in no order.
    RangeLists(std::size_t block_size, std::size_t group_count, std::size_t range_size)
        : block_size_(block_size),
          group_count_(group_count),
          range_size_(range_size),
          count_((group_count + range_size - 1) / range_size) {}

    /// Lists the triangles of each range, if there are several. Takes 4 bytes per triangle at the border of two ranges, or up
    /// to 12 where triangles are in no order. Linear. Throws OutOfMemory.
    RangeLists(const TriangleGroups& triangles, std::size_t block_size, std::size_t group_count, std::size_t range_size,
               const Allocator* allocator, Parallel& parallel);

    /// Whether most blocks add to one range only, by a sample of 64 blocks.
    static bool areCompact(const TriangleGroups& triangles, std::size_t block_size, std::size_t group_count,
                           std::size_t range_size);

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] GroupRange range(std::size_t index) const {
        const std::size_t end = std::min((index + 1) * range_size_, group_count_);
        return {static_cast<std::uint32_t>(index * range_size_), static_cast<std::uint32_t>(end)};
    }
    /// How many triangles a range has at most.
    [[nodiscard]] std::size_t mostTriangles(std::size_t all) const;

    [[nodiscard]] std::size_t blockCount(std::size_t triangle_count) const {
        return (triangle_count + block_size_ - 1) / block_size_;
    }

    /// The triangles of a range, ascending, batch after batch.
    class Batches {
      public:
        Batches(const TriangleGroups& triangles, const RangeLists& lists, std::size_t range);
        /// All triangles of some blocks, whatever their groups.
        Batches(const TriangleGroups& triangles, std::size_t block_size, std::size_t begin, std::size_t end)
            : triangles_(triangles), block_size_(block_size), next_(begin), end_(end) {}
        /// False when there are no more. `wants_vertices`: or groups alone.
        bool next(TriangleBatch& batch, bool wants_vertices = true);

      private:
        const TriangleGroups& triangles_;
        std::size_t block_size_;
        const std::uint32_t* entries_ = nullptr;  ///< null: all blocks
        bool are_whole_ = true;                   ///< the blocks
        std::size_t next_, end_;                  ///< entries or blocks
    };

    /// The list of a range, ascending: blocks that add to this range alone, with kBlock; single triangles of other
    /// blocks.
    static constexpr std::uint32_t kBlock = 0x80000000u;
    [[nodiscard]] std::span<const std::uint32_t> entries(std::size_t range) const {
        return {entries_.data() + begin_[range], begin_[range + 1] - begin_[range]};
    }

  private:
    std::size_t block_size_, group_count_, range_size_, count_;
    Buffer<std::size_t> begin_;  ///< empty: nothing is listed
    Buffer<std::uint32_t> entries_;
};

}  // namespace tspace
