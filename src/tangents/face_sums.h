// SPDX-License-Identifier: MIT
// dP/du and dP/dv of the triangles of a mesh, summed at the vertices that they name.
#pragma once

#include <bit>
#include <cstdint>

#include "core/parallel.h"
#include "core/vec_math.h"
#include "core/vertex_ranges.h"
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

/// Triangles that were met, by what is wrong with them.
struct TriangleCounts {
    std::uint64_t degenerate = 0;     ///< two corners at one position
    std::uint64_t degenerate_uv = 0;  ///< no UV area
    std::uint64_t mirrored = 0;       ///< negative UV area

    TriangleCounts& operator+=(const TriangleCounts& other);
};

/// Adds triangles up, in ranges of vertices that may be summed at the same time.
class FaceSums {
  public:
    /// `visits`, one per vertex, counts the triangles that were added; it may be null.
    FaceSums(const IndexedPlan& plan, StridedSpan<const Vec3> positions, VertexSum* sums, float* visits);

    /// Without this call there is one range.
    void cutIntoRanges(unsigned wanted, const Allocator* allocator, Parallel& parallel);
    [[nodiscard]] const VertexRanges& ranges() const { return ranges_; }

    /// Writes the sums of one range. The counts are those of the triangles whose first vertex is in it.
    [[nodiscard]] TriangleCounts sum(unsigned range) const;

  private:
    const IndexedPlan& plan_;
    StridedSpan<const Vec3> positions_;
    VertexSum* sums_;
    float* visits_;
    VertexRanges ranges_;
};

}  // namespace tspace
