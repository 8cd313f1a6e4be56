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
    NodeWalk(const MeshView& mesh, const TangentOptions& options, const TriangleList& triangles,
             const Nodes& nodes, std::span<const std::uint32_t> chosen, const TangentOutput& out,
             Parallel& parallel)
        : mesh_(mesh),
          triangles_(triangles),
          nodes_(nodes),
          chosen_(chosen),
          parallel_(parallel),
          allocator_(options.execution.allocator),
          corners_(allocator_),
          groups_(mesh, options, triangles, nodes, chosen, out, corners_) {}

    WalkedNodes run(std::span<const std::uint32_t> doubtful, CornerSource source, CornerTermsFunction terms,
                    NodeSums* sums) {
        source.tangents_only = !groups_.isFull() && !groups_.maySplit();
        corners_ =
            readCorners({mesh_, triangles_, nodes_, chosen_, source, terms, sums, allocator_, parallel_});
        state_ = Buffer<std::uint8_t>(allocator_, chosen_.size(), std::uint8_t{kDone});
        if (sums == nullptr ? findContestedOfAll() : findContested(doubtful)) groupContested();
        std::atomic<std::uint64_t> groups{0}, defaults{0};
        parallel_.forRanges(chosen_.size(), kNodeGrain, [&](std::size_t begin, std::size_t end) {
            WalkCounts counts;
            for (std::size_t place = begin; place < end; ++place) {
                if (!contested_.empty() && contested_[place] != 0) continue;
                if (corners_.degenerate_count != 0) corners_.dropDegenerate(place);
                state_[place] = groups_.walk(place, counts);
            }
            groups += counts.groups;
            defaults += counts.defaults;
        });
        WalkedNodes result;
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
        return result;
    }

  private:
    void mark(std::size_t triangle, const std::uint32_t* places) {
        if (contested_.empty()) contested_ = noMarks(allocator_, chosen_.size());
        corners_.flags[triangle] |= kContested;
        for (std::size_t k = 0; k < 3; ++k) contested_[places[k]] = 1;
    }

    /// Marks contested triangles and their nodes. Returns whether there are any.
    bool findContested(std::span<const std::uint32_t> doubtful) {
        const std::uint32_t *found = corners_.found.data(), *end = found + corners_.found.size(),
                            *next = found;
        for (const std::uint32_t triangle : doubtful) {
            next = std::lower_bound(next, end, triangle);
            const auto t = static_cast<std::size_t>(next - found);
            const std::uint32_t* at = corners_.at.data() + 3 * t;
            const std::uint32_t p[3] = {placeOf(at[0]), placeOf(at[1]), placeOf(at[2])};
            if ((facing(p[0]) | facing(p[1]) | facing(p[2])) == 3) mark(t, p);
        }
        return !contested_.empty();
    }

    /// The same among all triangles.
    bool findContestedOfAll() {
        if (corners_.no_uv_area_count == 0) return false;
        Buffer<std::uint8_t> facing(allocator_, chosen_.size(), std::uint8_t{0});
        const std::size_t count = corners_.flags.size();
        for (std::size_t t = 0; t < count; ++t) {
            const std::uint8_t here = facingOf(corners_.flags[t]);
            for (std::size_t k = 0; k < 3; ++k) facing[corners_.nodes[3 * t + k]] |= here;
        }
        for (std::size_t t = 0; t < count; ++t) {
            if ((corners_.flags[t] & kAny) == 0) continue;
            const std::uint32_t* n = corners_.nodes.data() + 3 * t;
            if ((facing[n[0]] | facing[n[1]] | facing[n[2]]) == 3) mark(t, n);
        }
        return !contested_.empty();
    }

    /// Valid too where corners of degenerate triangles were taken out.
    [[nodiscard]] std::uint32_t placeOf(std::uint32_t at) const { return corners_.corners[at].place; }

    /// Which orientations the triangles at a node have.
    [[nodiscard]] unsigned facing(std::size_t place) const {
        unsigned result = 0;
        for (const UnclearCorner& corner : corners_.around(place)) result |= facingOf(corner.flags);
        return result;
    }
    /// 1: up, 2: down; 0: neither.
    static std::uint8_t facingOf(std::uint32_t flags) {
        const auto facing = static_cast<std::uint8_t>((flags & kPositive) != 0 ? 1 : 2);
        return (flags & (kAny | kDegenerate)) != 0 ? std::uint8_t{0} : facing;
    }

    /// Nodes that share contested triangles are left together or not at all.
    void groupContested() {
        if (spreadContested()) return;
        contested_counts_ = {};
        for (std::size_t place = 0; place < chosen_.size(); ++place) {
            if (contested_[place] != 0) state_[place] = kLeft;
        }
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
        for (std::size_t place = 0; place < chosen_.size(); ++place) {
            if (contested_[place] == 0) continue;
            corners_.dropDegenerate(place);
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
                    if (!joinsContested(corners_.corners[begin + m].triangle, flags & kPositive)) break;
                    groups[m] = groups[seed];
                }
            }
        };
        for (std::size_t t = 0; t < corners_.flags.size(); ++t) {
            if ((corners_.flags[t] & kNearContested) == 0) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t at = corners_.at[3 * t + k];
                if (at == kNone) continue;
                const std::uint32_t place = placeOf(at);
                if (contested_[place] != 0) spreadFrom(place, corners_.flags[t]);
            }
        }
        for (std::size_t place = 0; place < chosen_.size(); ++place) {
            if (contested_[place] == 0) continue;
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
        for (const UnclearCorner& corner : around) corners_.flags[corner.triangle] |= kNearContested;
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
    Marks contested_;  // empty when there are none
    WalkCounts contested_counts_;
};

}  // namespace

WalkedNodes walkNodes(const MeshView& mesh, const TangentOptions& options, const TriangleList& triangles,
                      const Nodes& nodes, std::span<const std::uint32_t> chosen,
                      std::span<const std::uint32_t> doubtful, const CornerSource& source,
                      CornerTermsFunction terms, NodeSums* sums, const TangentOutput& out,
                      Parallel& parallel) {
    return NodeWalk(mesh, options, triangles, nodes, chosen, out, parallel)
        .run(doubtful, source, terms, sums);
}

}  // namespace tspace::mikk
