// SPDX-License-Identifier: MIT
// The nodes that one pass leaves unclear. The triangles around them are computed once more, their corners put
// node by node, and then each node is worked on alone (node_groups.cpp). Nodes where something rare happens
// are left to the general steps: groups that split, results that are not finite, copies between nodes, more
// than kSmallNode corners.
//
// A triangle without UV area takes the orientation of the first group that reaches it, at any of its nodes.
// Where its nodes have one orientation only, that is the one, whoever is first. Others are contested: the
// nodes of those are grouped one after the other, in the reference's order.
#include "tangents/mikktspace/node_walk.h"

#include <algorithm>
#include <atomic>

#include "tangents/mikktspace/node_groups.h"
#include "tangents/mikktspace/unclear_corners.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kNodeGrain = 512;
constexpr std::uint8_t kNearContested = 0x20;  // one more flag: a triangle at a node of contested ones

class NodeWalk {
  public:
    NodeWalk(const MeshView& mesh, const TangentOptions& options, const TriangleList& triangles, const Nodes& nodes,
             std::span<const std::uint32_t> chosen, const TangentOutput& out, Parallel& parallel)
        : mesh_(mesh),
          triangles_(triangles),
          nodes_(nodes),
          chosen_(chosen),
          parallel_(parallel),
          allocator_(options.execution.allocator),
          corners_(allocator_),
          groups_(mesh, options, triangles, nodes, chosen, out, corners_) {}

    WalkedNodes run(CornerSource source, CornerTermsFunction terms, NodeSums* sums, MarkedBlocks blocks) {
        source.tangents_only = !groups_.isFull() && !groups_.maySplit();
        corners_ =
            readCorners({mesh_, triangles_, nodes_, chosen_, source, terms, sums, blocks, allocator_, parallel_});
        state_ = Buffer<std::uint8_t>(allocator_, chosen_.size(), std::uint8_t{kDone});
        if (findContested()) groupContested();
        std::atomic<std::uint64_t> groups{0}, defaults{0};
        parallel_.forRanges(chosen_.size(), kNodeGrain, [&](std::size_t begin, std::size_t end) {
            WalkCounts counts;
            for (std::size_t place = begin; place < end; ++place) {
                if (!contested_.empty() && contested_[place] != 0) continue;
                state_[place] = groups_.walk(place, counts);
            }
            groups += counts.groups;
            defaults += counts.defaults;
        });
        WalkedNodes result(allocator_);
        result.degenerate_count = corners_.degenerate_count;
        result.no_uv_area_count = corners_.no_uv_area_count;
        result.mirrored_count = corners_.mirrored_count;
        result.group_count = groups + contested_counts_.groups;
        result.default_corner_count = defaults + contested_counts_.defaults + copyToDegenerate();
        std::size_t left_count = 0;
        for (std::uint8_t& state : state_) {
            state = state == kLeft ? 1 : 0;
            left_count += state;
        }
        result.left_count = left_count;
        result.left = std::move(state_);
        if (left_count != 0) listLeft(result);
        return result;
    }

  private:
    /// Marks contested triangles and their nodes. Returns whether there are any. (Where a node of such a
    /// triangle is not chosen, it has no groups, or one pass has seen that the nodes agree.)
    bool findContested() {
        if (corners_.no_uv_area_count == 0) return false;
        const std::uint8_t* facing = corners_.facing.data();
        for (std::size_t t = 0; t < corners_.flags.size(); ++t) {
            if ((corners_.flags[t] & kAny) == 0) continue;
            const std::uint32_t* places = corners_.placesOf(t);
            if ((facing[places[0]] | facing[places[1]] | facing[places[2]]) == (kFacesUp | kFacesDown)) mark(t, places);
        }
        return !contested_.empty();
    }

    void mark(std::size_t triangle, const std::uint32_t* places) {
        if (contested_.empty()) contested_ = noMarks(allocator_, chosen_.size() + 1);
        corners_.flags[triangle] |= kContested;
        for (std::size_t k = 0; k < 3; ++k) {
            if (corners_.facing[places[k]] == 0 || contested_[places[k]] != 0) continue;
            contested_[places[k]] = 1;
            contested_places_.push(places[k]);
        }
    }

    /// Nodes that share contested triangles are left together or not at all.
    void groupContested() {
        if (spreadContested()) return;
        contested_counts_ = {};
        for (const std::uint32_t place : contested_places_) state_[place] = kLeft;
    }

    bool spreadContested() {
        const std::size_t size = corners_.corners.size();
        Buffer<std::uint8_t> links(allocator_, 2 * size), group(allocator_, size, kNoGroup);
        std::uint8_t *left = links.data(), *right = left + size;
        struct Progress {
            std::uint8_t cursor = 0, group_count = 0;
        };
        Buffer<Progress> progress(allocator_, chosen_.size(), Progress{});
        bool all_small = true;
        for (const std::uint32_t place : contested_places_) {
            const std::uint32_t begin = corners_.begin[place];
            all_small &= corners_.around(place).size() <= kSmallNode;
            if (all_small) linkContested(place, left + begin, right + begin);
        }
        if (!all_small) return false;
        const auto spreadFrom = [&](std::uint32_t place, std::uint32_t flags) {
            const std::uint32_t begin = corners_.begin[place], seed = progress[place].cursor++;
            std::uint8_t* groups = group.data() + begin;
            if ((flags & kAny) != 0 || groups[seed] != kNoGroup) return;
            groups[seed] = progress[place].group_count++;
            for (const std::uint8_t* link : {left + begin, right + begin}) {
                for (std::uint8_t m = link[seed]; m != Links::kNoLink && groups[m] == kNoGroup; m = link[m]) {
                    if (!joinsContested(corners_.numberOf(corners_.corners[begin + m]), flags & kPositive)) break;
                    groups[m] = groups[seed];
                }
            }
        };
        for (std::size_t t = 0; t < corners_.flags.size(); ++t) {
            if ((corners_.flags[t] & kNearContested) == 0) continue;
            const std::uint32_t* places = corners_.placesOf(t);
            for (std::size_t k = 0; k < 3; ++k) {
                if (contested_[places[k]] != 0) spreadFrom(places[k], corners_.flags[t]);
            }
        }
        for (const std::uint32_t place : contested_places_) {
            Members members(corners_.around(place));
            std::copy_n(group.data() + corners_.begin[place], members.count(), members.group);
            members.group_count = progress[place].group_count;
            state_[place] = groups_.finish(place, members, contested_counts_);
            if (state_[place] == kLeft) return false;
        }
        return true;
    }

    /// And marks the triangles around the node.
    void linkContested(std::size_t place, std::uint8_t* to_left, std::uint8_t* to_right) {
        const std::span<const UnclearCorner> around = corners_.around(place);
        const Links links(around);
        std::copy_n(links.left, around.size(), to_left);
        std::copy_n(links.right, around.size(), to_right);
        for (const UnclearCorner& corner : around) corners_.flags[corners_.numberOf(corner)] |= kNearContested;
    }

    /// As in groups.cpp. A triangle that is not contested joins any group.
    bool joinsContested(std::uint32_t triangle, std::uint32_t orientation) {
        std::uint8_t& flags = corners_.flags[triangle];
        if ((flags & (kAny | kContested)) == kAny) return true;
        if ((flags & kAny) != 0 && (flags & kGrouped) == 0)
            flags = static_cast<std::uint8_t>((flags & ~unsigned{kPositive}) | orientation);
        if ((flags & kPositive) != orientation) return false;
        flags |= kGrouped;
        return true;
    }

    void listLeft(WalkedNodes& result) const {
        const auto isLeft = [&](std::uint32_t place) { return place < chosen_.size() && result.left[place] != 0; };
        for (std::size_t t = 0; t < corners_.flags.size(); ++t) {
            const std::uint32_t* places = corners_.placesOf(t);
            if (isLeft(places[0]) || isLeft(places[1]) || isLeft(places[2]))
                result.around_left.push(corners_.triangleOf(t));
        }
    }

    /// Returns how many corners get the default.
    std::uint64_t copyToDegenerate() {
        std::uint64_t defaults = 0;
        for (const auto& [copy, place] : corners_.copies) {
            if (state_[place] == kLeft) continue;
            const std::span<const UnclearCorner> around = corners_.around(place);
            if (around.empty()) {
                groups_.sink().write(copy.to, Tangents{});
            } else {
                const bool first = (copy.from & kMark) != 0;
                groups_.sink().copy({copy.to, first ? around[0].slot : copy.from});
            }
            defaults += around.empty() || state_[place] == kFirstIsDefault ? 1 : 0;
        }
        return defaults;
    }

    const MeshView& mesh_;
    const TriangleList& triangles_;
    const Nodes& nodes_;
    std::span<const std::uint32_t> chosen_;
    Parallel& parallel_;
    const Allocator* allocator_;

    UnclearCorners corners_;
    NodeGroups groups_;
    Buffer<std::uint8_t> state_;
    Marks contested_;  // one per chosen node, and one more; empty when there are none
    Growing<std::uint32_t> contested_places_{allocator_};
    WalkCounts contested_counts_;
};

}  // namespace

WalkedNodes walkNodes(const MeshView& mesh, const TangentOptions& options, const TriangleList& triangles,
                      const Nodes& nodes, std::span<const std::uint32_t> chosen, const CornerSource& source,
                      CornerTermsFunction terms, NodeSums* sums, MarkedBlocks blocks, const TangentOutput& out,
                      Parallel& parallel) {
    return NodeWalk(mesh, options, triangles, nodes, chosen, out, parallel).run(source, terms, sums, blocks);
}

}  // namespace tspace::mikk
