// SPDX-License-Identifier: MIT
// The sums of a plan's groups. As in node_sums.cpp a task owns a range of groups, and computes the triangles
// that have a corner in one of them.
#include "tangents/mikktspace/group_sums.h"

#include <algorithm>

#include "core/add_row.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kGroupsPerTask = 4096;  // at least: below, another thread costs more than it saves

class GroupSummer {
  public:
    GroupSummer(const EvaluationPlan& plan, const CornerSource& source, CornerTermsFunction terms, GroupSums& sums,
                std::size_t first_group, std::size_t end_group)
        : plan_(plan),
          source_(source),
          terms_of_(terms),
          sums_(sums),
          first_group_(static_cast<std::uint32_t>(first_group)),
          group_count_(static_cast<std::uint32_t>(end_group - first_group)),
          owns_all_(end_group - first_group == sums.groups.size()) {}

    void run() {
        std::fill_n(sums_.groups.data() + first_group_, group_count_, GroupSum{});
        if (!sums_.rest.empty()) std::fill_n(sums_.rest.data() + first_group_, group_count_, GroupRest{});
        if (owns_all_) {
            for (std::size_t t = 0; t < plan_.triangle_count; t += kTermTriangles) {
                const std::size_t count = std::min(kTermTriangles, plan_.triangle_count - t);
                add(plan_.vertices.data() + 3 * t, plan_.groups.data() + 3 * t, count);
            }
            return;
        }
        for (std::size_t t = 0; t < plan_.triangle_count;) {
            std::size_t count = 0;
            for (; t < plan_.triangle_count && count < kTermTriangles; ++t) count += keep(t, count);
            add(vertices_, groups_, count);
        }
    }

  private:
    /// False for kNone and for groups with kMark, too: those are not below any count.
    [[nodiscard]] bool owns(std::uint32_t group) const { return group - first_group_ < group_count_; }

    /// Copies a triangle to a place of the block; returns 1 when it is to stay there.
    std::size_t keep(std::size_t t, std::size_t place) {
        const std::uint32_t *v = plan_.vertices.data() + 3 * t, *g = plan_.groups.data() + 3 * t;
        for (std::size_t k = 0; k < 3; ++k) {
            vertices_[3 * place + k] = v[k];
            groups_[3 * place + k] = g[k];
        }
        return (int{owns(g[0])} | int{owns(g[1])} | int{owns(g[2])}) != 0 ? 1 : 0;
    }

    void add(const std::uint32_t* vertices, const std::uint32_t* groups, std::size_t count) {
        terms_of_(source_, vertices, count, terms_);
        if (sums_.rest.empty()) {
            for (std::size_t i = 0; i < 3 * count; ++i) {
                if (owns(groups[i])) addVector(sums_.groups[groups[i]].s, terms_.s[i]);
            }
            return;
        }
        for (std::size_t i = 0; i < 3 * count; ++i) {
            if (!owns(groups[i])) continue;
            addVector(sums_.groups[groups[i]].s, terms_.s[i]);
            GroupRest& rest = sums_.rest[groups[i]];
            addRow(rest.t, terms_.t[i]);
            rest.length_t += terms_.lengths_t[i % 3][i / 3];
            rest.weight += terms_.s[i][3];
        }
    }

    const EvaluationPlan& plan_;
    const CornerSource& source_;
    CornerTermsFunction terms_of_;
    GroupSums& sums_;
    std::uint32_t first_group_, group_count_;
    bool owns_all_;
    std::uint32_t vertices_[kTermCorners] = {};
    std::uint32_t groups_[kTermCorners] = {};
    CornerTerms terms_;
};

}  // namespace

GroupSums sumGroups(const EvaluationPlan& plan, const CornerSource& source, CornerTermsFunction terms,
                    const Allocator* allocator, Parallel& parallel) {
    GroupSums sums;
    sums.groups = Buffer<GroupSum>(allocator, plan.group_count);
    if (!source.tangents_only) sums.rest = Buffer<GroupRest>(allocator, plan.group_count);
    if (plan.group_count == 0) return sums;
    const std::size_t groups = plan.group_count;
    const std::size_t tasks =
        std::clamp<std::size_t>(groups / kGroupsPerTask, 1, std::max<std::size_t>(1, parallel.width()));
    parallel.forTasks(tasks, [&](std::size_t task) {
        GroupSummer(plan, source, terms, sums, groups * task / tasks, groups * (task + 1) / tasks).run();
    });
    return sums;
}

GroupSums estimatedSums(const EvaluationPlan& plan, bool tangents_only, const Allocator* allocator) {
    GroupSums sums;
    sums.groups = Buffer<GroupSum>(allocator, plan.group_count);
    if (!tangents_only) sums.rest = Buffer<GroupRest>(allocator, plan.group_count);
    return sums;
}

estimators::GroupEstimates estimatesIn(GroupSums& sums) {
    return {reinterpret_cast<std::byte*>(sums.groups.data()),
            sizeof(GroupSum),
            reinterpret_cast<std::byte*>(sums.rest.data()),
            sizeof(GroupRest),
            sums.rest.empty() ? nullptr : reinterpret_cast<std::byte*>(&sums.rest[0].length_t),
            sizeof(GroupRest),
            sums.groups.size()};
}

}  // namespace tspace::mikk
