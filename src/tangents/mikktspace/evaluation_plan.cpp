// SPDX-License-Identifier: MIT
// From lists of groups, which planning needs, to one number per tricorner, which evaluation needs.
#include "tangents/mikktspace/evaluation_plan.h"

#include <algorithm>
#include <cstring>

#include "tangents/mikktspace/corner_terms.h"
#include "tangents/mikktspace/growing.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kGrain = 16384;

class Numberer {
  public:
    Numberer(GroupedPlan& from, EvaluationPlan& to, const Allocator* allocator)
        : from_(from), to_(to), allocator_(allocator), positive_(allocator), members_(allocator) {}

    void run() {
        to_.groups = Buffer<std::uint32_t>(allocator_, 3 * from_.triangle_count, kNone);
        to_.splits = Buffer<EvaluatedSplit>(allocator_, from_.split_groups.size());
        if (!from_.conflicts.empty()) source_of_ = Buffer<std::uint32_t>(allocator_, from_.list.size(), kNone);
        for (std::uint32_t begin = 0; begin < from_.list.size();) {
            std::uint32_t end = begin + 1;
            while (end < from_.list.size() && (from_.list[end] & kMark) == 0) ++end;
            number(begin, end);
            begin = end;
        }
        to_.group_count = static_cast<std::uint32_t>(positive_.size());
        to_.group_positive = positive_.exact();
        to_.members = members_.exact();
        describeMembers();
        orderConflicts();
        if (!from_.slots.empty() || to_.groups.size() != to_.corner_count) nameCorners();
    }

  private:
    [[nodiscard]] bool isAny(std::uint32_t tricorner) const { return (from_.flags[tricorner / 3] & kAny) != 0; }

    /// The group at [begin, end) of the list. Without a usable triangle it is a node's ungrouped rest.
    void number(std::uint32_t begin, std::uint32_t end) {
        std::uint32_t first = kNone;
        for (std::uint32_t e = begin; e < end && first == kNone; ++e) {
            if (!isAny(from_.list[e] & kValue)) first = from_.list[e] & kValue;
        }
        if (first == kNone) return;
        const bool positive = (from_.flags[first / 3] & kPositive) != 0;
        if (split_ < from_.split_groups.size() && from_.split_groups[split_].begin == begin) {
            const SplitGroup& split = from_.split_groups[split_];
            to_.splits[split_++] = {static_cast<std::uint32_t>(members_.size()), split.count, split.rows, split.leaders,
                                    positive};
            for (std::uint32_t e = begin; e < end; ++e) {
                if (!source_of_.empty()) source_of_[e] = kMark | static_cast<std::uint32_t>(members_.size());
                members_.push(from_.list[e] & kValue);
            }
            return;
        }
        const auto group = static_cast<std::uint32_t>(positive_.size());
        positive_.push(positive ? 1 : 0);
        for (std::uint32_t e = begin; e < end; ++e) {
            const std::uint32_t tricorner = from_.list[e] & kValue;
            to_.groups[tricorner] = group | (isAny(tricorner) ? kMark : 0);
            if (!source_of_.empty()) source_of_[e] = group;
        }
    }

    void describeMembers() {
        to_.member_slots = Buffer<std::uint32_t>(allocator_, members_.size());
        for (std::size_t i = 0; i < members_.size(); ++i) {
            to_.member_slots[i] = from_.slots.empty() ? members_[i] : from_.slots[members_[i]];
        }
        to_.split_rows = std::move(from_.split_rows);
        to_.split_leaders = std::move(from_.split_leaders);
        to_.largest_split = from_.largest_split_group;
    }

    void orderConflicts() {
        to_.conflicts = Buffer<Conflict>(allocator_, from_.conflicts.size());
        for (std::size_t i = 0; i < to_.conflicts.size(); ++i) {
            const std::uint32_t position = from_.conflicts[from_.conflict_order[i]];
            to_.conflicts[i] = {from_.slot(from_.list[position] & kValue), source_of_[position]};
        }
    }

    void nameCorners() {
        to_.corner_groups = Buffer<std::uint32_t>(allocator_, to_.corner_count, kNone);
        Buffer<std::uint8_t> seen(allocator_, to_.corner_count, std::uint8_t{0});
        for (std::size_t h = 0; h < to_.groups.size(); ++h) {
            const std::uint32_t slot = from_.slot(static_cast<std::uint32_t>(h));
            to_.has_repeats |= seen[slot] != 0;
            seen[slot] = 1;
            if (to_.groups[h] != kNone && (from_.slots[h] & kMark) == 0)
                to_.corner_groups[slot] = to_.groups[h] & kValue;
        }
        if (to_.has_repeats) {
            for (std::uint32_t& slot : from_.slots) slot &= kValue;
            to_.repeat_slots = std::move(from_.slots);
        }
    }

    GroupedPlan& from_;
    EvaluationPlan& to_;
    const Allocator* allocator_;
    Growing<std::uint8_t> positive_;
    Growing<std::uint32_t> members_;
    Buffer<std::uint32_t> source_of_;  // one per place in the list; only with conflicts
    std::size_t split_ = 0;
};

template <class T>
bool sameBits(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

/// Equal vertices may differ in the sign of a zero; then only those of the node give the reference's bits.
bool sameData(const MeshView& mesh, std::uint32_t a, std::uint32_t b) {
    return sameBits(mesh.positions[a], mesh.positions[b]) && sameBits(mesh.normals[a], mesh.normals[b]) &&
           sameBits(mesh.uvs[a], mesh.uvs[b]);
}

void useOwnVertices(const GroupedPlan& plan, const MeshView& mesh, Buffer<std::uint32_t>& vertices,
                    Parallel& parallel) {
    parallel.forRanges(3 * plan.triangle_count, kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t h = begin; h < end; ++h) {
            const std::uint32_t own = mesh.indices[plan.slot(static_cast<std::uint32_t>(h))];
            if (own != vertices[h] && sameData(mesh, own, vertices[h])) vertices[h] = own;
        }
    });
}

}  // namespace

EvaluationPlan makeEvaluationPlan(GroupedPlan plan, const MeshView& mesh, PlanUse use, const Allocator* allocator,
                                  Parallel& parallel) {
    EvaluationPlan result;
    result.method = plan.method;
    result.sign_factor = plan.sign_factor;
    result.bitangent_factor = plan.bitangent_factor;
    result.vertex_count = plan.vertex_count;
    result.corner_count = plan.corner_count;
    result.triangle_count = plan.triangle_count;
    result.report = plan.report;
    result.vertices = Buffer<std::uint32_t>(allocator, 3 * plan.triangle_count + kTermCorners, 0u);
    parallel.forRanges(3 * plan.triangle_count, kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t h = begin; h < end; ++h) result.vertices[h] = plan.node_vertex[plan.nodes[h]];
    });
    if (use == PlanUse::kept) useOwnVertices(plan, mesh, result.vertices, parallel);
    result.uvs = Buffer<Vec2>(allocator, mesh.vertexCount());
    parallel.forRanges(mesh.vertexCount(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) result.uvs[v] = mesh.uvs[v];
    });
    Numberer(plan, result, allocator).run();
    result.default_corners = std::move(plan.default_corners);
    result.skipped_corners = std::move(plan.skipped_corners);
    result.copies = std::move(plan.copies);
    return result;
}

std::size_t EvaluationPlan::memoryBytes() const {
    const auto bytes = [](const auto& buffer) { return buffer.size() * sizeof(*buffer.data()); };
    return sizeof(*this) + bytes(vertices) + bytes(groups) + bytes(corner_groups) + bytes(group_positive) + bytes(uvs) +
           bytes(splits) + bytes(members) + bytes(member_slots) + bytes(split_rows) + bytes(split_leaders) +
           bytes(conflicts) + bytes(repeat_slots) + bytes(default_corners) + bytes(skipped_corners) + bytes(copies);
}

}  // namespace tspace::mikk
