// SPDX-License-Identifier: MIT
// Evaluation: tangents of a pose by a plan. For each group it computes weighted sums of the members' projected
// tangents, bitangents and lengths, in ascending order of triangles; a group that splits has such sums for each member.
//
// corner_terms.h defines the contribution and weight of a member: the angle weight of mikktspace, and the weights of
// uniform, angle and area. For fast and best the results of the estimators (estimators/) replace the sums.
#include <algorithm>
#include <atomic>
#include <bit>

#include "core/base/range_lists.h"
#include "core/base/vec_math.h"
#include "core/tangents/method_kind.h"
#include "core/tangents/mikktspace/evaluate.h"

namespace tspace::mikk {
namespace {

constexpr std::size_t kGroupGrain = 8192, kWriteGrain = 8192;
// prefetch distance in bytes: a store waits for its cache line unless the line was prefetched
constexpr std::size_t kWriteAhead = 2048;

// minimum number of groups per task: for fewer, another thread costs more than it saves
constexpr std::size_t kGroupsPerTask = 4096;

/// Triangles of a plan, for range lists and estimators. A group with kTopBit counts as no group: the triangle does not
/// contribute to it.
class PlanTriangles final : public TriangleGroups {
  public:
    explicit PlanTriangles(const EvaluationPlan& plan) : TriangleGroups(plan.triangle_count), plan_(plan) {}
    void read(std::size_t first, std::size_t triangles, std::uint32_t* vertices, std::uint32_t* groups) const override {
        if (vertices != nullptr) std::copy_n(plan_.vertices.data() + 3 * first, 3 * triangles, vertices);
        std::copy_n(plan_.groups.data() + 3 * first, 3 * triangles, groups);
    }

  private:
    const EvaluationPlan& plan_;
};

/// Computes the sums of a range of groups, in the order of triangles.
void sumRange(const EvaluationPlan& plan, const CornerSource& source, CornerTermsFunction termsOf, GroupRange range,
              RangeLists::Batches triangles, GroupSums& sums) {
    const bool are_known = plan.hasTerms();  // true: terms are stored, so triangles are read in whole blocks
    std::fill_n(sums.groups.data() + range.begin, range.size(), Vec3{});
    if (!sums.rest.empty()) std::fill_n(sums.rest.data() + range.begin, range.size(), GroupRest{});
    TriangleBatch batch;
    CornerTerms computed;
    while (triangles.next(batch, !are_known)) {
        if (!are_known) {
            termsOf(source, fillGroup(batch.vertices, batch.count, kTermGroup, batch.own_vertices), batch.count,
                    computed);
        }
        const CornerTerms& terms = are_known ? plan.terms[batch.numbers[0] / kTermTriangles] : computed;
        for (std::size_t i = 0; i < 3 * batch.count; ++i) {
            const std::uint32_t group = batch.groups[i];
            if (!range.has(group)) continue;
            addVector(&sums.groups[group].x, terms.s[i]);
            if (sums.rest.empty()) continue;
            addRest(sums.rest[group], terms, i / 3, i % 3);
            sums.rest[group].weight += terms.s[i][3];
        }
    }
}

/// Computes the sums of all groups. A task owns a range of groups, as in node_sums.cpp.
GroupSums sumGroups(const EvaluationPlan& plan, const CornerSource& source, CornerTermsFunction terms,
                    const Allocator* allocator, Parallel& parallel) {
    GroupSums sums = allocateSums(plan, source.tangents_only, allocator);
    const std::size_t groups = plan.group_count;
    if (groups == 0) return sums;
    const PlanTriangles triangles(plan);
    const std::size_t tasks =
        std::clamp<std::size_t>(groups / kGroupsPerTask, 1, std::max<std::size_t>(1, parallel.width()));
    const std::size_t size = std::bit_ceil((groups + tasks - 1) / tasks);
    // A single range needs no lists. In builds without threads, the compiler then omits the code that creates them.
    const RangeLists lists = !plan.hasTerms() && tasks > 1
                                 ? RangeLists(triangles, kTermTriangles, groups, size, allocator, parallel)
                                 : RangeLists(kTermTriangles, groups, size);
    parallel.forTasks(lists.count(), [&](std::size_t task) {
        sumRange(plan, source, terms, lists.range(task), {triangles, lists, task}, sums);
    });
    return sums;
}

class Evaluation {
  public:
    Evaluation(const EvaluationPlan& plan, const Pose& pose, const StridedSpan<const Vec2>& uvs,
               const TangentOutput& out, const Execution& execution, Parallel& parallel)
        : plan_(plan), pose_(pose), uvs_(uvs), execution_(execution), out_(out), sink_(out, plan.convention),
          defaults_(out), terms_(cornerTermsFor(execution.simd)),
          source_(cornerSource(pose, uvs, plan.method, needsOnlyTangents(plan, out))), allocator_(execution.allocator),
          parallel_(parallel) {
        source_.with_marks = false;
    }

    /// Evaluates the plan. `estimates`: null, or results of the estimators, which are moved from.
    TangentReport run(GroupSums* estimates) {
        TangentReport report = plan_.report;
        if (plan_.vertex_count == 0) return report;
        if (estimates != nullptr) {
            sums_ = std::move(*estimates);
        } else if (!isEstimated(plan_.method)) {
            sums_ = sumGroups(plan_, source_, terms_, allocator_, parallel_);
        } else if constexpr (kHasAllMethods) {
            estimate();
        }
        finishGroups();
        writeCorners();
        evaluateSplits();
        mergeConflicts();
        for (const std::uint32_t corner : plan_.default_corners) sink_.write(corner, Tangents{});
        for (const std::uint32_t corner : plan_.skipped_corners) sink_.clear(corner);
        for (const Copy& copy : plan_.copies) sink_.copy(copy);
        report.default_corner_count = countDefaults();
        report.not_finite_count = finite_ ? 0 : countNotFinite();
        return report;
    }

  private:
    void estimate() {
        const PlanTriangles triangles(plan_);
        const InputScale scale = inputScale(triangles, pose_.positions, uvs_);
        sums_ = allocateSums(plan_, source_.tangents_only, allocator_);
        const estimators::GroupEstimates to = estimatesIn(sums_);
        estimators::estimateGroups(plan_.method, plan_.refine, triangles, pose_, uvs_, scale, {&to, 1}, execution_,
                                   parallel_);
    }

    /// Converts sums to results, in place.
    void finishGroups() {
        const bool replaces = !isMikktspace(plan_.method);
        if (replaces) replaced_ = Buffer<std::uint8_t>(allocator_, plan_.group_count, std::uint8_t{0});
        parallel_.forRanges(plan_.group_count, kGroupGrain, [&](std::size_t begin, std::size_t end) {
            bool any_zero = false, all_finite = true;
            for (std::size_t g = begin; g < end; ++g) {
                Tangents r = finished(g);
                // If a sum vanishes, the reference and mikktspace write zero; other methods write a default.
                if (replaces && !notZero(r.s) && r.s.x == r.s.x) {
                    r = Tangents{};
                    replaced_[g] = 1;
                    any_zero = true;
                }
                all_finite &= isFinite(r.s);
                sums_.groups[g] = r.s;
                if (!sums_.rest.empty()) sums_.rest[g] = restOf(r);
            }
            if (any_zero) zero_ = true;
            if (!all_finite) finite_ = false;
        });
    }

    [[nodiscard]] Tangents finished(std::size_t g) const {
        if (isEstimated(plan_.method)) return resultOf(g);
        if (sums_.rest.empty()) return {.s = unit(sums_.groups[g])};
        return meanOf(sums_.groups[g], sums_.rest[g], sums_.rest[g].weight, false);
    }

    [[nodiscard]] Tangents resultOf(std::size_t g) const {
        Tangents r{.s = sums_.groups[g], .positive = plan_.group_positive[g] != 0};
        if (!sums_.rest.empty()) {
            const GroupRest& rest = sums_.rest[g];
            r.t = vectorOf(rest.t);
            r.mag_s = rest.t[3];
            r.mag_t = rest.length_t;
        }
        return r;
    }

    void writeCorners() {
        parallel_.forRanges(plan_.triangle_count, kWriteGrain, [&](std::size_t begin, std::size_t end) {
            const auto slotOf = [&](std::size_t h) { return plan_.slotOf(static_cast<std::uint32_t>(h)); };
            const auto writeAll = [&](std::size_t corner, std::uint32_t group) {
                sink_.write(corner, resultOf(group));
            };
            // Local copies, which the compiler knows not to alias `tangents`.
            const Vec3* const results = sums_.groups.data();
            const std::uint8_t* const positive = plan_.group_positive.data();
            const float signs[2] = {sink_.sign(false), sink_.sign(true)};
            const StridedSpan<Vec4> tangents = out_.tangents;
            const auto writeTangent = [&](std::size_t corner, std::uint32_t group) {
                const Vec3& r = results[group];
                prefetchLines<true>(&tangents[corner], 1, kWriteAhead);
                tangents[corner] = {r.x, r.y, r.z, signs[positive[group]]};
            };
            if (!requestsOnlyTangents(out_))
                forResults(begin, end, slotOf, writeAll);
            else if (plan_.slots.empty() && plan_.triangles.empty())
                forResults(
                    begin, end, [](std::size_t h) { return h; }, writeTangent);
            else
                forResults(begin, end, slotOf, writeTangent);
        });
    }

    /// Calls write(corner, group) for the corners of these triangles that have a single result, from a group.
    template <class SlotOf, class Write>
    void forResults(std::size_t begin, std::size_t end, const SlotOf& slotOf, const Write& write) const {
        const std::uint32_t* const groups = plan_.groups.data();
        const std::uint32_t count = plan_.group_count;
        for (std::size_t h = 3 * begin; h < 3 * end; ++h) {
            const std::uint32_t group = groups[h] & kValue;
            const std::size_t corner = slotOf(h);
            if (group < count && (corner & kTopBit) == 0) write(corner, group);
        }
    }

    /// Scratch memory for one group that splits.
    struct SplitScratch {
        CornerTerms* blocks;
        std::uint32_t vertices[kTermCorners] = {};
    };

    /// Evaluates groups that split. Results of corners with several results are stored in members_; all other results
    /// are written. Quadratic in the size of a group, which the planner limits (kLargestSplitGroup).
    void evaluateSplits() {
        const std::size_t count = plan_.splits.size(), blocks = plan_.largest_split / kTermTriangles + 1;
        if (count == 0) return;
        if (!plan_.conflicts.empty()) members_ = Buffer<Tangents>(allocator_, plan_.members.size());
        const std::size_t tasks =
            std::min<std::size_t>(count / 64 + 1, parallel_.width() == 1 ? 1 : 4 * parallel_.width());
        Buffer<CornerTerms> terms(allocator_, plan_.hasTerms() ? 0 : tasks * blocks);
        parallel_.forTasks(tasks, [&](std::size_t task) {
            SplitScratch scratch{terms.empty() ? nullptr : terms.data() + task * blocks};
            for (std::size_t i = count * task / tasks; i < count * (task + 1) / tasks; ++i)
                evaluateSplit(plan_.splits[i], scratch);
        });
    }

    void evaluateSplit(const EvaluatedSplit& split, SplitScratch& scratch) {
        computeTerms(split, scratch);
        const std::size_t words = (std::size_t{split.count} + 63) / 64;
        const std::uint64_t* row = plan_.split_rows.data() + split.rows;
        Tangents result;
        for (std::uint32_t a = 0; a < split.count; ++a, row += words) {
            // A hard crease with thousands of corners has few different rows, each of which takes a long sum.
            if (a == 0 || !std::equal(row, row + words, row - words)) {
                Vec3 sum;
                GroupRest rest;
                for (std::size_t word = 0; word < words; ++word) {
                    for (std::uint64_t bits = row[word]; bits != 0; bits &= bits - 1)
                        add(split, 64 * word + static_cast<unsigned>(std::countr_zero(bits)), scratch, sum, rest);
                }
                result = meanOf(sum, rest, rest.weight, split.positive);
                if (!isFinite(result.s)) finite_ = false;
            }
            const std::uint32_t slot = plan_.slotOf(plan_.members[split.begin + a]);
            if ((slot & kTopBit) != 0) {
                members_[split.begin + a] = result;
            } else {
                sink_.write(slot, result);
            }
        }
    }

    void add(const EvaluatedSplit& split, std::size_t member, const SplitScratch& scratch, Vec3& sum,
             GroupRest& rest) const {
        const std::uint32_t half_edge = plan_.members[split.begin + member];
        const bool is_known = plan_.hasTerms();
        const CornerTerms& terms =
            is_known ? plan_.terms[half_edge / kTermCorners] : scratch.blocks[member / kTermTriangles];
        const std::size_t t = is_known ? half_edge / 3 % kTermTriangles : member % kTermTriangles, k = half_edge % 3;
        sum = sum + vectorOf(terms.s[3 * t + k]);
        rest.weight += terms.s[3 * t + k][3];
        if (!source_.tangents_only) addRest(rest, terms, t, k);
    }

    void computeTerms(const EvaluatedSplit& split, SplitScratch& scratch) const {
        for (std::uint32_t begin = 0; !plan_.hasTerms() && begin < split.count; begin += kTermTriangles) {
            const std::uint32_t count = std::min<std::uint32_t>(kTermTriangles, split.count - begin);
            for (std::uint32_t i = 0; i < count; ++i) {
                const std::uint32_t first = plan_.members[split.begin + begin + i] / 3 * 3;
                std::copy_n(plan_.vertices.data() + first, 3, scratch.vertices + 3 * i);
            }
            terms_(source_, scratch.vertices, count, scratch.blocks[begin / kTermTriangles]);
        }
    }

    /// Merges the results of corners that have several: two in the reference (at a quad's diagonal), and more in
    /// n-gons, which are merged one by one.
    void mergeConflicts() {
        const auto result = [&](const Conflict& c) {
            return (c.source & kTopBit) != 0 ? members_[c.source & kValue] : resultOf(c.source);
        };
        const Buffer<Conflict>& conflicts = plan_.conflicts;
        parallel_.forRanges(conflicts.size(), kWriteGrain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end;) {
                const std::uint32_t corner = conflicts[i].corner;
                const bool is_first = i == 0 || conflicts[i - 1].corner != corner;
                Tangents merged = result(conflicts[i]);
                for (++i; i < conflicts.size() && conflicts[i].corner == corner; ++i)
                    merge(merged, result(conflicts[i]));
                if (!isFinite(merged.s)) finite_ = false;
                // otherwise the thread that processes the corner's first conflict writes it
                if (is_first) sink_.write(corner, merged);
            }
        });
    }

    /// Returns the number of corners with a default: those without a group, those of groups whose sum vanished, and
    /// their copies.
    [[nodiscard]] std::uint64_t countDefaults() {
        const bool are_marked = zero_ || !out_.has_tangent.empty();
        if (are_marked) defaults_.distinguish(plan_.corner_count, allocator_);
        if (zero_) addReplaced();
        for (const std::uint32_t corner : plan_.default_corners) defaults_.add(corner);
        for (std::size_t i = 0; are_marked && i < plan_.copies.size(); ++i) {
            if (defaults_.has(plan_.copies[i].from)) defaults_.add(plan_.copies[i].to);
        }
        return defaults_.count();
    }

    void addReplaced() {
        const auto isReplaced = [&](std::uint32_t group) { return group < plan_.group_count && replaced_[group] != 0; };
        for (std::uint32_t h = 0; h < plan_.groups.size(); ++h) {
            const std::uint32_t slot = plan_.slotOf(h);
            if (isReplaced(plan_.groups[h] & kValue) && (slot & kTopBit) == 0) defaults_.add(slot);
        }
        // A corner with several results counts as a default only if all of them are defaults.
        const Buffer<Conflict>& conflicts = plan_.conflicts;
        for (std::size_t i = 0; i < conflicts.size();) {
            const std::uint32_t corner = conflicts[i].corner;
            bool are_replaced = true;
            for (; i < conflicts.size() && conflicts[i].corner == corner; ++i)
                are_replaced &= isReplaced(conflicts[i].source);
            if (are_replaced) defaults_.add(corner);
        }
    }

    [[nodiscard]] std::uint64_t countNotFinite() {
        std::atomic<std::uint64_t> total{0};
        parallel_.forRanges(plan_.corner_count, kWriteGrain, [&](std::size_t begin, std::size_t end) {
            std::uint64_t count = 0;
            for (std::size_t c = begin; c < end; ++c) count += !sink_.isFinite(c);
            total += count;
        });
        return total.load();
    }

    const EvaluationPlan& plan_;
    const Pose& pose_;
    const StridedSpan<const Vec2>& uvs_;
    const Execution& execution_;
    TangentOutput out_;
    Sink sink_;
    DefaultCorners defaults_;
    CornerTermsFunction terms_;
    CornerSource source_;
    const Allocator* allocator_;
    Parallel& parallel_;
    GroupSums sums_;
    // results of the members of groups that split; empty if no corner has several results
    Buffer<Tangents> members_;
    Buffer<std::uint8_t> replaced_;  // 1 for each group whose sum vanished and was replaced by a default
    std::atomic<bool> zero_{false}, finite_{true};
};

}  // namespace

GroupSums allocateSums(const EvaluationPlan& plan, bool tangents_only, const Allocator* allocator) {
    GroupSums sums;
    sums.groups = Buffer<Vec3>(allocator, plan.group_count);
    if (!tangents_only) sums.rest = Buffer<GroupRest>(allocator, plan.group_count);
    return sums;
}

estimators::GroupEstimates estimatesIn(GroupSums& sums) {
    return {reinterpret_cast<std::byte*>(sums.groups.data()), sizeof(Vec3), sums.rest.data(), sums.groups.size()};
}

TangentReport evaluateGroups(const EvaluationPlan& plan, const Pose& pose, const StridedSpan<const Vec2>& uvs,
                             const TangentOutput& out, const Execution& execution, Parallel& parallel,
                             GroupSums* estimates) {
    return Evaluation(plan, pose, uvs, out, execution, parallel).run(estimates);
}

}  // namespace tspace::mikk
