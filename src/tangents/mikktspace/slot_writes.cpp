// SPDX-License-Identifier: MIT
// The last planning step: who writes which corner of the mesh. A corner at a quad's diagonal belongs to two
// triangles; where they are in different groups or subsets there, their results are averaged. Corners that no
// group reaches hold the default, corners of degenerate triangles copy.
#include "tangents/mikktspace/slot_writes.h"

#include <algorithm>

namespace tspace::mikk {

namespace {

/// What tells results apart: the group's start in the list, or the leader's place there in a group that
/// splits.
class ResultIds {
  public:
    explicit ResultIds(const GroupedPlan& plan) : plan_(plan), split_(plan.split_groups.begin()) {}

    /// For positions in ascending order. kNone for a tricorner without a group.
    std::uint32_t next(std::uint32_t position) {
        if ((plan_.list[position] & kMark) != 0) startGroup(position);
        if (!has_members_) return kNone;
        if (split_ == plan_.split_groups.end() || split_->begin != begin_) return begin_;
        return begin_ + plan_.split_leaders[split_->leaders + position - begin_];
    }

  private:
    void startGroup(std::uint32_t position) {
        if (split_ != plan_.split_groups.end() && split_->begin < position) ++split_;
        begin_ = position;
        has_members_ = false;
        for (std::uint32_t e = position; e < plan_.list.size(); ++e) {
            if (e != position && (plan_.list[e] & kMark) != 0) break;
            if ((plan_.flags[(plan_.list[e] & kValue) / 3] & kAny) == 0) {
                has_members_ = true;
                break;
            }
        }
    }

    const GroupedPlan& plan_;
    const SplitGroup* split_;
    std::uint32_t begin_ = 0;
    bool has_members_ = false;
};

/// What is known of a corner: kNone at first, then the id of its result or one of these.
constexpr std::uint32_t kConflict = kNone - 1;
constexpr std::uint32_t kDefault = kNone - 2;

void collectConflicts(GroupedPlan& plan, const Buffer<std::uint32_t>& result_of, const Allocator* allocator) {
    Growing<std::uint32_t> conflicts(allocator);
    ResultIds ids(plan);
    for (std::uint32_t e = 0; e < plan.list.size(); ++e) {
        const std::uint32_t tricorner = plan.list[e] & kValue;
        const bool grouped = ids.next(e) != kNone;
        if (!grouped || result_of[plan.slots[tricorner] & kValue] != kConflict) continue;
        plan.slots[tricorner] |= kMark;
        conflicts.push(e);
    }
    plan.conflicts = conflicts.exact();
    plan.conflict_order = Buffer<std::uint32_t>(allocator, plan.conflicts.size());
    for (std::size_t i = 0; i < plan.conflicts.size(); ++i) plan.conflict_order[i] = static_cast<std::uint32_t>(i);
    // Positions ascend in the order in which the reference writes a node's groups.
    std::sort(plan.conflict_order.begin(), plan.conflict_order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const std::uint32_t slot_a = plan.slot(plan.list[plan.conflicts[a]] & kValue);
        const std::uint32_t slot_b = plan.slot(plan.list[plan.conflicts[b]] & kValue);
        return slot_a != slot_b ? slot_a < slot_b : a < b;
    });
}

}  // namespace

void planSlotWrites(GroupedPlan& plan, TrianglePass& pass, const Allocator* allocator) {
    const bool all_written =
        plan.slots.empty() && plan.report.degenerate_triangle_count == 0 && plan.report.degenerate_uv_count == 0;
    if (all_written) return;  // every corner has one triangle, and that is in a group
    Buffer<std::uint32_t> result_of(allocator, plan.corner_count, kNone);
    bool has_conflict = false;
    ResultIds ids(plan);
    for (std::uint32_t e = 0; e < plan.list.size(); ++e) {
        const std::uint32_t id = ids.next(e);
        if (id == kNone) continue;
        std::uint32_t& result = result_of[plan.slot(plan.list[e] & kValue)];
        if (result != kNone && result != id) {
            result = kConflict;
            has_conflict = true;
        } else {
            result = id;
        }
    }
    if (has_conflict) collectConflicts(plan, result_of, allocator);

    Growing<std::uint32_t> defaults(allocator);
    defaults.reserve(pass.copies.size());
    for (std::size_t i = 0; i < 3 * plan.triangle_count; ++i) {
        const std::uint32_t slot = plan.slot(static_cast<std::uint32_t>(i));
        if (result_of[slot] != kNone || plan.nodes[i] >= plan.listed_count) continue;
        result_of[slot] = kDefault;
        defaults.push(slot);
    }
    std::size_t kept = 0;
    for (const Copy& copy : pass.copies) {
        if (copy.from == kNone || result_of[copy.from] == kDefault) {
            defaults.push(copy.to);
        } else {
            pass.copies[kept++] = copy;
        }
    }
    pass.copies.drop(pass.copies.size() - kept);
    plan.copies = pass.copies.exact();
    plan.default_corners = defaults.exact();
    plan.report.default_corner_count = plan.default_corners.size();
}

}  // namespace tspace::mikk
