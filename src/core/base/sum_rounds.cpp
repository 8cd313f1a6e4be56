// SPDX-License-Identifier: MIT
#include "core/base/sum_rounds.h"

#include <algorithm>
#include <bit>
#include <iterator>

#include "core/base/float4.h"

namespace tspace {

namespace {

constexpr std::size_t kRangeBytes = std::size_t{512} << 10;  // of sums: half of a second cache
constexpr std::size_t kTasksPerThread = 4;
constexpr std::size_t kMostRows = 8;

std::size_t wholeLanes(std::size_t groups) {
    return (groups + SumRound::kGroups - 1) / SumRound::kGroups * SumRound::kGroups;
}

/// The ranges of one task, in one round: zero the sums, add the triangles, finish.
class RangeOfRound {
  public:
    RangeOfRound(std::size_t corner_step, const SumRound& round, float* sums, std::uint32_t* vertices)
        : corner_step_(corner_step), round_(round), sums_(sums), vertices_of_(vertices) {
        std::fill(std::begin(batch_.own_vertices), std::end(batch_.own_vertices), 0u);
        std::fill(std::begin(batch_.own_groups), std::end(batch_.own_groups), 0u);
    }

    void run(GroupRange range, RangeLists::Batches triangles) {
        range_ = range;
        std::fill_n(sums_, 4 * round_.row_count * wholeLanes(range.size()), 0.0f);
        std::fill_n(vertices_of_, wholeLanes(range.size()), SumRound::kNoVertex);
        while (triangles.next(batch_)) addBatch();
        for (std::size_t i = 0; i < range.size(); i += SumRound::kGroups)
            round_.finish(sums_ + 4 * round_.row_count * i, vertices_of_ + i, range.begin + i,
                          std::min<std::size_t>(SumRound::kGroups, range.size() - i));
    }

  private:
    void addBatch() {
        round_.add(batch_.vertices, batch_.groups, batch_.count, rows_);
        switch (round_.row_count) {
            case 1:
                return addRows<1>();
            case 2:
                return addRows<2>();
            case 4:
                return addRows<4>();
            default:
                return round_.ends_in_maxima ? addRows<kMostRows, true>() : addRows<kMostRows - 1>();
        }
    }

    template <std::size_t kRows, bool kMaxima = false>
    void addRows() {
        constexpr std::size_t kSums = 4 * (kMaxima ? kRows - 1 : kRows);
        // In variables of their own, which no store can change.
        const GroupRange range = range_;
        std::uint32_t* const vertices_of = vertices_of_;
        float* const all_sums = sums_;
        for (std::size_t i = 0, end = 3 * batch_.count, step = corner_step_; i < end; i += step) {
            if (!range.has(batch_.groups[i])) continue;
            const std::uint32_t place = batch_.groups[i] - range.begin;
            vertices_of[place] = batch_.vertices[i];
            float* const sums = all_sums + 4 * kRows * place;
            const float* const rows = rows_ + 4 * kRows * i;
#pragma GCC unroll 7
            for (std::size_t r = 0; r < kSums; r += 4) addRow(sums + r, rows + r);
#pragma GCC unroll 4
            for (std::size_t r = kSums; r < 4 * kRows; ++r) sums[r] = std::max(sums[r], rows[r]);
        }
    }

    std::size_t corner_step_;
    const SumRound& round_;
    float* sums_;
    std::uint32_t* vertices_of_;
    GroupRange range_;
    TriangleBatch batch_;
    alignas(64) float rows_[3 * SumRound::kTriangles * 4 * kMostRows];
};

}  // namespace

SumRounds::SumRounds(const TriangleGroups& triangles, std::size_t adding_corners, std::size_t group_count,
                     std::size_t most_rows, const Allocator* allocator, Parallel& parallel)
    : triangles_(triangles),
      corner_step_(adding_corners == 1 ? 3 : 1),
      lists_(triangles, SumRound::kTriangles, group_count, std::bit_floor(kRangeBytes / (most_rows * sizeof(float[4]))),
             allocator, parallel),
      tasks_(parallel.width() == 1 ? 1 : std::min(lists_.count(), kTasksPerThread * parallel.width())),
      parallel_(parallel) {
    const std::size_t room = wholeLanes(lists_.range(0).size());
    sums_ = Buffer<float>(allocator, tasks_ * room * 4 * most_rows);
    vertices_ = Buffer<std::uint32_t>(allocator, tasks_ * room);
}

void SumRounds::run(const SumRound& round) {
    parallel_.forTasks(tasks_, [&](std::size_t task) {
        RangeOfRound work(corner_step_, round, sums_.data() + sums_.size() / tasks_ * task,
                          vertices_.data() + vertices_.size() / tasks_ * task);
        for (std::size_t r = lists_.count() * task / tasks_; r < lists_.count() * (task + 1) / tasks_; ++r)
            work.run(lists_.range(r), {triangles_, lists_, r});
    });
}

}  // namespace tspace
