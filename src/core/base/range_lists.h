// SPDX-License-Identifier: MIT
// Owner-computes rule: lists of the triangles that have corners in each range of groups (vertices, points, groups of
// corners). The data of all groups do not fit into a cache, and each group has a single writer; so ranges are processed
// one after the other, or by different threads, each with its listed triangles, in order. Results have equal bits for
// any number of ranges and threads.
#pragma once

#include <algorithm>
#include <cfloat>
#include <span>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "tspace/tangents.h"

namespace tspace {

/// Triangles of a call, in order, and the group to which each corner contributes.
class TriangleGroups {
  public:
    explicit TriangleGroups(std::size_t triangle_count) : count(triangle_count) {}
    TriangleGroups(const TriangleGroups&) = delete;
    TriangleGroups& operator=(const TriangleGroups&) = delete;

    /// Writes three numbers per triangle to both arrays; `vertices` may be null. A group number of 2^31 or more, which
    /// no group has, means that the corner contributes to no group.
    virtual void read(std::size_t first, std::size_t triangles, std::uint32_t* vertices,
                      std::uint32_t* groups) const = 0;
    /// Reads the triangles of a list; otherwise like read().
    virtual void readSome(const std::uint32_t* numbers, std::size_t size, std::uint32_t* vertices,
                          std::uint32_t* groups) const {
        for (std::size_t i = 0; i < size; ++i)
            read(numbers[i], 1, vertices == nullptr ? nullptr : vertices + 3 * i, groups + 3 * i);
    }
    struct InPlace {
        const std::uint32_t *vertices = nullptr, *groups = nullptr;
    };
    /// Returns pointers to the vertices and groups of these triangles if both exist in memory; otherwise null.
    [[nodiscard]] virtual InPlace inPlace(std::size_t, std::size_t) const { return {}; }

    const std::size_t count;

  protected:
    ~TriangleGroups() = default;
};

/// Pads a list of vertices with a valid vertex up to a whole group of triangles, because kernels process no partial
/// groups. Returns `vertices` if no padding is necessary, otherwise `buffer`, which may be the same array.
inline const std::uint32_t* fillGroup(const std::uint32_t* vertices, std::size_t count, std::size_t group,
                                      std::uint32_t* buffer) {
    const std::size_t end = (count + group - 1) / group * group;
    if (end == count) return vertices;
    if (vertices != buffer) std::copy_n(vertices, 3 * count, buffer);
    std::fill(buffer + 3 * count, buffer + 3 * end, buffer[0]);
    return buffer;
}

/// Triangles that a kernel processes together. Entries of own_vertices and own_groups beyond `count` are stale.
struct TriangleBatch {
    static constexpr std::size_t kMost = 64;

    std::size_t count = 0;
    bool is_block = false;  ///< true: the triangles are consecutive
    /// true: the triangles are consecutive, and all their groups are in the range (or there are no groups)
    bool is_whole = false;
    const std::uint32_t *vertices = own_vertices, *groups = own_groups;
    std::uint32_t numbers[kMost];  ///< triangle numbers; for a block only the first one
    std::uint32_t own_vertices[3 * kMost], own_groups[3 * kMost];

    [[nodiscard]] std::uint32_t number(std::size_t t) const {
        return is_block ? numbers[0] + static_cast<std::uint32_t>(t) : numbers[t];
    }

    TriangleBatch() {}  // leaves the arrays uninitialized
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
    /// Divides the groups into ranges of `range_size` groups, a power of two, and the triangles into blocks of
    /// `block_size`, at most TriangleBatch::kMost. Creates no lists: each range visits all triangles, which suits a
    /// single range, or a few ranges for triangles in random order.
    RangeLists(std::size_t block_size, std::size_t group_count, std::size_t range_size)
        : block_size_(block_size), group_count_(group_count), range_size_(range_size),
          count_((group_count + range_size - 1) / range_size) {}

    /// Lists the triangles of each range, if there are several. Uses 4 bytes per triangle at the border of two ranges,
    /// or up to 12 for triangles in random order. Linear. Throws OutOfMemory.
    RangeLists(const TriangleGroups& triangles, std::size_t block_size, std::size_t group_count, std::size_t range_size,
               const Allocator* allocator, Parallel& parallel);

    /// Returns whether most blocks contribute to a single range, from a sample of 64 blocks.
    static bool areCompact(const TriangleGroups& triangles, std::size_t block_size, std::size_t group_count,
                           std::size_t range_size);

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] GroupRange range(std::size_t index) const {
        const std::size_t end = std::min((index + 1) * range_size_, group_count_);
        return {static_cast<std::uint32_t>(index * range_size_), static_cast<std::uint32_t>(end)};
    }
    /// Returns the maximum number of triangles of a range.
    [[nodiscard]] std::size_t mostTriangles(std::size_t all) const;

    [[nodiscard]] std::size_t blockCount(std::size_t triangle_count) const {
        return (triangle_count + block_size_ - 1) / block_size_;
    }

    /// Iterator over the triangles of a range, in ascending order, in batches.
    class Batches {
      public:
        Batches(const TriangleGroups& triangles, const RangeLists& lists, std::size_t range);
        /// Iterates over all triangles of the blocks [begin, end), whatever their groups.
        Batches(const TriangleGroups& triangles, std::size_t block_size, std::size_t begin, std::size_t end)
            : triangles_(triangles), block_size_(block_size), next_(begin), end_(end) {}
        /// Reads the next batch; returns false at the end. Reads only groups if `needs_vertices` is false.
        bool next(TriangleBatch& batch, bool needs_vertices = true);

      private:
        const TriangleGroups& triangles_;
        std::size_t block_size_;
        const std::uint32_t* entries_ = nullptr;  ///< entries of the range; null: all blocks are visited
        bool are_whole_ = true;                   ///< true: all triangles of a block are visited
        std::size_t next_, end_;                  ///< positions of the next and the last batch, in entries or blocks
    };

    /// Returns the list of a range, in ascending order: blocks that contribute only to this range, with the flag
    /// kBlock, and single triangles of other blocks.
    static constexpr std::uint32_t kBlock = 0x80000000u;
    [[nodiscard]] std::span<const std::uint32_t> entries(std::size_t range) const {
        return {entries_.data() + begin_[range], begin_[range + 1] - begin_[range]};
    }

  private:
    std::size_t block_size_, group_count_, range_size_, count_;
    Buffer<std::size_t> begin_;  ///< begin of each range's list; empty: no lists
    Buffer<std::uint32_t> entries_;
};

// Sums of rows of numbers at groups of corners over all triangles of a call, in several rounds with different rows.
// Ranges of groups are processed one by one, so that their sums stay in the cache, and by all threads. Sums are
// computed in the order of triangles, so they have the same bits for any number of ranges and threads.

/// One pass of sums: provides the rows that triangles add to groups, and processes the sums of each group. Works on
/// blocks, as kernels do.
class SumRound {
  public:
    static constexpr std::size_t kTriangles = 32;  ///< triangles per block, whose rows fit into the L1 cache
    /// maximum number of SIMD lanes: kernels process multiples of this number of groups
    static constexpr std::size_t kGroups = 16;
    static constexpr std::uint32_t kNoVertex = 0xffffffffu;

    /// `rows`: number of rows of four floats per group: 1, 2, 4 or 7, or 8 with `has_maxima`: the last one contains
    /// maxima instead of sums.
    explicit SumRound(std::size_t rows, bool has_maxima = false) : row_count(rows), ends_in_maxima(has_maxima) {}
    SumRound(const SumRound&) = delete;
    SumRound& operator=(const SumRound&) = delete;

    /// Writes the rows of corner k of triangle t to rows + 4 * row_count * (3 * t + k). Vertices and groups: three per
    /// triangle, followed by stale values up to the end of the block.
    virtual void add(const std::uint32_t* vertices, const std::uint32_t* groups, std::size_t count,
                     float* rows) const = 0;
    /// Processes, in place, the sums of kGroups groups, starting with group `first`; groups from `count` on are
    /// undefined. vertices: the vertex of any corner of each group, or kNoVertex.
    virtual void finish(float* sums, const std::uint32_t* vertices, std::size_t first, std::size_t count) const = 0;

    const std::size_t row_count;
    const bool ends_in_maxima;

  protected:
    ~SumRound() = default;
};

class SumRounds {
  public:
    /// `most_rows`: maximum over all passes. `adding_corners`: 3, or 1 if only the first corner of each triangle
    /// contributes. Uses up to 1 MB per task, and the memory of RangeLists. Throws OutOfMemory.
    SumRounds(const TriangleGroups& triangles, std::size_t adding_corners, std::size_t group_count,
              std::size_t most_rows, const Allocator* allocator, Parallel& parallel);

    void run(const SumRound& round);

  private:
    const TriangleGroups& triangles_;
    std::size_t corner_step_;
    RangeLists lists_;
    std::size_t tasks_;
    Parallel& parallel_;
    Buffer<float> sums_;              ///< sums of the current range of each task
    Buffer<std::uint32_t> vertices_;  ///< a vertex of each group in the range
};

// Powers of four that bring coordinates close to 1, so that fourth powers of small UVs do not underflow. Multiplying by
// them changes no bit of a mantissa, or of the mantissa of a square root. Results therefore do not depend on the chosen
// factor, nor on scaling all positions or all UVs by four.

struct InputScale {
    float positions = 1, uvs = 1;

    /// Returns the factor that converts lengths of dP/du and dP/dv from scaled to original units.
    [[nodiscard]] float lengthFactor() const {
        return static_cast<float>(std::clamp(static_cast<double>(uvs) / positions, double{FLT_MIN}, double{FLT_MAX}));
    }
};

/// Computes the scale from a sample of at most 1024 triangles, so that it depends neither on how triangles share
/// vertices nor on unused vertices. Zeros, values that are not finite, and degenerate triangles are ignored. `uvs` may
/// be empty.
InputScale inputScale(const TriangleGroups& triangles, const StridedSpan<const Vec3>& positions,
                      const StridedSpan<const Vec2>& uvs);

}  // namespace tspace
