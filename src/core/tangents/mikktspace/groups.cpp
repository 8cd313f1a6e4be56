// SPDX-License-Identifier: MIT
// The grouping itself: links, groups, and contested triangles. groups.h has the proofs.
#include "core/tangents/mikktspace/groups.h"

#include <algorithm>
#include <functional>

#include "core/base/sort.h"
#include "core/tangents/mikktspace/fan.h"

namespace tspace::mikk {

namespace {

/// Whether the links between them make one path or ring, without a choice.
bool areOneFan(std::span<const NodeCorner> around) {
    ManyPaths place;
    FanRoom room(&place);
    Fan fan;
    for (const NodeCorner& corner : around) fan.add(corner.next, corner.previous, room);
    return fan.isOne();
}

/// Spreads a group from its first corner to both sides. joins(i): whether corner i may join it.
template <class Joins>
void spread(std::uint32_t seed, const CornerLinks& links, std::uint32_t* group, const Joins& joins) {
    for (const std::uint32_t* link : {links.left, links.right}) {
        for (std::uint32_t m = link[seed]; m != kNone && group[m] == kNone && joins(m); m = link[m])
            group[m] = group[seed];
    }
}

}  // namespace

void linkSmall(std::span<const NodeCorner> around, const CornerLinks& links) {
    const auto [left, right] = links;
    for (std::uint32_t i = 0; i < around.size(); ++i) {
        left[i] = right[i] = kNone;
        const std::uint32_t next = around[i].next, previous = around[i].previous;
        for (std::uint32_t j = 0; j < i; ++j) {
            if (around[j].previous == next && right[j] == kNone) {
                left[i] = j;
                right[j] = i;
                break;
            }
        }
        for (std::uint32_t j = 0; j < i; ++j) {
            if (around[j].next == previous && left[j] == kNone) {
                right[i] = j;
                left[j] = i;
                break;
            }
        }
    }
}

/// Sort keys: the neighbour in the high word; 2 * corner in the low one, plus 1 for the edge that leaves. Of one neighbour's
/// half-edges those that wait all run in one direction, so the oldest is the partner of the next opposite one.
void linkLarge(std::span<const NodeCorner> around, const CornerLinks& links, std::uint64_t* half_edges) {
    const std::size_t count = 2 * around.size();
    for (std::size_t i = 0; i < around.size(); ++i) {
        links.left[i] = links.right[i] = kNone;
        half_edges[2 * i] = std::uint64_t{around[i].previous} << 32 | 2 * i;
        half_edges[2 * i + 1] = std::uint64_t{around[i].next} << 32 | (2 * i + 1);
    }
    sortList(half_edges, half_edges + count, std::less<>());
    const auto linkOf = [&](std::size_t i) -> std::uint32_t& {
        const auto half_edge = static_cast<std::uint32_t>(half_edges[i]);
        return ((half_edge & 1) != 0 ? links.left : links.right)[half_edge / 2];
    };
    const auto cornerOf = [&](std::size_t i) { return static_cast<std::uint32_t>(half_edges[i]) / 2; };
    for (std::size_t i = 0, oldest = 0; i < count; ++i) {
        while (oldest < i && (half_edges[oldest] >> 32 != half_edges[i] >> 32 || linkOf(oldest) != kNone)) ++oldest;
        if (((half_edges[oldest] ^ half_edges[i]) & 1) == 0) continue;
        linkOf(oldest) = cornerOf(i);
        linkOf(i) = cornerOf(oldest);
    }
}

Grouping::Grouping(const VertexPath& path, VertexCorners& corners)
    : chosen_(path.chosen),
      bucket_(path.setting.bucket),
      corners_(corners),
      contested_(path.setting.options.execution.allocator) {
    const Allocator* allocator = path.setting.options.execution.allocator;
    std::size_t largest = 0;
    for (std::size_t place = 0; place < chosen_.size(); ++place)
        largest = std::max(largest, corners.around(place).size());
    scratch_ = Buffer<std::uint32_t>(allocator, 3 * largest);
    if (largest > kSmallNode) half_edges_ = Buffer<std::uint64_t>(allocator, 2 * largest);
    if (corners.report.degenerate_uv_count == 0) return;
    findContested(allocator);
    if (!contested_.empty()) spreadContested(allocator);
}

/// In a node without contested triangles, those without UV area join any group.
NodeGroups Grouping::groupsOf(std::size_t place) {
    const std::span<const NodeCorner> around = corners_.around(place);
    if (!contested_of_.empty() && contested_of_[place] != kNone) {
        const Contested& contested = contested_[contested_of_[place]];
        return {around, contested_groups_.data() + contested.begin, contested.group_count};
    }
    const std::uint8_t facing = corners_.facing[place];
    if (facing != kFacing) {
        if (facing == 0) return {around, nullptr, 0};
        if (!bucket_.concerns(chosen_[place]) && areOneFan(around)) return {around, nullptr, 1};
    }
    const auto count = static_cast<std::uint32_t>(around.size());
    std::uint32_t* const group = scratch_.data();
    const CornerLinks links{group + count, group + 2 * std::size_t{count}};
    link(place, links);
    std::fill_n(group, count, kNone);
    std::uint32_t groups = 0;
    for (std::uint32_t seed = 0; seed < count; ++seed) {
        if (around[seed].facing == 0 || group[seed] != kNone) continue;
        group[seed] = groups++;
        const std::uint32_t opposite = around[seed].facing ^ kFacing;
        spread(seed, links, group, [&](std::uint32_t m) { return around[m].facing != opposite; });
    }
    return {around, group, groups};
}

void Grouping::link(std::size_t place, const CornerLinks& links) {
    const std::span<const NodeCorner> around = corners_.around(place);
    around.size() <= kSmallNode ? linkSmall(around, links) : linkLarge(around, links, half_edges_.data());
    if (bucket_.concerns(chosen_[place])) applyBucket(around, links);
}

/// Replaces the links of half-edges that the reference pairs in another way (last_bucket.h).
void Grouping::applyBucket(std::span<const NodeCorner> around, const CornerLinks& links) const {
    const auto turn = [](std::uint32_t half_edge, std::uint32_t by) {
        return half_edge / 3 * 3 + (half_edge + by) % 3;
    };
    const auto placeOf = [&](std::uint32_t half_edge) {
        const auto at = std::lower_bound(
            around.begin(), around.end(), half_edge,
            [&](const NodeCorner& corner, std::uint32_t h) { return corners_.halfEdgeOf(corner.half_edge) < h; });
        return static_cast<std::uint32_t>(at - around.begin());
    };
    for (std::size_t i = 0; i < around.size(); ++i) {
        const std::uint32_t h = corners_.halfEdgeOf(around[i].half_edge);
        // A partner runs the opposite way: across the leaving edge it arrives here, across the arriving edge it leaves.
        if (const std::uint32_t* partner = bucket_.partnerOf(h))
            links.left[i] = *partner == kNone ? kNone : placeOf(turn(*partner, 1));
        if (const std::uint32_t* partner = bucket_.partnerOf(turn(h, 2)))
            links.right[i] = *partner == kNone ? kNone : placeOf(*partner);
    }
}

/// Marks contested triangles and their nodes. (A node of such a triangle that is not chosen has no groups, or its triangles
/// are known to agree.)
void Grouping::findContested(const Allocator* allocator) {
    const auto add = [&](std::uint32_t place) {
        if (corners_.facing[place] == 0 || contested_of_[place] != kNone) return;
        contested_of_[place] = static_cast<std::uint32_t>(contested_.size());
        contested_.push({place});
    };
    for (std::size_t t = 0; t < corners_.flags.size(); ++t) {
        if ((corners_.flags[t] & kAny) == 0) continue;
        const std::uint32_t* places = corners_.placesOf(t);
        std::uint32_t facing = 0;
        for (std::size_t k = 0; k < 3; ++k) facing |= corners_.facing[places[k]];
        if (facing != kFacing) continue;
        if (contested_of_.empty()) contested_of_ = Buffer<std::uint32_t>(allocator, chosen_.size() + 1, kNone);
        corners_.flags[t] |= kContested;
        for (std::size_t k = 0; k < 3; ++k) add(places[k]);
    }
}

/// Groups the nodes of contested triangles: links them first, then goes through all triangles in the reference's order. A
/// cursor per node moves along its corners.
void Grouping::spreadContested(const Allocator* allocator) {
    std::size_t size = 0;
    for (Contested& node : contested_) {
        node.begin = size;
        size += corners_.around(node.place).size();
    }
    contested_groups_ = Buffer<std::uint32_t>(allocator, size, kNone);
    Buffer<std::uint32_t> left(allocator, size), right(allocator, size);
    for (const Contested& node : contested_) link(node.place, {left.data() + node.begin, right.data() + node.begin});
    const auto spreadFrom = [&](Contested& node, std::uint32_t flags) {
        const std::uint32_t seed = node.cursor++;
        std::uint32_t* const group = contested_groups_.data() + node.begin;
        if ((flags & kAny) != 0 || group[seed] != kNone) return;
        group[seed] = node.group_count++;
        const NodeCorner* const around = corners_.around(node.place).data();
        spread(seed, {left.data() + node.begin, right.data() + node.begin}, group,
               [&](std::uint32_t m) { return joinsContested(around[m].half_edge / 3, flags & kFacing); });
    };
    for (std::size_t t = 0; t < corners_.flags.size(); ++t) {
        if ((corners_.flags[t] & kDegenerate) != 0) continue;
        const std::uint32_t* places = corners_.placesOf(t);
        for (std::size_t k = 0; k < 3; ++k) {
            if (contested_of_[places[k]] != kNone) spreadFrom(contested_[contested_of_[places[k]]], corners_.flags[t]);
        }
    }
}

/// A triangle that is not contested joins any group; a contested one takes the orientation of the first that asks.
bool Grouping::joinsContested(std::uint32_t triangle, std::uint32_t facing) {
    std::uint8_t& flags = corners_.flags[triangle];
    if ((flags & (kAny | kContested)) == kAny) return true;
    if ((flags & kFacing) == 0) flags = static_cast<std::uint8_t>(flags | facing);
    return (flags & kFacing) == facing;
}

}  // namespace tspace::mikk
