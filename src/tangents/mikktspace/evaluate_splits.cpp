// SPDX-License-Identifier: MIT
#include "tangents/mikktspace/evaluate_splits.h"

#include <algorithm>

namespace tspace::mikk {

namespace {

struct Term {
    Vec3 s, t;
    float mag_s, mag_t, weight;
};

struct Sums {
    Vec3 s, t;
    float mag_s = 0, mag_t = 0, weight = 0;

    void add(const Term& term) {
        s = s + term.s;
        t = t + term.t;
        mag_s = mag_s + term.mag_s;
        mag_t = mag_t + term.mag_t;
        weight = weight + term.weight;
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

/// One task's worth of groups.
class SplitEvaluator {
  public:
    SplitEvaluator(const EvaluationPlan& plan, const CornerSource& source, CornerTermsFunction kernel, const Sink& sink,
                   Term* terms, Tangents* results, Tangents* all_results)
        : plan_(plan),
          source_(source),
          kernel_(kernel),
          sink_(sink),
          terms_(terms),
          results_(results),
          all_results_(all_results) {}

    void run(const EvaluatedSplit& split) {
        computeTerms(split);
        const std::size_t words = (std::size_t{split.count} + 63) / 64;
        for (std::uint32_t a = 0; a < split.count; ++a) {
            const std::uint32_t leader = plan_.split_leaders[split.leaders + a];
            if (leader == a) {
                const std::uint64_t* row = plan_.split_rows.data() + split.rows + a * words;
                Sums sums;
                for (std::uint32_t b = 0; b < split.count; ++b) {
                    if ((row[b / 64] >> (b % 64) & 1) != 0) sums.add(terms_[b]);
                }
                results_[a] = sums.mean(split.positive);
            }
            const std::uint32_t slot = plan_.slotOf(plan_.members[split.begin + a]);
            if ((slot & kMark) != 0) {
                all_results_[split.begin + a] = results_[leader];
            } else {
                sink_.write(slot, results_[leader]);
            }
        }
    }

  private:
    void computeTerms(const EvaluatedSplit& split) {
        for (std::uint32_t begin = 0; begin < split.count; begin += kTermTriangles) {
            const std::uint32_t count = std::min<std::uint32_t>(kTermTriangles, split.count - begin);
            for (std::uint32_t i = 0; i < count; ++i) {
                const std::uint32_t first = plan_.members[split.begin + begin + i] / 3 * 3;
                std::copy_n(plan_.vertices.data() + first, 3, vertices_ + 3 * i);
            }
            kernel_(source_, vertices_, count, block_);
            for (std::uint32_t i = 0; i < count; ++i) {
                const std::size_t k = plan_.members[split.begin + begin + i] % 3;
                const float *s = block_.s[3 * i + k], *t = block_.t[3 * i + k];
                terms_[begin + i] = {{s[0], s[1], s[2]}, {t[0], t[1], t[2]}, t[3], block_.lengths_t[k][i], s[3]};
            }
        }
    }

    const EvaluationPlan& plan_;
    const CornerSource& source_;
    CornerTermsFunction kernel_;
    const Sink& sink_;
    Term* terms_;
    Tangents* results_;
    Tangents* all_results_;
    std::uint32_t vertices_[kTermCorners] = {};
    CornerTerms block_ = {};
};

}  // namespace

Buffer<Tangents> evaluateSplits(const EvaluationPlan& plan, const CornerSource& source, CornerTermsFunction terms,
                                const Sink& sink, const Allocator* allocator, Parallel& parallel) {
    Buffer<Tangents> all(allocator, plan.conflicts.empty() ? 0 : plan.members.size());
    const std::size_t count = plan.splits.size(), most = plan.largest_split;
    if (count == 0) return all;
    const std::size_t tasks = std::min<std::size_t>(count / 64 + 1, parallel.width() == 1 ? 1 : 4 * parallel.width());
    Buffer<Term> scratch(allocator, tasks * most);
    Buffer<Tangents> results(allocator, tasks * most);
    parallel.forTasks(tasks, [&](std::size_t task) {
        SplitEvaluator evaluator(plan, source, terms, sink, scratch.data() + task * most, results.data() + task * most,
                                 all.data());
        for (std::size_t i = count * task / tasks; i < count * (task + 1) / tasks; ++i) evaluator.run(plan.splits[i]);
    });
    return all;
}

}  // namespace tspace::mikk
