// SPDX-License-Identifier: MIT
// Owner computes, range by range: which triangles have corners in which range of groups (vertices, points, groups of
// corners). What is kept per group is too much to keep all of it near, and has one writer only; so ranges are worked on
// one after the other, or by different threads, each with the triangles that are listed for it, in their order. The
// results have the same bits for any number of ranges and threads.
#pragma once

#include <span>

#include "core/memory.h"
#include "core/parallel.h"

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

    const std::size_t count;

  protected:
    ~TriangleGroups() = default;
};

class RangeLists {
  public:
    static constexpr std::uint32_t kBlock = 0x80000000u;  ///< mark: a block of triangles, not a triangle
    static constexpr std::size_t kMostInBlock = 64;

    /// Ranges of `range_size` groups, a power of two; blocks of `block_size` triangles. Takes 4 bytes per triangle at
    /// the border of two ranges, or up to 12 where triangles are in no order. Linear. Throws OutOfMemory.
    RangeLists(const TriangleGroups& triangles, std::size_t block_size, std::size_t group_count, std::size_t range_size,
               const Allocator* allocator, Parallel& parallel);

    [[nodiscard]] std::size_t count() const { return begin_.size() - 1; }
    /// Ascending. Blocks that add to this range alone are listed as such; of others, the triangles.
    [[nodiscard]] std::span<const std::uint32_t> entries(std::size_t range) const {
        return {entries_.data() + begin_[range], begin_[range + 1] - begin_[range]};
    }

  private:
    Buffer<std::size_t> begin_;
    Buffer<std::uint32_t> entries_;
};

}  // namespace tspace
