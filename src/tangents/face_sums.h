// SPDX-License-Identifier: MIT
// dP/du and dP/dv of the triangles of a mesh, summed at the vertices that they name.
#pragma once

#include <bit>
#include <cstdint>

#include "core/parallel.h"
#include "core/vec_math.h"
#include "tangents/indexed_plan.h"

namespace tspace {

/// In single precision and in triangle order. 24 bytes, since reading and writing these is most of the work.
struct VertexSum {
    float s[3];
    float t[3];

    /// The sum of nothing. -0 + x is x, also when x is 0; and what is added to s[0] is never -0.
    static VertexSum untouched() { return {{-0.0f, -0.0f, -0.0f}, {-0.0f, -0.0f, -0.0f}}; }
    [[nodiscard]] bool isTouched() const { return std::bit_cast<std::uint32_t>(s[0]) != 0x80000000u; }
};

struct VertexRange {
    std::uint32_t begin = 0, end = 0;
};

/// Triangles that were met, by what is wrong with them.
struct TriangleCounts {
    std::uint64_t degenerate = 0;     ///< two corners at one position
    std::uint64_t degenerate_uv = 0;  ///< no UV area
    std::uint64_t mirrored = 0;       ///< negative UV area

    TriangleCounts& operator+=(const TriangleCounts& other);
};

/// Adds triangles up, each task for a range of vertices of its own: a task walks the triangles in order and
/// skips those without a vertex in its range. So no sum depends on the number of tasks or threads.
class FaceSums {
  public:
    static constexpr unsigned kMostRanges = 64;  ///< bits of a mark

    /// `visits`, one per vertex, counts the triangles that were added; it may be null.
    FaceSums(const IndexedPlan& plan, StridedSpan<const Vec3> positions, VertexSum* sums, float* visits);

    /// Finds out which blocks of triangles name which ranges. Without this call there is one range.
    void cutIntoRanges(unsigned wanted, const Allocator* allocator, Parallel& parallel);
    [[nodiscard]] unsigned rangeCount() const { return range_count_; }
    [[nodiscard]] VertexRange range(unsigned index) const;

    /// Writes the sums of one range. The counts are those of the triangles whose first vertex is in it.
    TriangleCounts sum(unsigned range_index) const;

  private:
    const IndexedPlan& plan_;
    StridedSpan<const Vec3> positions_;
    VertexSum* sums_;
    float* visits_;
    unsigned range_count_ = 1;
    unsigned range_shift_ = 31;  ///< a vertex v is in range v >> range_shift_
    Buffer<std::uint64_t>
        ranges_of_blocks_;  ///< a bit for each range that a block names; empty for one range
};

}  // namespace tspace
