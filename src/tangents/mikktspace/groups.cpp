// SPDX-License-Identifier: MIT
#include "tangents/mikktspace/groups.h"

#include <algorithm>
#include <bit>

#include "tangents/mikktspace/fan.h"

namespace tspace::mikk {

namespace {

/// Whether the links between them make one path or ring, without a choice.
bool areOneFan(std::span<const NodeCorner> around) {
    if (around.size() == 1) return true;
    if (around.size() == 2) return around[0].next == around[1].previous || around[1].next == around[0].previous;
    if (around.size() > FanList::kMost) return false;
    FanList list;
    list.clear();
    constexpr std::uint32_t kFar = 1u << 14;  // half of what a list holds: then one bit tells of all that are farther
    std::uint32_t any = 0;
    for (std::uint32_t i = 0; i < around.size(); ++i) {
        const std::uint32_t next = around[i].next - around[0].next, previous = around[i].previous - around[0].next;
        list.set(i, next, previous);
        any |= (next + kFar) | (previous + kFar);
    }
    return any < 2 * kFar && isOneFan(list, static_cast<std::uint32_t>(around.size()));
}

/// Spreads a group from its first corner to both sides. joins(i): whether it may take corner i.
template <class Joins>
void spread(std::uint32_t seed, const CornerLinks& links, std::uint32_t* group, const Joins& joins) {
    for (const std::uint32_t* link : {links.left, links.right}) {
        for (std::uint32_t m = link[seed]; m != kNone && group[m] == kNone && joins(m); m = link[m])
            group[m] = group[seed];
    }
}

/// A member has two neighbours, so there are at most 2 * count keys, and for a proper fan count + 1.
std::size_t tableSize(std::uint32_t count) { return std::bit_ceil(2 * std::size_t{count} + count / 2 + 2); }

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

LinkTable::LinkTable(const Allocator* allocator, std::uint32_t most)
    : queues_(allocator, tableSize(most)), behind_(allocator, 2 * std::size_t{most}) {}

LinkTable::Queue& LinkTable::find(std::uint32_t neighbour) {
    // Nodes with neighbouring numbers, which a fan's rim has, lie side by side in runs of 16.
    const std::uint64_t run = (neighbour / 16) * std::uint64_t{0x9e3779b97f4a7c15u} >> 32;
    std::size_t i = (16 * run + neighbour % 16) & mask_;
    while (queues_[i].neighbour != kNone && queues_[i].neighbour != neighbour) i = (i + 1) & mask_;
    queues_[i].neighbour = neighbour;
    return queues_[i];
}

/// Links a half-edge with the oldest waiting opposite one, or lets it wait. `outgoing` tells which of the
/// member's two half-edges it is; waiters are stored as 2 * member + outgoing.
void LinkTable::meet(std::uint32_t member, std::uint32_t neighbour, std::uint32_t* mine, std::uint32_t* theirs,
                     std::uint32_t outgoing) {
    Queue& queue = find(neighbour);
    const std::uint32_t waiter = 2 * member + outgoing;
    if (queue.first != kNone && (queue.first & 1) != outgoing) {
        const std::uint32_t other = queue.first / 2;
        mine[member] = other;
        theirs[other] = member;
        queue.first = behind_[queue.first];
        return;
    }
    behind_[waiter] = kNone;
    if (queue.first == kNone) {
        queue.first = waiter;
    } else {
        behind_[queue.last] = waiter;
    }
    queue.last = waiter;
}

void LinkTable::link(std::span<const NodeCorner> around, const CornerLinks& links) {
    const std::size_t size = tableSize(static_cast<std::uint32_t>(around.size()));
    mask_ = size - 1;
    std::fill_n(queues_.data(), size, Queue{});
    for (std::uint32_t i = 0; i < around.size(); ++i) {
        links.left[i] = links.right[i] = kNone;
        meet(i, around[i].next, links.left, links.right, 1);
        meet(i, around[i].previous, links.right, links.left, 0);
    }
}

GroupRoom::GroupRoom(const Allocator* allocator, std::uint32_t most) {
    if (most <= kSmallNode) return;
    large_ = Buffer<std::uint32_t>(allocator, 3 * std::size_t{most});
    table_ = LinkTable(allocator, most);
}

Grouping::Grouping(VertexCorners& corners, std::span<const std::uint32_t> chosen, const LastBucket& bucket,
                   const Allocator* allocator)
    : corners_(corners), chosen_(chosen), bucket_(bucket), contested_(allocator) {
    for (std::size_t place = 0; place < chosen.size(); ++place)
        largest_ = std::max(largest_, static_cast<std::uint32_t>(corners.around(place).size()));
    if (corners.no_uv_area_count == 0) return;
    findContested(allocator);
    if (!contested_.empty()) spreadContested(allocator);
}

/// Groups of a node without contested triangles: those without UV area join any.
NodeGroups Grouping::groupsOf(std::size_t place, GroupRoom& room) const {
    const std::span<const NodeCorner> around = corners_.around(place);
    if (!contested_of_.empty() && contested_of_[place] != kNone) {
        const Contested& contested = contested_[contested_of_[place]];
        return {around, contested_groups_.data() + contested.begin, contested.group_count};
    }
    const std::uint8_t facing = corners_.facing[place];
    if (facing != (kFacesUp | kFacesDown)) {
        if (facing == 0) return {around, nullptr, 0};
        if (!bucket_.concerns(chosen_[place]) && areOneFan(around)) return {around, nullptr, 1};
    }
    const auto count = static_cast<std::uint32_t>(around.size());
    std::uint32_t* const group = count <= kSmallNode ? room.small_ : room.large_.data();
    const CornerLinks links{group + count, group + 2 * std::size_t{count}};
    link(place, links, room.table_);
    std::fill_n(group, count, kNone);
    std::uint32_t groups = 0;
    for (std::uint32_t seed = 0; seed < count; ++seed) {
        if (around[seed].addsNothing() || group[seed] != kNone) continue;
        group[seed] = groups++;
        const std::uint32_t orientation = around[seed].common & (kIsUp | kIsDown);
        spread(seed, links, group, [&](std::uint32_t m) { return (around[m].common & orientation) != 0; });
    }
    return {around, group, groups};
}

void Grouping::link(std::size_t place, const CornerLinks& links, LinkTable& table) const {
    const std::span<const NodeCorner> around = corners_.around(place);
    around.size() <= kSmallNode ? linkSmall(around, links) : table.link(around, links);
    if (bucket_.concerns(chosen_[place])) applyBucket(around, links);
}

/// Replaces links by those of the reference's last bucket.
void Grouping::applyBucket(std::span<const NodeCorner> around, const CornerLinks& links) const {
    const auto halfEdgeOf = [&](const NodeCorner& corner) {
        const std::uint32_t own = corners_.halfEdgeOf(corner);
        return 3 * corners_.triangleOf(own / 3) + own % 3;
    };
    const auto turn = [](std::uint32_t half_edge, std::uint32_t by) {
        return half_edge / 3 * 3 + (half_edge + by) % 3;
    };
    const auto placeOf = [&](std::uint32_t half_edge) {
        const auto at = std::lower_bound(around.begin(), around.end(), half_edge,
                                         [&](const NodeCorner& c, std::uint32_t h) { return halfEdgeOf(c) < h; });
        return static_cast<std::uint32_t>(at - around.begin());
    };
    for (std::size_t i = 0; i < around.size(); ++i) {
        const std::uint32_t h = halfEdgeOf(around[i]);
        // A partner runs the opposite way: across the leaving edge it arrives here, across the arriving edge it leaves.
        if (const std::uint32_t* partner = bucket_.partnerOf(h))
            links.left[i] = *partner == kNone ? kNone : placeOf(turn(*partner, 1));
        if (const std::uint32_t* partner = bucket_.partnerOf(turn(h, 2)))
            links.right[i] = *partner == kNone ? kNone : placeOf(*partner);
    }
}

/// Marks contested triangles and their nodes. (Where a node of such a triangle is not chosen, it has no groups, or it is
/// known that its triangles agree.)
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
        if (facing != (kFacesUp | kFacesDown)) continue;
        if (contested_of_.empty()) contested_of_ = Buffer<std::uint32_t>(allocator, chosen_.size() + 1, kNone);
        corners_.flags[t] |= kContested;
        for (std::size_t k = 0; k < 3; ++k) add(places[k]);
    }
}

/// Nodes of contested triangles: linked first, then walked over in the reference's order, which is that of triangles. A
/// cursor per node follows its corners along.
void Grouping::spreadContested(const Allocator* allocator) {
    std::size_t size = 0;
    for (Contested& node : contested_) {
        node.begin = size;
        size += corners_.around(node.place).size();
    }
    contested_groups_ = Buffer<std::uint32_t>(allocator, size, kNone);
    Buffer<std::uint32_t> left(allocator, size), right(allocator, size);
    LinkTable table(allocator, largest_);
    for (const Contested& node : contested_) {
        link(node.place, {left.data() + node.begin, right.data() + node.begin}, table);
        for (const NodeCorner& corner : corners_.around(node.place))
            corners_.flags[corners_.numberOf(corner)] |= kNearContested;
    }
    const auto spreadFrom = [&](Contested& node, std::uint32_t flags) {
        const std::uint32_t seed = node.cursor++;
        std::uint32_t* const group = contested_groups_.data() + node.begin;
        if ((flags & kAny) != 0 || group[seed] != kNone) return;
        group[seed] = node.group_count++;
        const NodeCorner* const around = corners_.around(node.place).data();
        spread(seed, {left.data() + node.begin, right.data() + node.begin}, group,
               [&](std::uint32_t m) { return joinsContested(corners_.numberOf(around[m]), flags & kPositive); });
    };
    for (std::size_t t = 0; t < corners_.flags.size(); ++t) {
        if ((corners_.flags[t] & kNearContested) == 0) continue;
        const std::uint32_t* places = corners_.placesOf(t);
        for (std::size_t k = 0; k < 3; ++k) {
            if (contested_of_[places[k]] != kNone) spreadFrom(contested_[contested_of_[places[k]]], corners_.flags[t]);
        }
    }
}

/// A triangle that is not contested joins any group; a contested one takes the orientation of the first that asks.
bool Grouping::joinsContested(std::uint32_t triangle, std::uint32_t orientation) {
    std::uint8_t& flags = corners_.flags[triangle];
    if ((flags & (kAny | kContested)) == kAny) return true;
    if ((flags & kAny) != 0 && (flags & kGrouped) == 0)
        flags = static_cast<std::uint8_t>((flags & ~unsigned{kPositive}) | orientation);
    if ((flags & kPositive) != orientation) return false;
    flags |= kGrouped;
    return true;
}

}  // namespace tspace::mikk
