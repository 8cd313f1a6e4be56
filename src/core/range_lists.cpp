// SPDX-License-Identifier: MIT
#include "core/range_lists.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace tspace {

namespace {

constexpr std::size_t kBlocksPerTask = 256;
constexpr std::uint32_t kNoRange = 0xffffffffu, kSeveral = 0xfffffffeu;

class Walk {
  public:
    Walk(const TriangleGroups& triangles, std::size_t block_size, std::size_t range_count, int shift)
        : triangles_(triangles),
          block_size_(block_size),
          range_count_(static_cast<std::uint32_t>(range_count)),
          shift_(shift) {}

    /// The range of a block, or kNoRange, or kSeveral.
    std::uint32_t rangeOfBlock(std::size_t block) {
        const std::size_t size = 3 * read(block);
        std::uint32_t any = 0, all = ~std::uint32_t{0};
        for (std::size_t i = 0; i < size; ++i) {
            any |= groups_[i];
            all &= groups_[i];
        }
        if ((any ^ all) >> shift_ == 0) return rangeOf(groups_[0]);
        if (rangeOf(any) != kNoRange) return kSeveral;
        std::uint32_t only = kNoRange;
        for (std::size_t i = 0; i < size; ++i) {
            const std::uint32_t range = rangeOf(groups_[i]);
            if (range == kNoRange) continue;
            if (only != kNoRange && range != only) return kSeveral;
            only = range;
        }
        return only;
    }

    /// enter(range, entry) for what rangeOfBlock said of a block.
    template <class Enter>
    void enterBlock(std::size_t block, std::uint32_t range, const Enter& enter) {
        if (range == kSeveral) {
            const std::size_t size = read(block);
            for (std::size_t t = 0; t < size; ++t) {
                enterTriangle(static_cast<std::uint32_t>(block * block_size_ + t), groups_ + 3 * t, enter);
            }
        } else if (range != kNoRange) {
            enter(range, RangeLists::kBlock | static_cast<std::uint32_t>(block));
        }
    }

  private:
    /// Into groups_, where the last one that was read stays.
    std::size_t read(std::size_t block) {
        const std::size_t first = block * block_size_;
        const std::size_t size = std::min(block_size_, triangles_.count - first);
        if (block != std::exchange(held_, block)) triangles_.read(first, size, nullptr, groups_);
        return size;
    }

    [[nodiscard]] std::uint32_t rangeOf(std::uint32_t group) const {
        return group >> shift_ < range_count_ ? group >> shift_ : kNoRange;
    }

    template <class Enter>
    void enterTriangle(std::uint32_t triangle, const std::uint32_t* groups, const Enter& enter) const {
        const std::uint32_t a = rangeOf(groups[0]);
        if (a != kNoRange) enter(a, triangle);
        if (((groups[0] ^ groups[1]) | (groups[0] ^ groups[2])) >> shift_ == 0) return;
        const std::uint32_t b = rangeOf(groups[1]), c = rangeOf(groups[2]);
        if (b != kNoRange && b != a) enter(b, triangle);
        if (c != kNoRange && c != a && c != b) enter(c, triangle);
    }

    const TriangleGroups& triangles_;
    std::size_t block_size_;
    std::uint32_t range_count_;
    int shift_;
    std::size_t held_ = ~std::size_t{0};
    std::uint32_t groups_[3 * RangeLists::kMostInBlock] = {};
};

}  // namespace

RangeLists::RangeLists(const TriangleGroups& triangles, std::size_t block_size, std::size_t group_count,
                       std::size_t range_size, const Allocator* allocator, Parallel& parallel) {
    const int shift = std::countr_zero(range_size);
    const std::size_t ranges = (group_count + range_size - 1) >> shift;
    const std::size_t blocks = (triangles.count + block_size - 1) / block_size;
    const std::size_t tasks = std::clamp<std::size_t>(blocks / kBlocksPerTask, 1, parallel.width());
    // First how many entries each task has for each range, then where they go: task after task within a
    // range.
    Buffer<std::size_t> places(allocator, tasks * ranges, std::size_t{0});
    Buffer<std::uint32_t> range_of(allocator, blocks);
    const auto forBlocks = [&](std::size_t task, const auto& body) {
        for (std::size_t b = blocks * task / tasks; b < blocks * (task + 1) / tasks; ++b) body(b);
    };
    parallel.forTasks(tasks, [&](std::size_t task) {
        Walk walk(triangles, block_size, ranges, shift);
        std::size_t* const mine = places.data() + task * ranges;
        forBlocks(task, [&](std::size_t block) {
            range_of[block] = walk.rangeOfBlock(block);
            walk.enterBlock(block, range_of[block], [mine](std::uint32_t range, std::uint32_t) { ++mine[range]; });
        });
    });
    begin_ = Buffer<std::size_t>(allocator, ranges + 1);
    std::size_t total = 0;
    for (std::size_t range = 0; range < ranges; ++range) {
        begin_[range] = total;
        for (std::size_t task = 0; task < tasks; ++task) {
            std::size_t& place = places[task * ranges + range];
            const std::size_t size = place;
            place = total;
            total += size;
        }
    }
    begin_[ranges] = total;
    entries_ = Buffer<std::uint32_t>(allocator, total);
    parallel.forTasks(tasks, [&](std::size_t task) {
        Walk walk(triangles, block_size, ranges, shift);
        std::size_t* const mine = places.data() + task * ranges;
        forBlocks(task, [&](std::size_t block) {
            walk.enterBlock(block, range_of[block],
                            [&](std::uint32_t range, std::uint32_t entry) { entries_[mine[range]++] = entry; });
        });
    });
}

}  // namespace tspace
