// SPDX-License-Identifier: MIT
// Step 8: splits. A cheap test on blocks of corners shows for nearly all groups that nothing can split; only
// the others compare all members with each other.
#include "tangents/mikktspace/splits.h"

#include <algorithm>
#include <cmath>

#include "tangents/mikktspace/growing.h"
#include "tangents/mikktspace/lanes.h"
#include "tangents/mikktspace/vector_rules.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kGrain = 2048;      // nodes
constexpr std::uint32_t kLookAhead = 32;  // corners; far enough for a line to arrive from memory
/// Far more than the rounding errors of a projection and three dot products.
constexpr float kMargin = 1e-2f;

bool isAny(const GroupedPlan& plan, std::uint32_t tricorner) {
    return (plan.flags[(tricorner & kValue) / 3] & kAny) != 0;
}

/// If all members lie within half the threshold of one direction, all pairs are within the threshold: the
/// cosine of the half angle is sqrt((1 + c) / 2).
class QuickTest {
  public:
    explicit QuickTest(float threshold_cosine) : limit_(std::sqrt((1.0f + threshold_cosine) * 0.5f) + kMargin) {}

    void start() { has_first_ = false; }
    /// Returns false when the member may differ too much from the first one (always for NaN).
    bool add(const Vec3& s, const Vec3& t) {
        if (!has_first_) {
            has_first_ = true;
            first_s_ = s;
            first_t_ = t;
            return true;
        }
        return dot(first_s_, s) > limit_ && dot(first_t_, t) > limit_;
    }

  private:
    float limit_;
    bool has_first_ = false;
    Vec3 first_s_, first_t_;
};

/// Marks the nodes with a group that might split.
class SuspectFinder {
  public:
    SuspectFinder(const GroupedPlan& plan, float threshold_cosine, const Pose& pose, const PoseData& data,
                  Buffer<std::uint8_t>& suspects)
        : plan_(plan), test_(threshold_cosine), pose_(pose), data_(data), suspects_(suspects) {}

    void run(std::size_t first_node, std::size_t end_node) {
        std::uint32_t node = static_cast<std::uint32_t>(first_node);
        const std::uint32_t end = plan_.node_begin[end_node];
        Vec3 normal;
        std::uint32_t node_end = plan_.node_begin[first_node];
        for (std::uint32_t begin = plan_.node_begin[first_node]; begin < end; begin += kBlock) {
            const std::uint32_t count = std::min<std::uint32_t>(kBlock, end - begin);
            for (std::uint32_t i = 0; i < count; ++i) {
                if (begin + i + kLookAhead < end) {
                    const std::uint32_t ahead = (plan_.list[begin + i + kLookAhead] & kValue) / 3;
                    __builtin_prefetch(&data_.frames[ahead]);
                    __builtin_prefetch(&plan_.flags[ahead]);
                }
                while (begin + i == node_end) {
                    normal = pose_.normals[plan_.node_vertex[node]];
                    node_end = plan_.node_begin[++node];
                }
                const TriangleFrame& frame = data_.frames[(plan_.list[begin + i] & kValue) / 3];
                normals_.set(i, normal);
                s_.set(i, frame.s);
                t_.set(i, frame.t);
                node_[i] = node - 1;
            }
            flattenLanes(normals_, s_, count);
            flattenLanes(normals_, t_, count);
            for (std::uint32_t i = 0; i < count; ++i) {
                const std::uint32_t entry = plan_.list[begin + i];
                if ((entry & kMark) != 0) test_.start();
                if (!isAny(plan_, entry) && !test_.add(s_.get(i), t_.get(i))) suspects_[node_[i]] = 1;
            }
        }
    }

  private:
    const GroupedPlan& plan_;
    QuickTest test_;
    const Pose& pose_;
    const PoseData& data_;
    Buffer<std::uint8_t>& suspects_;
    Lanes3 normals_, s_, t_;
    std::uint32_t node_[kBlock] = {};
};

/// Compares all members of a group with each other, as the reference does.
class Splitter {
  public:
    Splitter(GroupedPlan& plan, float threshold_cosine, const Pose& pose, const PoseData& data,
             const Buffer<std::uint32_t>& faces, const Allocator* allocator)
        : plan_(plan),
          cosine_(threshold_cosine),
          pose_(pose),
          data_(data),
          faces_(faces),
          allocator_(allocator),
          groups_(allocator),
          rows_(allocator),
          leaders_(allocator) {}

    void node(std::uint32_t node) {
        normal_ = pose_.normals[plan_.node_vertex[node]];
        const std::uint32_t end = plan_.node_begin[node + 1];
        for (std::uint32_t begin = plan_.node_begin[node]; begin < end;) {
            std::uint32_t after = begin + 1;
            while (after < end && (plan_.list[after] & kMark) == 0) ++after;
            if (after - begin > 1) group(begin, after - begin);
            begin = after;
        }
    }

    void finish() {
        plan_.split_groups = groups_.exact();
        plan_.split_rows = rows_.exact();
        plan_.split_leaders = leaders_.exact();
        for (const SplitGroup& g : plan_.split_groups) {
            plan_.largest_split_group = std::max(plan_.largest_split_group, g.count);
        }
    }

  private:
    [[nodiscard]] std::uint32_t face(std::uint32_t tricorner) const {
        const std::uint32_t t = tricorner / 3;
        return faces_.empty() ? t : faces_[t];
    }

    void project(std::uint32_t begin, std::uint32_t count) {
        if (s_.size() < count) {
            const std::uint32_t room = std::max<std::uint32_t>(count, kBlock);
            s_ = Buffer<Vec3>(allocator_, room);
            t_ = Buffer<Vec3>(allocator_, room);
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            const TriangleFrame& frame = data_.frames[(plan_.list[begin + i] & kValue) / 3];
            s_[i] = flatten(normal_, frame.s);
            t_[i] = flatten(normal_, frame.t);
        }
    }

    /// A second quick test for large groups: around the mean direction instead of the first member's.
    bool isNarrow(std::uint32_t begin, std::uint32_t count) {
        Vec3 mean_s, mean_t;
        for (std::uint32_t i = 0; i < count; ++i) {
            if (isAny(plan_, plan_.list[begin + i])) continue;
            mean_s = mean_s + s_[i];
            mean_t = mean_t + t_[i];
        }
        QuickTest test(cosine_);
        test.start();
        test.add(unit(mean_s), unit(mean_t));
        for (std::uint32_t i = 0; i < count; ++i) {
            if (!isAny(plan_, plan_.list[begin + i]) && !test.add(s_[i], t_[i])) return false;
        }
        return true;
    }

    void group(std::uint32_t begin, std::uint32_t count) {
        if (count > kLargestSplitGroup) {
            project(begin, count);
            if (!isNarrow(begin, count)) plan_.report.reference_order_abandoned = true;
            return;
        }
        project(begin, count);
        const std::size_t words = (std::size_t{count} + 63) / 64;
        const std::size_t first_row = rows_.size();
        std::uint64_t* rows = rows_.extend(words * count);
        std::fill_n(rows, words * count, std::uint64_t{0});
        bool whole = true;
        for (std::uint32_t a = 0; a < count; ++a) {
            const std::uint32_t entry_a = plan_.list[begin + a] & kValue;
            const bool any_a = isAny(plan_, entry_a);
            for (std::uint32_t b = 0; b < count; ++b) {
                const std::uint32_t entry_b = plan_.list[begin + b] & kValue;
                if (isAny(plan_, entry_b)) continue;  // belongs to every subset, but adds nothing
                const bool together = any_a || face(entry_a) == face(entry_b) ||
                                      (dot(s_[a], s_[b]) > cosine_ && dot(t_[a], t_[b]) > cosine_);
                if (together) {
                    rows[a * words + b / 64] |= std::uint64_t{1} << (b % 64);
                } else {
                    whole = false;
                }
            }
        }
        if (whole) {
            rows_.drop(words * count);
            return;
        }
        groups_.push({begin, count, first_row, leaders_.size()});
        findLeaders(rows, count, words);
    }

    void findLeaders(const std::uint64_t* rows, std::uint32_t count, std::size_t words) {
        std::uint32_t* leaders = leaders_.extend(count);
        for (std::uint32_t a = 0; a < count; ++a) {
            leaders[a] = a;
            for (std::uint32_t b = 0; b < a; ++b) {
                if (leaders[b] == b && std::equal(rows + a * words, rows + (a + 1) * words, rows + b * words)) {
                    leaders[a] = b;
                    break;
                }
            }
        }
    }

    GroupedPlan& plan_;
    float cosine_;
    const Pose& pose_;
    const PoseData& data_;
    const Buffer<std::uint32_t>& faces_;
    const Allocator* allocator_;
    Vec3 normal_;
    Buffer<Vec3> s_, t_;
    Growing<SplitGroup> groups_;
    Growing<std::uint64_t> rows_;
    Growing<std::uint32_t> leaders_;
};

}  // namespace

void findSplits(GroupedPlan& plan, float threshold_cosine, const Pose& pose, const PoseData& data,
                const Buffer<std::uint32_t>& faces, const Allocator* allocator, Parallel& parallel) {
    Buffer<std::uint8_t> suspects(allocator, plan.listed_count, std::uint8_t{0});
    parallel.forRanges(plan.listed_count, kGrain, [&](std::size_t begin, std::size_t end) {
        SuspectFinder(plan, threshold_cosine, pose, data, suspects).run(begin, end);
    });
    Splitter splitter(plan, threshold_cosine, pose, data, faces, allocator);
    for (std::size_t node = 0; node < plan.listed_count; ++node) {
        if (suspects[node] != 0) splitter.node(static_cast<std::uint32_t>(node));
    }
    splitter.finish();
}

}  // namespace tspace::mikk
