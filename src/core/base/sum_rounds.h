// SPDX-License-Identifier: MIT
// Rows of numbers, added up at groups of corners over all triangles of a call, and this again with other rows: rounds.
// Range by range of groups, so that their sums stay in the cache, and by all threads. Sums are made in the order of
// triangles: the same bits for any number of ranges and threads.
#pragma once

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/range_lists.h"

namespace tspace {

/// One round: rows that triangles add to groups, and what a group makes of its sums. Works on blocks, for kernels.
class SumRound {
  public:
    static constexpr std::size_t kTriangles = 32;  ///< of one block; their rows stay in the first cache
    static constexpr std::size_t kGroups = 16;     ///< the most lanes; kernels work on whole groups of so many
    static constexpr std::uint32_t kNoVertex = 0xffffffffu;

    /// `rows`: of four floats, per group; 1, 2, 4 or 7, or 8 with `has_maxima`: the last one has maxima in
    /// the place of sums.
    explicit SumRound(std::size_t rows, bool has_maxima = false) : row_count(rows), ends_in_maxima(has_maxima) {}
    SumRound(const SumRound&) = delete;
    SumRound& operator=(const SumRound&) = delete;

    /// Writes the rows of corner k of triangle t to rows + 4 * row_count * (3 * t + k). Vertices and groups: three per
    /// triangle, and some that were there before up to the end of the block.
    virtual void add(const std::uint32_t* vertices, const std::uint32_t* groups, std::size_t count,
                     float* rows) const = 0;
    /// Takes the sums of the groups from `first` on, in which it may write. There are kGroups of them; the last ones,
    /// from `count` on, mean nothing. vertices: of each group any corner's, or kNoVertex.
    virtual void finish(float* sums, const std::uint32_t* vertices, std::size_t first, std::size_t count) const = 0;

    const std::size_t row_count;
    const bool ends_in_maxima;

  protected:
    ~SumRound() = default;
};

class SumRounds {
  public:
    /// `most_rows`: of any round. `adding_corners`: 3, or 1 where only the first corner of each triangle adds something.
    /// Takes up to 1 MB per task and range_lists.h. Throws OutOfMemory.
    SumRounds(const TriangleGroups& triangles, std::size_t adding_corners, std::size_t group_count,
              std::size_t most_rows, const Allocator* allocator, Parallel& parallel);

    void run(const SumRound& round);

  private:
    const TriangleGroups& triangles_;
    std::size_t corner_step_;
    RangeLists lists_;
    std::size_t tasks_;
    Parallel& parallel_;
    Buffer<float> sums_;              ///< of one range for each task
    Buffer<std::uint32_t> vertices_;  ///< of each group there
};

}  // namespace tspace
