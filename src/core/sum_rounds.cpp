// SPDX-License-Identifier: MIT
#include "core/sum_rounds.h"

#include <algorithm>
#include <bit>

#include "core/add_row.h"

namespace tspace {

namespace {

constexpr std::size_t kRangeBytes = std::size_t{512} << 10;  // of sums: half of a second cache
constexpr std::size_t kTasksPerThread = 4;
constexpr std::size_t kMostRows = 7;

std::size_t wholeLanes(std::size_t groups) {
    return (groups + SumRound::kGroups - 1) / SumRound::kGroups * SumRound::kGroups;
}

/// One range of groups in one round: zero the sums, add the triangles that are listed, finish.
class RangeOfRound {
  public:
    RangeOfRound(const TriangleGroups& triangles, std::size_t corner_step, const SumRound& round, float* sums,
                 std::uint32_t* vertices)
        : triangles_(triangles), corner_step_(corner_step), round_(round), sums_(sums), vertices_of_(vertices) {}

    void start(std::size_t first_group, std::size_t group_count) {
        first_group_ = static_cast<std::uint32_t>(first_group);
        group_count_ = static_cast<std::uint32_t>(group_count);
        std::fill_n(sums_, 4 * round_.row_count * wholeLanes(group_count), 0.0f);
        std::fill_n(vertices_of_, wholeLanes(group_count), SumRound::kNoVertex);
    }
    void add(std::size_t first, std::size_t count) {
        if (pending_ + count > SumRound::kTriangles) flush();
        triangles_.read(first, count, vertices_ + 3 * pending_, groups_ + 3 * pending_);
        pending_ += count;
    }
    void finish() {
        flush();
        for (std::size_t i = 0; i < group_count_; i += SumRound::kGroups)
            round_.finish(sums_ + 4 * round_.row_count * i, vertices_of_ + i, first_group_ + i,
                          std::min<std::size_t>(SumRound::kGroups, group_count_ - i));
    }

  private:
    void flush() {
        if (pending_ == 0) return;
        round_.add(vertices_, groups_, pending_, rows_);
        switch (round_.row_count) {
            case 1:
                addRows<1>();
                break;
            case 2:
                addRows<2>();
                break;
            case 4:
                addRows<4>();
                break;
            default:
                round_.ends_in_maxima ? addRows<kMostRows, true>() : addRows<kMostRows>();
                break;
        }
        pending_ = 0;
    }

    template <std::size_t kRows, bool kMaxima = false>
    void addRows() {
        constexpr std::size_t kSums = 4 * (kMaxima ? kRows - 1 : kRows);
        // In variables of their own, which no store can change.
        const std::uint32_t first_group = first_group_, group_count = group_count_;
        std::uint32_t* const vertices_of = vertices_of_;
        float* const all_sums = sums_;
        for (std::size_t i = 0, end = 3 * pending_, step = corner_step_; i < end; i += step) {
            const std::uint32_t place = groups_[i] - first_group;
            if (place >= group_count) continue;
            vertices_of[place] = vertices_[i];
            float* const sums = all_sums + 4 * kRows * place;
            const float* const rows = rows_ + 4 * kRows * i;
#pragma GCC unroll 7
            for (std::size_t r = 0; r < kSums; r += 4) addRow(sums + r, rows + r);
#pragma GCC unroll 4
            for (std::size_t r = kSums; r < 4 * kRows; ++r) sums[r] = std::max(sums[r], rows[r]);
        }
    }

    const TriangleGroups& triangles_;
    std::size_t corner_step_;
    const SumRound& round_;
    float* sums_;
    std::uint32_t* vertices_of_;
    std::uint32_t first_group_ = 0, group_count_ = 0;
    std::size_t pending_ = 0;  // triangles in the block
    std::uint32_t vertices_[3 * SumRound::kTriangles] = {}, groups_[3 * SumRound::kTriangles] = {};
    alignas(64) float rows_[3 * SumRound::kTriangles * 4 * kMostRows];
};

}  // namespace

SumRounds::SumRounds(const TriangleGroups& triangles, std::size_t adding_corners, std::size_t group_count,
                     std::size_t most_rows, const Allocator* allocator, Parallel& parallel)
    : triangles_(triangles),
      corner_step_(adding_corners == 1 ? 3 : 1),
      group_count_(group_count),
      range_size_(std::bit_floor(kRangeBytes / (most_rows * sizeof(float[4])))),
      range_count_((group_count + range_size_ - 1) / range_size_),
      tasks_(parallel.width() == 1 ? 1 : std::min(range_count_, kTasksPerThread * parallel.width())),
      parallel_(parallel) {
    const std::size_t room = std::min(range_size_, wholeLanes(group_count));
    sums_ = Buffer<float>(allocator, tasks_ * room * 4 * most_rows);
    vertices_ = Buffer<std::uint32_t>(allocator, tasks_ * room);
    if (range_count_ > 1)
        lists_.emplace(triangles, SumRound::kTriangles, group_count, range_size_, allocator, parallel);
}

void SumRounds::run(const SumRound& round) {
    parallel_.forTasks(tasks_, [&](std::size_t task) {
        RangeOfRound work(triangles_, corner_step_, round, sums_.data() + sums_.size() / tasks_ * task,
                          vertices_.data() + vertices_.size() / tasks_ * task);
        for (std::size_t r = range_count_ * task / tasks_; r < range_count_ * (task + 1) / tasks_; ++r) {
            work.start(r * range_size_, std::min(range_size_, group_count_ - r * range_size_));
            const auto addBlock = [&](std::size_t first) {
                work.add(first, std::min(SumRound::kTriangles, triangles_.count - first));
            };
            if (!lists_) {
                for (std::size_t t = 0; t < triangles_.count; t += SumRound::kTriangles) addBlock(t);
            } else {
                for (const std::uint32_t entry : lists_->entries(r)) {
                    if ((entry & RangeLists::kBlock) != 0)
                        addBlock((entry & ~RangeLists::kBlock) * SumRound::kTriangles);
                    else
                        work.add(entry, 1);
                }
            }
            work.finish();
        }
    });
}

}  // namespace tspace
