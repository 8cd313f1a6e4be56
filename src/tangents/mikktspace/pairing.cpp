// SPDX-License-Identifier: MIT
// Step 6: which triangle lies across each edge. pairing.h has the argument.
#include "tangents/mikktspace/pairing.h"

#include <algorithm>
#include <bit>

namespace tspace::mikk {

void readNeighbours(const GroupedPlan& plan, Around& around) {
    for (std::uint32_t i = 0; i < around.count; ++i) {
        const std::uint32_t h = around.list[i], first = h - h % 3;
        const std::uint32_t k = h - first;
        around.next[i] = plan.nodes[first + (k + 1) % 3];
        around.previous[i] = plan.nodes[first + (k + 2) % 3];
    }
}

void pairSmall(Around& around) {
    for (std::uint32_t i = 0; i < around.count; ++i) {
        around.left[i] = around.right[i] = kNone;
        const std::uint32_t next = around.next[i], previous = around.previous[i];
        for (std::uint32_t j = 0; j < i; ++j) {
            if (around.previous[j] == next && around.right[j] == kNone) {
                around.left[i] = j;
                around.right[j] = i;
                break;
            }
        }
        for (std::uint32_t j = 0; j < i; ++j) {
            if (around.next[j] == previous && around.left[j] == kNone) {
                around.right[i] = j;
                around.left[j] = i;
                break;
            }
        }
    }
}

namespace {

/// A member has two neighbours, so there are at most 2 * count keys, and for a proper fan count + 1.
std::size_t tableSize(std::uint32_t count) { return std::bit_ceil(2 * std::size_t{count} + count / 2 + 2); }

}  // namespace

PairingTable::PairingTable(const Allocator* allocator, std::uint32_t most)
    : queues_(allocator, tableSize(most)), behind_(allocator, 2 * std::size_t{most}) {}

PairingTable::Queue& PairingTable::find(std::uint32_t neighbour) {
    // Nodes with neighbouring numbers, which a fan's rim has, lie side by side in runs of 16.
    const std::uint64_t run = (neighbour / 16) * std::uint64_t{0x9e3779b97f4a7c15u} >> 32;
    std::size_t i = (16 * run + neighbour % 16) & mask_;
    while (queues_[i].neighbour != kNone && queues_[i].neighbour != neighbour) i = (i + 1) & mask_;
    queues_[i].neighbour = neighbour;
    return queues_[i];
}

/// Links a half-edge with the oldest waiting opposite one, or lets it wait. `outgoing` tells which of the
/// member's two half-edges it is; waiters are stored as 2 * member + outgoing.
void PairingTable::meet(std::uint32_t member, std::uint32_t neighbour, std::uint32_t* mine, std::uint32_t* theirs,
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

void PairingTable::pair(Around& around) {
    const std::size_t size = tableSize(around.count);
    mask_ = size - 1;
    std::fill_n(queues_.data(), size, Queue{});
    for (std::uint32_t i = 0; i < around.count; ++i) {
        around.left[i] = around.right[i] = kNone;
        meet(i, around.next[i], around.left, around.right, 1);
        meet(i, around.previous[i], around.right, around.left, 0);
    }
}

}  // namespace tspace::mikk
