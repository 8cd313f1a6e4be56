// SPDX-License-Identifier: MIT
// Step 9: tangents of a pose. For each group the weighted sum of its members' projected tangents, in
// ascending order of triangles, and the same for bitangents and lengths.
//
// mikktspace: weight = the angle between the two edges at the corner after projection along N.
// uniform, angle, area: weight = 1, the interior angle of the triangle at the corner, or its area. The terms
// are unit face tangents projected along the corner's N and normalised again, as in mikktspace.
#include <algorithm>
#include <atomic>
#include <cmath>

#include "tangents/mikktspace/grouped_plan.h"
#include "tangents/mikktspace/lanes.h"
#include "tangents/mikktspace/triangle_pass.h"
#include "tangents/mikktspace/vector_rules.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kGrain = 1024;      // nodes or triangles per task at least
constexpr std::uint32_t kLookAhead = 24;  // corners; far enough for a line to arrive from memory

struct Tangents {
    Vec3 s{1, 0, 0}, t{0, 1, 0};
    float mag_s = 1, mag_t = 1;
    bool positive = false;
};

bool sameResult(const Tangents& a, const Tangents& b) {
    return a.mag_s == b.mag_s && a.mag_t == b.mag_t && a.s == b.s && a.t == b.t;
}

/// The reference's rule for a corner that is written again: equal results stay (a NaN is never equal), others
/// become the normalised mean. The orientation is the later one's.
void merge(Tangents& first, const Tangents& second) {
    first.positive = second.positive;
    if (sameResult(first, second)) return;
    first.mag_s = 0.5f * (first.mag_s + second.mag_s);
    first.mag_t = 0.5f * (first.mag_t + second.mag_t);
    first.s = unit(first.s + second.s);
    first.t = unit(first.t + second.t);
}

/// The outputs, of which some may be missing.
class Sink {
  public:
    Sink(const TangentOutput& out, const GroupedPlan& plan)
        : out_(out), sign_factor_(plan.sign_factor), bitangent_factor_(plan.bitangent_factor) {}

    void write(std::size_t corner, const Tangents& r) const {
        const float sign = r.positive ? sign_factor_ : -sign_factor_;
        out_.tangents[corner] = {r.s.x, r.s.y, r.s.z, sign};
        if (!out_.bitangents.empty()) out_.bitangents[corner] = bitangent_factor_ * r.t;
        if (!out_.magnitudes_s.empty()) out_.magnitudes_s[corner] = r.mag_s;
        if (!out_.magnitudes_t.empty()) out_.magnitudes_t[corner] = r.mag_t;
    }
    void clear(std::size_t corner) const {
        out_.tangents[corner] = {};
        if (!out_.bitangents.empty()) out_.bitangents[corner] = {};
        if (!out_.magnitudes_s.empty()) out_.magnitudes_s[corner] = 0;
        if (!out_.magnitudes_t.empty()) out_.magnitudes_t[corner] = 0;
    }
    void copy(const Copy& c) const {
        out_.tangents[c.to] = out_.tangents[c.from];
        if (!out_.bitangents.empty()) out_.bitangents[c.to] = out_.bitangents[c.from];
        if (!out_.magnitudes_s.empty()) out_.magnitudes_s[c.to] = out_.magnitudes_s[c.from];
        if (!out_.magnitudes_t.empty()) out_.magnitudes_t[c.to] = out_.magnitudes_t[c.from];
    }
    [[nodiscard]] bool isFinite(std::size_t corner) const {
        return tspace::isFinite(xyz(out_.tangents[corner]));
    }

  private:
    TangentOutput out_;
    float sign_factor_, bitangent_factor_;
};

/// The running sums of one group or subset.
struct Sums {
    Vec3 s, t;
    float mag_s = 0, mag_t = 0, weight = 0;

    void add(float w, const Vec3& projected_s, const Vec3& projected_t, const TriangleFrame& frame) {
        s = s + w * projected_s;
        t = t + w * projected_t;
        mag_s = mag_s + w * frame.mag_s;
        mag_t = mag_t + w * frame.mag_t;
        weight = weight + w;
    }
    [[nodiscard]] Tangents mean(bool positive) const {
        Tangents r{unit(s), unit(t), mag_s, mag_t, positive};
        if (weight > 0) {
            r.mag_s /= weight;
            r.mag_t /= weight;
        }
        return r;
    }
};

/// What all parts of one evaluation share.
struct Job {
    const GroupedPlan& plan;
    const Pose& pose;
    const PoseData& data;
    Sink sink;
    Buffer<Tangents> conflicts;  ///< results for the marked slots, as plan.conflicts
    std::atomic<std::uint64_t> zero_count{0};

    [[nodiscard]] std::uint8_t flags(std::uint32_t entry) const { return plan.flags[(entry & kValue) / 3]; }
    [[nodiscard]] const TriangleFrame& frame(std::uint32_t entry) const {
        return data.frames[(entry & kValue) / 3];
    }

    /// The method's default for a group whose sum vanishes. The reference leaves such a tangent zero, and so
    /// does mikktspace.
    bool replaceZero(Tangents& r) const {
        if (plan.method == Method::mikktspace || (notZero(r.s) || r.s.x != r.s.x)) return false;
        const bool positive = r.positive;
        r = Tangents{};
        r.positive = positive;
        return true;
    }

    /// Writes the result of the tricorner at a position of plan.list.
    void write(std::uint32_t position, const Tangents& r) {
        const std::uint32_t tricorner = plan.list[position] & kValue;
        const std::uint32_t slot = plan.slots.empty() ? tricorner : plan.slots[tricorner];
        if ((slot & kMark) == 0) {
            sink.write(slot, r);
            return;
        }
        const std::uint32_t* at = std::lower_bound(plan.conflicts.begin(), plan.conflicts.end(), position);
        conflicts[static_cast<std::size_t>(at - plan.conflicts.begin())] = r;
    }

    /// Whether the tricorner at a position has the slot of the one before it. (Slots with several results are
    /// not meant: mergeConflicts sees to those.)
    [[nodiscard]] bool repeatsSlot(std::uint32_t position) const {
        if (plan.slots.empty()) return false;
        const std::uint32_t slot = plan.slots[plan.list[position] & kValue];
        return (slot & kMark) == 0 && slot == plan.slots[plan.list[position - 1] & kValue];
    }

    /// Writes one result to all tricorners at [begin, end) of plan.list. Two of them with one slot are
    /// neighbours there; merging a result with itself changes it only when there is a NaN.
    void writeAll(std::uint32_t begin, std::uint32_t end, const Tangents& r) {
        if (sameResult(r, r)) {
            for (std::uint32_t e = begin; e < end; ++e) write(e, r);
            return;
        }
        Tangents merged;
        for (std::uint32_t e = begin; e < end; ++e) {
            if (e > begin && repeatsSlot(e)) {
                merge(merged, r);
            } else {
                merged = r;
            }
            write(e, merged);
        }
    }
};

struct Corner {
    std::uint32_t node, next, previous;
};

Corner cornerOf(const GroupedPlan& plan, std::uint32_t entry) {
    const std::uint32_t h = entry & kValue, first = h - h % 3, k = h - first;
    return {plan.nodes[h], plan.nodes[first + (k + 1) % 3], plan.nodes[first + (k + 2) % 3]};
}

/// Projected tangents and weights of up to kBlock corners at consecutive positions of the list.
class CornerBlock {
  public:
    Lanes3 s, t;
    alignas(64) float weight[kBlock] = {};

    /// Fills the block from `count` positions of plan.list.
    void load(const Job& job, std::uint32_t begin, std::uint32_t count) {
        for (std::uint32_t i = 0; i < count; ++i) {
            fetchAhead(job, begin + i);
            const std::uint32_t entry = job.plan.list[begin + i];
            const Corner corner = cornerOf(job.plan, entry);
            const TriangleFrame& frame = job.frame(entry);
            const Vec3 here = job.data.positions[corner.node];
            normal_.set(i, job.pose.normals[job.plan.node_vertex[corner.node]]);
            s.set(i, frame.s);
            t.set(i, frame.t);
            previous_.set(i, job.data.positions[corner.previous] - here);
            next_.set(i, job.data.positions[corner.next] - here);
        }
        flattenLanes(normal_, s, count);
        flattenLanes(normal_, t, count);
        weigh(job.plan.method, count);
    }

  private:
    /// Memory is asked for early: triangles first, then the nodes that they name.
    static void fetchAhead(const Job& job, std::uint32_t position) {
        const auto& list = job.plan.list;
        if (position + 2 * kLookAhead >= list.size()) return;
        const std::uint32_t far = list[position + 2 * kLookAhead] & kValue;
        __builtin_prefetch(&job.plan.nodes[far]);
        __builtin_prefetch(&job.data.frames[far / 3]);
        const Corner corner = cornerOf(job.plan, list[position + kLookAhead]);
        __builtin_prefetch(&job.data.positions[corner.next]);
        __builtin_prefetch(&job.data.positions[corner.previous]);
    }

    void weigh(Method method, std::uint32_t count) {
        switch (method) {
            case Method::uniform:
                std::fill_n(weight, count, 1.0f);
                return;
            case Method::area:
                for (std::uint32_t i = 0; i < count; ++i)
                    weight[i] = 0.5f * length(cross(next_.get(i), previous_.get(i)));
                return;
            case Method::angle:
                for (std::uint32_t i = 0; i < count; ++i) {
                    previous_.set(i, unit(previous_.get(i)));
                    next_.set(i, unit(next_.get(i)));
                }
                break;
            default:
                flattenLanes(normal_, previous_, count);
                flattenLanes(normal_, next_, count);
                break;
        }
        angleLanes(previous_, next_, weight, count);
    }

    Lanes3 normal_, previous_, next_;
};

/// Groups whose members all share one result, for a range of nodes.
class GroupEvaluator {
  public:
    explicit GroupEvaluator(Job& job) : job_(job) {}

    void run(std::size_t first_node, std::size_t end_node) {
        const GroupedPlan& plan = job_.plan;
        const std::uint32_t first = plan.node_begin[first_node], end = plan.node_begin[end_node];
        split_ = std::lower_bound(plan.split_groups.begin(), plan.split_groups.end(), first,
                                  [](const SplitGroup& g, std::uint32_t at) { return g.begin < at; });
        group_begin_ = first;
        for (std::uint32_t begin = first; begin < end; begin += kBlock) {
            const std::uint32_t count = std::min<std::uint32_t>(kBlock, end - begin);
            block_.load(job_, begin, count);
            for (std::uint32_t i = 0; i < count; ++i) {
                const std::uint32_t entry = plan.list[begin + i];
                if ((entry & kMark) != 0) finish(begin + i);
                const std::uint8_t flags = job_.flags(entry);
                if ((flags & kAny) != 0) continue;
                positive_ = (flags & kPositive) != 0;
                has_members_ = true;
                sums_.add(block_.weight[i], block_.s.get(i), block_.t.get(i), job_.frame(entry));
            }
        }
        finish(end);
    }

  private:
    /// Writes the group that ends before `end`. A group without a usable triangle is a node's ungrouped rest.
    void finish(std::uint32_t end) {
        const GroupedPlan& plan = job_.plan;
        if (split_ != plan.split_groups.end() && split_->begin == group_begin_) {
            ++split_;
        } else if (has_members_) {
            Tangents result = sums_.mean(positive_);
            if (job_.replaceZero(result)) job_.zero_count += end - group_begin_;
            job_.writeAll(group_begin_, end, result);
        }
        group_begin_ = end;
        has_members_ = false;
        sums_ = Sums{};
    }

    Job& job_;
    CornerBlock block_;
    const SplitGroup* split_ = nullptr;
    std::uint32_t group_begin_ = 0;
    bool has_members_ = false, positive_ = false;
    Sums sums_;
};

/// Memory for the members of one split group.
struct Term {
    Vec3 s, t;
    float weight;
};

/// A group in which each member has a subset of its own.
void evaluateSplitGroup(Job& job, const SplitGroup& group, Term* terms, Tangents* results) {
    const GroupedPlan& plan = job.plan;
    bool positive = false;
    CornerBlock block;
    for (std::uint32_t begin = 0; begin < group.count; begin += kBlock) {
        const std::uint32_t count = std::min<std::uint32_t>(kBlock, group.count - begin);
        block.load(job, group.begin + begin, count);
        for (std::uint32_t i = 0; i < count; ++i)
            terms[begin + i] = {block.s.get(i), block.t.get(i), block.weight[i]};
    }
    for (std::uint32_t i = 0; i < group.count; ++i) {
        const std::uint8_t flags = job.flags(plan.list[group.begin + i]);
        if ((flags & kAny) == 0) positive = (flags & kPositive) != 0;
    }
    const std::size_t words = (std::size_t{group.count} + 63) / 64;
    Tangents merged;
    for (std::uint32_t a = 0; a < group.count; ++a) {
        const std::uint32_t leader = plan.split_leaders[group.leaders + a];
        if (leader == a) {
            const std::uint64_t* row = plan.split_rows.data() + group.rows + a * words;
            Sums sums;
            for (std::uint32_t b = 0; b < group.count; ++b) {
                if ((row[b / 64] >> (b % 64) & 1) == 0) continue;
                sums.add(terms[b].weight, terms[b].s, terms[b].t, job.frame(plan.list[group.begin + b]));
            }
            results[a] = sums.mean(positive);
        }
        if (a > 0 && leader == plan.split_leaders[group.leaders + a - 1] &&
            job.repeatsSlot(group.begin + a)) {
            merge(merged, results[leader]);
        } else {
            merged = results[leader];
        }
        job.write(group.begin + a, merged);
    }
}

void evaluateSplitGroups(Job& job, const Allocator* allocator, Parallel& parallel) {
    const auto& groups = job.plan.split_groups;
    if (groups.empty()) return;
    const std::size_t most = job.plan.largest_split_group;
    const std::size_t tasks =
        std::min<std::size_t>(groups.size() / 64 + 1, parallel.width() == 1 ? 1 : 4 * parallel.width());
    Buffer<Term> terms(allocator, tasks * most);
    Buffer<Tangents> results(allocator, tasks * most);
    parallel.forTasks(tasks, [&](std::size_t task) {
        for (std::size_t g = groups.size() * task / tasks; g < groups.size() * (task + 1) / tasks; ++g) {
            evaluateSplitGroup(job, groups[g], terms.data() + task * most, results.data() + task * most);
        }
    });
}

/// Slots that several tricorners write with different results. Two is what the reference knows (the corners
/// at a quad's diagonal); further ones, which only n-gons have, are merged one by one.
void mergeConflicts(const Job& job) {
    const GroupedPlan& plan = job.plan;
    const auto slotOf = [&](std::size_t i) {
        return plan.slot(plan.list[plan.conflicts[plan.conflict_order[i]]] & kValue);
    };
    for (std::size_t begin = 0; begin < plan.conflict_order.size();) {
        const std::uint32_t slot = slotOf(begin);
        Tangents merged = job.conflicts[plan.conflict_order[begin]];
        std::size_t end = begin + 1;
        for (; end < plan.conflict_order.size() && slotOf(end) == slot; ++end) {
            merge(merged, job.conflicts[plan.conflict_order[end]]);
        }
        job.sink.write(slot, merged);
        begin = end;
    }
}

void writeRest(const Job& job) {
    for (const std::uint32_t corner : job.plan.default_corners) job.sink.write(corner, Tangents{});
    for (const std::uint32_t corner : job.plan.skipped_corners) job.sink.clear(corner);
    for (const Copy& copy : job.plan.copies) job.sink.copy(copy);
}

std::uint64_t countNotFinite(const Job& job, Parallel& parallel) {
    std::atomic<std::uint64_t> total{0};
    parallel.forRanges(job.plan.corner_count, 16 * kGrain, [&](std::size_t begin, std::size_t end) {
        std::uint64_t count = 0;
        for (std::size_t c = begin; c < end; ++c) count += !job.sink.isFinite(c);
        total += count;
    });
    return total.load();
}

}  // namespace

PoseData readPose(const GroupedPlan& plan, const Pose& pose, const Allocator* allocator, Parallel& parallel) {
    PoseData data{Buffer<Vec3>(allocator, plan.node_count),
                  Buffer<TriangleFrame>(allocator, plan.triangle_count)};
    parallel.forRanges(plan.node_count, kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) data.positions[n] = pose.positions[plan.node_vertex[n]];
    });
    parallel.forRanges(plan.triangle_count, kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            const std::uint32_t* n = plan.nodes.data() + 3 * t;
            data.frames[t] = triangleShape(data.positions[n[0]], data.positions[n[1]], data.positions[n[2]],
                                           plan.node_uv[n[0]], plan.node_uv[n[1]], plan.node_uv[n[2]])
                                 .frame;
        }
    });
    return data;
}

TangentReport evaluateGrouped(const GroupedPlan& plan, const Pose& pose, const PoseData& data,
                              const TangentOutput& out, const Allocator* allocator, Parallel& parallel) {
    Job job{plan, pose, data, Sink(out, plan),
            Buffer<Tangents>(allocator, plan.conflicts.size())};
    parallel.forRanges(plan.node_count, kGrain,
                       [&](std::size_t begin, std::size_t end) { GroupEvaluator(job).run(begin, end); });
    evaluateSplitGroups(job, allocator, parallel);
    mergeConflicts(job);
    writeRest(job);
    TangentReport report = plan.report;
    report.default_corner_count += job.zero_count.load();
    report.not_finite_count = countNotFinite(job, parallel);
    return report;
}

}  // namespace tspace::mikk
