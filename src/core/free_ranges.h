// SPDX-License-Identifier: MIT
// Which parts of a line of bytes are free. The line has no end: behind the last allocation all is free.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tspace {

/// Allocations take the smallest hole that fits, the first one of several, else the place behind everything. So the
/// same calls on an empty line end in the same places.
class FreeRanges {
  public:
    struct Place {
        std::size_t begin = 0;
        bool is_last = false;  ///< behind everything
    };

    /// Where `bytes` fit. Never fails; commits nothing.
    [[nodiscard]] Place find(std::size_t bytes) const {
        const Hole* best = nullptr;
        for (const Hole& hole : holes_) {
            if (hole.bytes >= bytes && (best == nullptr || hole.bytes < best->bytes)) best = &hole;
        }
        return best != nullptr ? Place{best->begin, false} : Place{end_, true};
    }

    /// Takes `bytes` at a place that find() gave.
    void take(const Place& place, std::size_t bytes) {
        // Each hole lies before an allocation, so this is all the room that release() can need.
        holes_.reserve(live_ + 1);
        ++live_;
        if (place.is_last) {
            end_ += bytes;
            return;
        }
        const auto hole = at(place.begin);
        if (hole->bytes == bytes) {
            holes_.erase(hole);
        } else {
            hole->begin += bytes;
            hole->bytes -= bytes;
        }
    }

    void release(std::size_t begin, std::size_t bytes) noexcept {
        --live_;
        auto next = at(begin);
        const bool joins_previous = next != holes_.begin() && (next - 1)->begin + (next - 1)->bytes == begin;
        const bool joins_next = next != holes_.end() && begin + bytes == next->begin;
        if (joins_previous && joins_next) {
            (next - 1)->bytes += bytes + next->bytes;
            holes_.erase(next);
        } else if (joins_previous) {
            (next - 1)->bytes += bytes;
        } else if (joins_next) {
            next->begin = begin;
            next->bytes += bytes;
        } else {
            holes_.insert(next, {begin, bytes});
        }
        if (!holes_.empty() && holes_.back().begin + holes_.back().bytes == end_) {
            end_ = holes_.back().begin;
            holes_.pop_back();
        }
    }

    /// Behind the last allocation.
    [[nodiscard]] std::size_t end() const { return end_; }

  private:
    struct Hole {
        std::size_t begin = 0, bytes = 0;
    };

    /// The first hole at or behind `begin`.
    std::vector<Hole>::iterator at(std::size_t begin) {
        return std::lower_bound(holes_.begin(), holes_.end(), begin,
                                [](const Hole& hole, std::size_t value) { return hole.begin < value; });
    }

    std::vector<Hole> holes_;  ///< in order; no two touch, and none touches the end
    std::size_t end_ = 0;
    std::size_t live_ = 0;
};

}  // namespace tspace
