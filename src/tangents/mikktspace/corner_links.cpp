// SPDX-License-Identifier: MIT
// corner_links.h has the argument.
#include "tangents/mikktspace/corner_links.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/float4.h"

namespace tspace::mikk {

namespace {

/// Where each half-edge has one possible partner at most, that is the one. Returns false where there is a choice, or too
/// many corners.
bool linkUnambiguous(std::span<const NodeCorner> around, const CornerLinks& links) {
    constexpr std::size_t kMost = 16;
    const std::size_t count = around.size();
    if (count > kMost) return false;
    alignas(16) std::uint32_t previous[kMost];
    for (std::size_t i = 0; i < count; ++i) {
        previous[i] = around[i].previous;
        links.right[i] = kNone;
    }
    const std::size_t lanes = (count + 3) / 4 * 4;
    for (std::size_t i = count; i < lanes; ++i) previous[i] = kNone;
    std::uint32_t taken = 0, again = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const auto next = static_cast<std::int32_t>(around[i].next);
        const Mask4 wanted = Mask4{next, next, next, next};
        std::uint32_t found = 0;
        for (std::size_t j = 0; j < lanes; j += 4) {
            Mask4 here;
            std::memcpy(&here, previous + j, sizeof here);
            found |= laneBits(here == wanted) << j;
        }
        again |= (found & taken) | (found & (found - 1));
        taken |= found;
        links.left[i] = found == 0 ? kNone : static_cast<std::uint32_t>(std::countr_zero(found));
        if (found != 0) links.right[links.left[i]] = static_cast<std::uint32_t>(i);
    }
    return again == 0;
}

}  // namespace

void linkSmall(std::span<const NodeCorner> around, const CornerLinks& links) {
    if (linkUnambiguous(around, links)) return;
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

namespace {

/// A member has two neighbours, so there are at most 2 * count keys, and for a proper fan count + 1.
std::size_t tableSize(std::uint32_t count) { return std::bit_ceil(2 * std::size_t{count} + count / 2 + 2); }

}  // namespace

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

}  // namespace tspace::mikk
