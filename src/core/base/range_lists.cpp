// SPDX-License-Identifier: MIT
// Implements lists of the triangles of each range, rounds of sums over these lists, and input scaling.
#include "core/base/range_lists.h"

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/base/vec_math.h"

namespace tspace {
namespace {

constexpr std::size_t kBlocksPerTask = 256;
constexpr std::uint32_t kNoRange = 0xffffffffu, kSeveral = 0xfffffffeu;

/// Reads blocks of triangles and finds the ranges to which their triangles contribute.
class Walk {
  public:
    Walk(const TriangleGroups& triangles, std::size_t block_size, std::size_t group_count, std::size_t range_size)
        : triangles_(triangles), block_size_(block_size), shift_(std::countr_zero(range_size)),
          range_count_(static_cast<std::uint32_t>((group_count + range_size - 1) >> shift_)) {}

    void read(std::size_t block) {
        first_ = block * block_size_;
        size_ = std::min(block_size_, triangles_.count - first_);
        groups_ = triangles_.inPlace(first_, size_).groups;
        if (groups_ != nullptr) return;
        triangles_.read(first_, size_, nullptr, own_groups_);
        groups_ = own_groups_;
    }

    /// Returns the range of the current block, kNoRange, or kSeveral.
    [[nodiscard]] std::uint32_t range() const {
        const std::uint32_t *const groups = groups_, *const end = groups + 3 * size_;
        std::uint32_t any = 0, all = ~std::uint32_t{0};
        for (const std::uint32_t* group = groups; group != end; ++group) {
            any |= *group;
            all &= *group;
        }
        if ((any ^ all) >> shift_ == 0) return rangeOf(groups[0]);
        if (rangeOf(any) != kNoRange) return kSeveral;
        std::uint32_t only = kNoRange;
        for (const std::uint32_t* group = groups; group != end; ++group) {
            const std::uint32_t range = rangeOf(*group);
            if (range == kNoRange) continue;
            if (only != kNoRange && range != only) return kSeveral;
            only = range;
        }
        return only;
    }

    /// Calls enter(range, triangle) for each range of each triangle of the current block.
    template <class Enter>
    void forTriangles(const Enter& enter) const {
        for (std::size_t t = 0; t < size_; ++t) {
            const auto triangle = static_cast<std::uint32_t>(first_ + t);
            const std::uint32_t* const groups = groups_ + 3 * t;
            const std::uint32_t a = rangeOf(groups[0]);
            if (a != kNoRange) enter(a, triangle);
            if (((groups[0] ^ groups[1]) | (groups[0] ^ groups[2])) >> shift_ == 0) continue;
            const std::uint32_t b = rangeOf(groups[1]), c = rangeOf(groups[2]);
            if (b != kNoRange && b != a) enter(b, triangle);
            if (c != kNoRange && c != a && c != b) enter(c, triangle);
        }
    }

  private:
    [[nodiscard]] std::uint32_t rangeOf(std::uint32_t group) const {
        return group >> shift_ < range_count_ ? group >> shift_ : kNoRange;
    }

    const TriangleGroups& triangles_;
    std::size_t block_size_;
    int shift_;
    std::uint32_t range_count_;
    std::size_t first_ = 0, size_ = 0;
    const std::uint32_t* groups_ = nullptr;
    std::uint32_t own_groups_[3 * TriangleBatch::kMost] = {};
};

}  // namespace

RangeLists::RangeLists(const TriangleGroups& triangles, std::size_t block_size, std::size_t group_count,
                       std::size_t range_size, const Allocator* allocator, Parallel& parallel)
    : RangeLists(block_size, group_count, range_size) {
    if (count_ <= 1) return;
    const std::size_t blocks = blockCount(triangles.count);
    const std::size_t tasks = std::clamp<std::size_t>(blocks / kBlocksPerTask, 1, parallel.width());
    // Holds the number of entries per task and range, and later the positions of the entries: within a range, task
    // after task.
    Buffer<std::size_t> places(allocator, tasks * count_, std::size_t{0});
    Buffer<std::uint32_t> range_of(allocator, blocks);
    const auto forEntries = [&](bool is_known, const auto& body) {
        parallel.forTasks(tasks, [&](std::size_t task) {
            Walk walk(triangles, block_size, group_count, range_size);
            std::size_t* const mine = places.data() + task * count_;
            const auto enter = [&](std::uint32_t range, std::uint32_t entry) { body(mine[range]++, entry); };
            for (std::size_t b = blocks * task / tasks; b < blocks * (task + 1) / tasks; ++b) {
                if (!is_known || range_of[b] == kSeveral) walk.read(b);
                if (!is_known) range_of[b] = walk.range();
                if (range_of[b] == kSeveral) {
                    walk.forTriangles(enter);
                } else if (range_of[b] != kNoRange) {
                    enter(range_of[b], kBlock | static_cast<std::uint32_t>(b));
                }
            }
        });
    };
    forEntries(false, [](std::size_t, std::uint32_t) {});
    begin_ = Buffer<std::size_t>(allocator, count_ + 1);
    std::size_t total = 0;
    for (std::size_t range = 0; range < count_; ++range) {
        begin_[range] = total;
        for (std::size_t task = 0; task < tasks; ++task) total += std::exchange(places[task * count_ + range], total);
    }
    begin_[count_] = total;
    entries_ = Buffer<std::uint32_t>(allocator, total);
    forEntries(true, [&](std::size_t place, std::uint32_t entry) { entries_[place] = entry; });
}

bool RangeLists::areCompact(const TriangleGroups& triangles, std::size_t block_size, std::size_t group_count,
                            std::size_t range_size) {
    constexpr std::size_t kSamples = 64;
    if (group_count <= range_size) return true;
    const std::size_t blocks = (triangles.count + block_size - 1) / block_size, samples = std::min(blocks, kSamples);
    Walk walk(triangles, block_size, group_count, range_size);
    std::size_t several = 0;
    for (std::size_t i = 0; i < samples; ++i) {
        walk.read((2 * i + 1) * blocks / (2 * samples));
        several += walk.range() == kSeveral ? 1u : 0u;
    }
    return 2 * several <= samples;
}

std::size_t RangeLists::mostTriangles(std::size_t all) const {
    if (begin_.empty()) return all;
    std::size_t most = 0;
    for (std::size_t range = 0; range < count_; ++range) {
        std::size_t here = 0;
        for (const std::uint32_t entry : entries(range)) here += (entry & kBlock) != 0 ? block_size_ : 1;
        most = std::max(most, here);
    }
    return most;
}

RangeLists::Batches::Batches(const TriangleGroups& triangles, const RangeLists& lists, std::size_t range)
    : Batches(triangles, lists.block_size_, 0, lists.blockCount(triangles.count)) {
    are_whole_ = !lists.begin_.empty() || lists.count_ == 1;
    if (lists.begin_.empty()) return;
    entries_ = lists.entries_.data();
    next_ = lists.begin_[range];
    end_ = lists.begin_[range + 1];
}

bool RangeLists::Batches::next(TriangleBatch& batch, bool needs_vertices) {
    batch.count = 0;
    if (next_ == end_) return false;
    batch.vertices = batch.own_vertices;
    batch.groups = batch.own_groups;
    std::uint32_t* const vertices = needs_vertices ? batch.own_vertices : nullptr;
    batch.is_block = entries_ == nullptr || (entries_[next_] & kBlock) != 0;
    batch.is_whole = batch.is_block && are_whole_;
    if (!batch.is_block) {
        for (; next_ != end_ && batch.count < block_size_ && (entries_[next_] & kBlock) == 0; ++next_)
            batch.numbers[batch.count++] = entries_[next_];
        triangles_.readSome(batch.numbers, batch.count, vertices, batch.own_groups);
        return true;
    }
    const std::size_t block = entries_ != nullptr ? entries_[next_] & ~kBlock : next_, first = block * block_size_;
    ++next_;
    batch.numbers[0] = static_cast<std::uint32_t>(first);
    batch.count = std::min(block_size_, triangles_.count - first);
    TriangleGroups::InPlace in_place;
    if (batch.count == block_size_) in_place = triangles_.inPlace(first, batch.count);
    if (in_place.groups == nullptr) {
        triangles_.read(first, batch.count, vertices, batch.own_groups);
    } else {
        batch.vertices = in_place.vertices;
        batch.groups = in_place.groups;
    }
    return true;
}

namespace {

// Size of the sums of a range, in bytes: half of a typical L2 cache.
constexpr std::size_t kRangeBytes = std::size_t{512} << 10;
constexpr std::size_t kTasksPerThread = 4;
constexpr std::size_t kMostRows = 8;

std::size_t wholeLanes(std::size_t groups) {
    return (groups + SumRound::kGroups - 1) / SumRound::kGroups * SumRound::kGroups;
}

/// Processes the ranges of a task in one pass: clears the sums, adds the triangles, and calls `finish`.
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
            case 1: return addRows<1>();
            case 2: return addRows<2>();
            case 4: return addRows<4>();
            default: return round_.ends_in_maxima ? addRows<kMostRows, true>() : addRows<kMostRows - 1>();
        }
    }

    template <std::size_t kRows, bool kMaxima = false>
    void addRows() {
        constexpr std::size_t kSums = 4 * (kMaxima ? kRows - 1 : kRows);
        // Local copies, which the compiler knows not to alias the arrays that are written.
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
    : triangles_(triangles), corner_step_(adding_corners == 1 ? 3 : 1),
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

namespace {

constexpr std::size_t kMostSamples = 1024;

float largestOf(const Vec3& p) { return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}); }
float largestOf(const Vec2& p) { return std::max(std::fabs(p.x), std::fabs(p.y)); }

/// Mean magnitude of a set of numbers, from their exponents, so that a single outlier has little influence.
class MeanSize {
  public:
    void count(float size) {
        if (!(size > 0) || !(size <= FLT_MAX)) return;
        exponents_ += std::ilogb(size);
        ++count_;
    }

    /// Returns the factor that brings the mean magnitude close to 1. Its exponent is even, so its square root is also a
    /// power of two.
    [[nodiscard]] float scale() const {
        return count_ == 0 ? 1.0f : std::ldexp(1.0f, std::clamp(-exponents_ / count_, -126, 126) / 2 * 2);
    }

  private:
    int exponents_ = 0, count_ = 0;
};

}  // namespace

InputScale inputScale(const TriangleGroups& triangles, const StridedSpan<const Vec3>& positions,
                      const StridedSpan<const Vec2>& uvs) {
    MeanSize of_positions, of_uvs;
    const std::size_t samples = std::min(triangles.count, kMostSamples);
    for (std::size_t i = 0; i < samples; ++i) {
        std::uint32_t vertices[3], groups[3];
        triangles.read(triangles.count * i / samples, 1, vertices, groups);
        const Vec3 &a = positions[vertices[0]], &b = positions[vertices[1]], &c = positions[vertices[2]];
        if (a == b || b == c || c == a) continue;  // plans exclude triangles with two equal vertices
        for (const std::uint32_t v : vertices) {
            of_positions.count(largestOf(positions[v]));
            if (!uvs.empty()) of_uvs.count(largestOf(uvs[v]));
        }
    }
    return {of_positions.scale(), of_uvs.scale()};
}

}  // namespace tspace
