// SPDX-License-Identifier: MIT
// The grid in which the reference welds (2048 cells along the longest axis of the bounding box), and the order in which
// partitions leave the corners of a cell (grid_order.cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "core/base/vec_math.h"
#include "core/tangents/mikktspace/words.h"

namespace tspace::mikk {

/// Entry of the corner list in one cell of the reference's grid.
struct alignas(16) CellElement {
    Vec3 position;
    std::uint32_t entry;  ///< index of the entry; kTopBit is set if the representative of its node is requested
};

inline float component(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
/// Loads a vector as x, y, z, z.
inline Float4 loadVec3(const Vec3& v) {
    const Float4 xyyz = joinPairs(&v.x, &v.y);
    return __builtin_shufflevector(xyyz, xyyz, 0, 1, 3, 3);
}

/// Bounding box, whose fourth lanes are unused. As in the reference, a NaN never changes a bound, and a bound that
/// starts as NaN remains NaN.
struct Box {
    Float4 low, high;

    explicit Box(Float4 start) : low(start), high(start) {}
    void add(Float4 p) {
        low = min4(p, low);
        high = max4(p, high);
    }
    void add(const Box& other) {
        low = min4(other.low, low);
        high = max4(other.high, high);
    }
    [[nodiscard]] int longestAxis() const {
        const Float4 d = high - low;
        if (d[1] > d[0] && d[1] > d[2]) return 1;
        return d[2] > d[0] ? 2 : 0;
    }
};

/// Cells of the reference's grid along the longest axis of its box.
struct Grid {
    static constexpr int kCells = 2048;
    int axis;
    Float4 low, high;

    explicit Grid(const Box& box) : axis(box.longestAxis()), low(splat(box.low[axis])), high(splat(box.high[axis])) {}

    /// Returns the cells of four coordinates. As in the float-to-int conversion of x86, values out of range become the
    /// smallest int, which is clamped to cell 0.
    [[nodiscard]] Mask4 cellsOf(Float4 x) const {
        const Float4 q = splat(kCells) * ((x - low) / (high - low));
        const Float4 fitting = select4(q < splat(2147483648.0f), max4(q, Float4{}), Float4{});
        return __builtin_convertvector(min4(fitting, splat(kCells - 1)), Mask4);
    }
};

/// Divides the corners of one grid cell as the reference does, down to leaves of equal positions. Calls found(entry)
/// for all entries of leaves, in an order such that the last call for a node is for its representative. All entries of
/// a node are in one leaf, because equal positions are always on the same side. Skips ranges without marked elements.
template <class Found>
class Cell {
  public:
    Cell(std::span<CellElement> elements, const Found& found)
        : elements_(elements.data()), count_(elements.size()), found_(found) {}

    void run() {
        Range waiting[64];  // each waiting range has at most half the size of the previous one
        std::size_t depth = 0;
        Range range{0, count_};
        while (true) {
            Range smaller{}, larger{};
            if (divide(range, smaller, larger)) {
                if (smaller.end - smaller.begin > larger.end - larger.begin) std::swap(smaller, larger);
                waiting[depth++] = larger;
                range = smaller;
            } else {
                if (depth == 0) return;
                range = waiting[--depth];
            }
        }
    }

  private:
    struct Range {
        std::size_t begin, end;
    };

    /// Partitions a range into `left` and `right`; if that is impossible, finishes it and returns false.
    bool divide(Range range, Range& left, Range& right) {
        const auto at = [&](std::size_t i) { return loadFloat4(&elements_[i].position.x); };
        Box box(at(range.begin));
        std::uint32_t any = 0;
        for (std::size_t i = range.begin; i < range.end; ++i) {
            box.add(at(i));
            any |= elements_[i].entry;
        }
        if ((any & kTopBit) == 0) return false;
        const int axis = box.longestAxis();
        const float low = box.low[axis], high = box.high[axis], middle = 0.5f * (high + low);
        if (middle >= high || middle <= low) {
            // The first corner of a node is its representative; in reverse order it is the last to be reported.
            for (std::size_t i = range.end; i-- > range.begin;) found_(elements_[i].entry & kValue);
            return false;
        }
        const std::size_t cut = partition(range, axis, middle);
        left = {range.begin, cut};
        right = {cut, range.end};
        return true;
    }

    /// Partitions a range like the reference, which swaps the first element that belongs to the right with the last one
    /// that belongs to the left, and repeats this with the elements between them.
    std::size_t partition(Range range, int axis, float middle) {
        const auto goesLeft = [&](std::size_t n) { return component(elements_[n].position, axis) < middle; };
        std::size_t i = range.begin, j = range.end - 1;
        while (i < j) {
            while (i < j && goesLeft(i)) ++i;
            while (i < j && !goesLeft(j)) --j;
            if (i < j) std::swap(elements_[i++], elements_[j--]);
        }
        return i == j && goesLeft(i) ? i + 1 : i;
    }

    CellElement* elements_;
    std::size_t count_;
    const Found& found_;
};

}  // namespace tspace::mikk
