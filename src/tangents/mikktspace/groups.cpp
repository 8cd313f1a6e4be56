// SPDX-License-Identifier: MIT
// Step 7: groups. The links around a node form paths and rings. Going through a node's tricorners in
// ascending order, each that has no group and a usable UV area opens one, which spreads along the links to
// both sides until it meets the other orientation or another group. (The reference recurses from triangle to
// triangle; on a path or ring that visits the same members.)
//
// Triangles without UV area take the orientation of the first group that reaches them at any of their three
// nodes, so there nodes are not independent: nodes with such triangles are done one after the other, in the
// reference's order.
#include "tangents/mikktspace/groups.h"

#include <algorithm>
#include <atomic>

#include "tangents/mikktspace/pairing.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kGrain = 2048;   // nodes
constexpr std::size_t kLookAhead = 4;  // nodes; far enough for their triangles to arrive from memory

/// Spreads a group from `seed` along one side. `joins(member)` says whether the group may take a member.
template <class Joins>
void spread(std::uint32_t seed, const std::uint32_t* link, std::uint32_t* group, const Joins& joins) {
    for (std::uint32_t m = link[seed]; m != kNone && group[m] == kNone && joins(m); m = link[m]) group[m] = group[seed];
}

/// Puts a node's tricorners into the order group by group and marks where groups start. `start` has room for
/// group_count + 1 numbers, `copy` for one per member.
void sortByGroup(std::uint32_t* list, std::uint32_t count, const std::uint32_t* group, std::uint32_t group_count,
                 std::uint32_t* start, std::uint32_t* copy) {
    std::fill_n(start, group_count + 1, 0u);
    const auto rank = [&](std::uint32_t i) { return group[i] == kNone ? group_count : group[i]; };
    for (std::uint32_t i = 0; i < count; ++i) ++start[rank(i)];
    std::uint32_t sum = 0;
    for (std::uint32_t g = 0; g <= group_count; ++g) {
        const std::uint32_t members = start[g];
        start[g] = sum;
        sum += members;
    }
    std::copy_n(list, count, copy);
    for (std::uint32_t i = 0; i < count; ++i) list[start[rank(i)]++] = copy[i];
    // Now start[g] is where group g ends, and so where the next one begins.
    list[0] |= kMark;
    for (std::uint32_t g = 0; g < group_count; ++g) {
        if (start[g] < count) list[start[g]] |= kMark;
    }
}

class Grouper {
  public:
    Grouper(GroupedPlan& plan, const TailPairs& tail, const Allocator* allocator)
        : plan_(plan), tail_(tail), allocator_(allocator) {}

    void run(Parallel& parallel) {
        findAnyNodes();
        parallel.forRanges(plan_.listed_count, kGrain, [&](std::size_t begin, std::size_t end) {
            std::uint64_t groups = 0;
            for (std::size_t node = begin; node < end; ++node) {
                if (node + kLookAhead < end) fetch(node + kLookAhead);
                if (size(node) != 0 && size(node) <= kSmallNode && !touchesAny(node)) groups += groupSmall(node);
            }
            group_count_ += groups;
        });
        groupLarge();
        if (!any_node_.empty()) groupAny();
        plan_.report.group_count = group_count_.load();
    }

  private:
    [[nodiscard]] std::uint32_t size(std::size_t node) const {
        return plan_.node_begin[node + 1] - plan_.node_begin[node];
    }
    std::uint32_t* list(std::size_t node) { return plan_.list.data() + plan_.node_begin[node]; }
    [[nodiscard]] std::uint8_t flags(std::uint32_t tricorner) const { return plan_.flags[(tricorner & kValue) / 3]; }
    [[nodiscard]] bool touchesAny(std::size_t node) const { return !any_node_.empty() && any_node_[node] != 0; }

    void fetch(std::size_t node) const {
        const std::uint32_t begin = plan_.node_begin[node],
                            end = std::min(plan_.node_begin[node + 1], begin + kSmallNode);
        for (std::uint32_t e = begin; e < end; ++e) {
            __builtin_prefetch(&plan_.nodes[plan_.list[e] & kValue]);
            __builtin_prefetch(&plan_.flags[(plan_.list[e] & kValue) / 3]);
        }
    }

    void findAnyNodes() {
        for (std::size_t t = 0; t < plan_.triangle_count; ++t) {
            if ((plan_.flags[t] & kAny) == 0) continue;
            if (any_node_.empty()) any_node_ = Buffer<std::uint8_t>(allocator_, plan_.listed_count, std::uint8_t{0});
            for (std::size_t k = 0; k < 3; ++k) {
                if (const std::uint32_t node = plan_.nodes[3 * t + k]; node < plan_.listed_count) any_node_[node] = 1;
            }
        }
    }

    /// Groups of a node without kAny triangles, whose links are known. Returns how many there are.
    std::uint32_t spreadAll(const Around& around, std::uint32_t* group) const {
        std::fill_n(group, around.count, kNone);
        std::uint32_t groups = 0;
        for (std::uint32_t i = 0; i < around.count; ++i) {
            if (group[i] != kNone) continue;
            const std::uint8_t orientation = flags(around.list[i]) & kPositive;
            const auto joins = [&](std::uint32_t m) { return (flags(around.list[m]) & kPositive) == orientation; };
            group[i] = groups++;
            spread(i, around.left, group, joins);
            spread(i, around.right, group, joins);
        }
        return groups;
    }

    std::uint32_t groupSmall(std::size_t node) {
        std::uint32_t next[kSmallNode], previous[kSmallNode], left[kSmallNode], right[kSmallNode], group[kSmallNode];
        Around around{size(node), list(node), next, previous, left, right};
        readNeighbours(plan_, around);
        pairSmall(around);
        tail_.apply(static_cast<std::uint32_t>(node), around);
        const std::uint32_t groups = spreadAll(around, group);
        if (groups == 1) {
            list(node)[0] |= kMark;
        } else {
            std::uint32_t start[kSmallNode + 1];
            sortByGroup(list(node), around.count, group, groups, start, next);
        }
        return groups;
    }

    /// Nodes of many triangles: few at most, one after the other, with memory for the largest.
    void groupLarge() {
        std::uint32_t most = 0;
        for (std::size_t node = 0; node < plan_.listed_count; ++node) most = std::max(most, size(node));
        if (most <= kSmallNode) return;
        makeScratch(most);
        Buffer<std::uint32_t> links(allocator_, 3 * std::size_t{most});
        for (std::size_t node = 0; node < plan_.listed_count; ++node) {
            if (size(node) <= kSmallNode || touchesAny(node)) continue;
            Around around = link(node, links.data(), links.data() + most);
            std::uint32_t* group = links.data() + 2 * std::size_t{most};
            const std::uint32_t groups = spreadAll(around, group);
            sortByGroup(list(node), around.count, group, groups, scratch_.data(), scratch_.data() + most + 1);
            group_count_ += groups;
        }
    }

    void makeScratch(std::uint32_t most) {
        if (scratch_.size() >= 2 * std::size_t{most} + 1) return;
        scratch_ = Buffer<std::uint32_t>(allocator_, 2 * std::size_t{most} + 1);
        table_ = PairingTable(allocator_, most);
    }

    /// Links of a node of any size; the arrays that hold them are the caller's.
    Around link(std::size_t node, std::uint32_t* left, std::uint32_t* right) {
        const std::uint32_t count = size(node);
        Around around{count, list(node), scratch_.data(), scratch_.data() + count, left, right};
        readNeighbours(plan_, around);
        if (count <= kSmallNode) {
            pairSmall(around);
        } else {
            table_.pair(around);
        }
        tail_.apply(static_cast<std::uint32_t>(node), around);
        return around;
    }

    /// All nodes that touch kAny triangles: linked first, then walked over in the reference's order, which is
    /// that of tricorners. A cursor per node follows its list along.
    void groupAny() {
        std::size_t nodes = 0, members = 0;
        std::uint32_t most = 0;
        Buffer<std::uint32_t> place(allocator_, plan_.listed_count);
        for (std::size_t node = 0; node < plan_.listed_count; ++node) {
            if (any_node_[node] == 0) continue;
            place[node] = static_cast<std::uint32_t>(nodes++);
            members += size(node);
            most = std::max(most, size(node));
        }
        makeScratch(most);
        struct State {
            std::size_t begin;
            std::uint32_t groups, cursor;
        };
        Buffer<State> states(allocator_, nodes);
        Buffer<std::uint32_t> links(allocator_, 3 * members);
        std::uint32_t *left = links.data(), *right = left + members, *group = right + members;
        std::fill_n(group, members, kNone);
        std::size_t begin = 0;
        for (std::size_t node = 0; node < plan_.listed_count; ++node) {
            if (any_node_[node] == 0) continue;
            states[place[node]] = {begin, 0, 0};
            link(node, left + begin, right + begin);
            begin += size(node);
        }
        for (std::size_t h = 0; h < 3 * plan_.triangle_count; ++h) {
            const std::uint32_t node = plan_.nodes[h];
            if (node >= plan_.listed_count || any_node_[node] == 0) continue;
            State& state = states[place[node]];
            const std::uint32_t seed = state.cursor++;
            std::uint32_t* groups = group + state.begin;
            if ((plan_.flags[h / 3] & kAny) != 0 || groups[seed] != kNone) continue;
            groups[seed] = state.groups++;
            const std::uint8_t orientation = plan_.flags[h / 3] & kPositive;
            const std::uint32_t* members_here = list(node);
            const auto joins = [&](std::uint32_t m) { return joinsAny(members_here[m] / 3, orientation); };
            spread(seed, left + state.begin, groups, joins);
            spread(seed, right + state.begin, groups, joins);
        }
        for (std::size_t node = 0; node < plan_.listed_count; ++node) {
            if (any_node_[node] == 0) continue;
            const State& state = states[place[node]];
            sortByGroup(list(node), size(node), group + state.begin, state.groups, scratch_.data(),
                        scratch_.data() + most + 1);
            group_count_ += state.groups;
        }
    }

    /// A kAny triangle takes the orientation of the first group that asks, at whichever of its nodes.
    bool joinsAny(std::uint32_t triangle, std::uint8_t orientation) {
        std::uint8_t& f = plan_.flags[triangle];
        if ((f & kAny) != 0 && (f & kGrouped) == 0) f = static_cast<std::uint8_t>((f & ~kPositive) | orientation);
        if ((f & kPositive) != orientation) return false;
        f |= kGrouped;
        return true;
    }

    GroupedPlan& plan_;
    const TailPairs& tail_;
    const Allocator* allocator_;
    Buffer<std::uint8_t> any_node_;  // empty when there are no kAny triangles
    Buffer<std::uint32_t> scratch_;
    PairingTable table_;
    std::atomic<std::uint64_t> group_count_{0};
};

}  // namespace

void formGroups(GroupedPlan& plan, const TailPairs& tail, const Allocator* allocator, Parallel& parallel) {
    Grouper(plan, tail, allocator).run(parallel);
}

}  // namespace tspace::mikk
