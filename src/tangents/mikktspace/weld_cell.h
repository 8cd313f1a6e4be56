// SPDX-License-Identifier: MIT
// What the reference does with the corners in one cell of its grid: a repeated partition in place at the
// middle of the longest axis, until positions no longer differ. The order that results decides on
// representatives.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/float4.h"
#include "core/vec_math.h"
#include "tangents/mikktspace/words.h"

namespace tspace::mikk {

inline float component(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

struct Box {
    Vec3 low, high;

    explicit Box(const Vec3& start) : low(start), high(start) {}
    Box(const Vec3& lowest, const Vec3& highest) : low(lowest), high(highest) {}
    /// A NaN never moves a bound, and a bound that starts as NaN stays.
    void add(const Vec3& p) {
        grow(low.x, high.x, p.x);
        grow(low.y, high.y, p.y);
        grow(low.z, high.z, p.z);
    }
    [[nodiscard]] int longestAxis() const {
        const Vec3 d = high - low;
        if (d.y > d.x && d.y > d.z) return 1;
        return d.z > d.x ? 2 : 0;
    }

  private:
    static void grow(float& lowest, float& highest, float x) {
        if (lowest > x) lowest = x;
        if (highest < x) highest = x;
    }
};

/// An entry of the corner list.
struct alignas(16) CellElement {
    Vec3 position;
    std::uint32_t entry;  ///< kMark: its node's representative is wanted
};

/// found(entry): called for all entries of leaves, within each in an order such that the last call for a node
/// is for its representative. All entries of a node are in one leaf, because equal positions always go to the
/// same side. gaveUp(entry): called where the reference gives up welding. `tame`: no NaN, and no sum of two
/// overflows.
template <class Found, class GaveUp>
class WeldCell {
  public:
    WeldCell(CellElement* elements, bool tame, const Found& found, const GaveUp& gave_up)
        : elements_(elements), tame_(tame), found_(found), gave_up_(gave_up) {}

    void run(std::size_t count) {
        Range waiting[64];  // each at most half of the one before
        std::size_t depth = 0;
        Range range{0, count};
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

    /// Partitions the range, or finishes it and returns false.
    bool divide(Range range, Range& left, Range& right) {
        bool wanted = false;
        const Box box = boxOf(range, wanted);
        if (!wanted) return false;
        if (range.end - range.begin == 1) {
            leaf(range);
            return false;
        }
        const int axis = box.longestAxis();
        const float low = component(box.low, axis), high = component(box.high, axis);
        const float middle = 0.5f * (high + low);
        if (!std::isfinite(middle)) {
            for (std::size_t i = range.begin; i < range.end; ++i) gave_up_(elements_[i].entry & kValue);
            return false;
        }
        if (middle >= high || middle <= low) {
            leaf(range);
            return false;
        }
        const std::size_t cut = partition(range, axis, middle);
        left = {range.begin, cut};
        right = {cut, range.end};
        return true;
    }

    /// `wanted`: whether some element is.
    Box boxOf(Range range, bool& wanted) const {
        if (tame_) return tameBoxOf(range, wanted);
        Box box(elements_[range.begin].position);
        std::uint32_t any = 0;
        for (std::size_t i = range.begin; i < range.end; ++i) {
            box.add(elements_[i].position);
            any |= elements_[i].entry;
        }
        wanted = (any & kMark) != 0;
        return box;
    }

    /// Without NaN the order of elements does not matter, so several boxes are made side by side: each waits for its
    /// last minimum, four cycles long.
    Box tameBoxOf(Range range, bool& wanted) const {
        constexpr std::size_t kBoxes = 4;
        // What the fourth lanes hold as numbers does not matter.
        const auto at = [&](std::size_t i) { return loadFloat4(&elements_[i].position.x); };
        Float4 low[kBoxes], high[kBoxes], any = splat(0);
        for (std::size_t k = 0; k < kBoxes; ++k) low[k] = high[k] = at(range.begin);
        const auto add = [&](std::size_t k, std::size_t i) {
            const Float4 here = at(i);
            low[k] = min4(low[k], here);
            high[k] = max4(high[k], here);
            any = or4(any, here);
        };
        std::size_t i = range.begin;
        for (; i + kBoxes <= range.end; i += kBoxes) {
            for (std::size_t k = 0; k < kBoxes; ++k) add(k, i + k);
        }
        for (; i < range.end; ++i) add(0, i);
        for (std::size_t k = 1; k < kBoxes; ++k) {
            low[0] = min4(low[0], low[k]);
            high[0] = max4(high[0], high[k]);
        }
        wanted = (laneBits(std::bit_cast<Mask4>(any)) & 8) != 0;
        return {{low[0][0], low[0][1], low[0][2]}, {high[0][0], high[0][1], high[0][2]}};
    }

    /// The reference swaps the first element that belongs to the right with the last one that belongs to the
    /// left, and so on. Long ranges are looked at in blocks, whose elements on the wrong side are listed
    /// without branches.
    std::size_t partition(Range range, int axis, float middle) {
        constexpr std::size_t kBlock = 128;
        const auto goesLeft = [&](std::size_t n) {
            return reinterpret_cast<const float*>(elements_ + n)[axis] < middle;
        };
        std::size_t i = range.begin, end = range.end;
        std::uint8_t on_left[kBlock], on_right[kBlock];  // who has to leave a block, from its outer end
        std::size_t left_next = 0, left_count = 0, right_next = 0, right_count = 0;
        while (end - i >= 2 * kBlock) {
            if (left_next == left_count) {
                left_next = left_count = 0;
                for (std::size_t n = 0; n < kBlock; ++n) {
                    on_left[left_count] = static_cast<std::uint8_t>(n);
                    left_count += goesLeft(i + n) ? 0 : 1;
                }
            }
            if (right_next == right_count) {
                right_next = right_count = 0;
                for (std::size_t n = 0; n < kBlock; ++n) {
                    on_right[right_count] = static_cast<std::uint8_t>(n);
                    right_count += goesLeft(end - 1 - n) ? 1 : 0;
                }
            }
            const std::size_t count = std::min(left_count - left_next, right_count - right_next);
            for (std::size_t n = 0; n < count; ++n)
                std::swap(elements_[i + on_left[left_next + n]], elements_[end - 1 - on_right[right_next + n]]);
            left_next += count;
            right_next += count;
            if (left_next == left_count) i += kBlock;
            if (right_next == right_count) end -= kBlock;
        }
        // A block that still has some is done up to the first of them.
        if (left_next < left_count) i += on_left[left_next];
        if (right_next < right_count) end -= on_right[right_next];
        std::size_t j = end - 1;
        while (i < j) {
            while (i < j && goesLeft(i)) ++i;
            while (i < j && !goesLeft(j)) --j;
            if (i < j) std::swap(elements_[i++], elements_[j--]);
        }
        return i == j && goesLeft(i) ? i + 1 : i;
    }

    /// The first of a node is kept; going backwards makes the first the last to be named.
    void leaf(Range range) {
        for (std::size_t i = range.end; i-- > range.begin;) found_(elements_[i].entry & kValue);
    }

    CellElement* elements_;
    bool tame_;
    const Found& found_;
    const GaveUp& gave_up_;
};

}  // namespace tspace::mikk
