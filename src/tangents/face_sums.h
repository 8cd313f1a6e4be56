// SPDX-License-Identifier: MIT
// dP/du and dP/dv of the triangles of a mesh, summed at the vertices that they name.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/parallel.h"
#include "core/prefetch.h"
#include "core/vec_math.h"
#include "core/vertex_ranges.h"
#include "tangents/derivative_terms.h"
#include "tangents/indexed_plan.h"

namespace tspace {

/// The sums of all vertices, in single precision and in triangle order: six floats each, since reading and
/// writing these is most of the work. Two arrays, since either may lie in memory that outputs come to later.
struct VertexSums {
    float* heads = nullptr;  ///< s.x s.y s.z t.x of each vertex
    float* tails = nullptr;  ///< t.y t.z

    [[nodiscard]] float* head(std::size_t vertex) const { return heads + 4 * vertex; }
    [[nodiscard]] float* tail(std::size_t vertex) const { return tails + 2 * vertex; }
    /// The sum of nothing. -0 + x is x, also when x is 0; and what is added to s.x is never -0.
    void clear(VertexRange range) const {
        fill(head(range.begin), head(range.end), -0.0f);
        fill(tail(range.begin), tail(range.end), -0.0f);
    }
    [[nodiscard]] bool isTouched(std::size_t vertex) const {
        return std::bit_cast<std::uint32_t>(*head(vertex)) != 0x80000000u;
    }

  private:
    static void fill(float* begin, float* end, float value) {
        constexpr std::ptrdiff_t kFloats = 16;  // a line
        for (; end - begin >= kFloats; begin += kFloats) {
            prefetchLines<true>(begin, kFloats * sizeof(float));
            std::fill_n(begin, kFloats, value);
        }
        std::fill(begin, end, value);
    }
};

/// The lowest `count` bits, of 1 to 64.
inline std::uint64_t lowBits(std::size_t count) { return ~std::uint64_t{0} >> (64 - count); }

/// Triangles that were met, by what is wrong with them.
struct TriangleCounts {
    std::uint64_t degenerate = 0;     ///< two corners at one position
    std::uint64_t degenerate_uv = 0;  ///< no UV area
    std::uint64_t mirrored = 0;       ///< negative UV area
};

/// Adds triangles up, in ranges of vertices that may be summed at the same time.
class FaceSums {
  public:
    /// `visits`, one per vertex, counts the triangles that were added; it may be null.
    FaceSums(const IndexedPlan& plan, StridedSpan<const Vec3> positions, const derivatives::DerivativeKernel& kernel,
             VertexSums sums, float* visits);

    /// Without this call there is one range.
    void cutIntoRanges(unsigned wanted, const Allocator* allocator, Parallel& parallel);
    [[nodiscard]] const VertexRanges& ranges() const { return ranges_; }

    /// Writes the sums of one range. The counts are those of the triangles whose first vertex is in it.
    [[nodiscard]] TriangleCounts sum(unsigned range) const;

  private:
    struct Block;

    void addBlock(const Block& block, VertexRange range, bool is_whole, TriangleCounts& counts) const;
    void addUnsafe(const std::uint32_t* v, VertexRange range, TriangleCounts& counts) const;

    const IndexedPlan& plan_;
    StridedSpan<const Vec3> positions_;
    derivatives::DerivativeKernel kernel_;
    VertexSums sums_;
    float* visits_;
    VertexRanges ranges_;
};

}  // namespace tspace
