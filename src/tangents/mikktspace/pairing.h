// SPDX-License-Identifier: MIT
// Step 6: which triangle lies across each edge, worked out for one node alone.
//
// The reference sorts all edges by (lower end, higher end, triangle). Going through them in order, each
// half-edge without a neighbour takes the first later one of the same edge that runs the opposite way and has
// none. Claim: that equals going through the half-edges of an edge in order, each taking the oldest waiting
// opposite one or waiting. Proof: waiters of one edge always run in one direction, else two of them would
// have been linked. Say the first half-edge is linked to j by the reference: all between run its own way, so
// it is still the oldest waiter when j comes, and j takes it. Take the pair out and repeat. An edge's
// half-edges are seen completely from either of its ends, in the same (ascending) order, so each node can
// work alone and both ends come to the same links. No edge table and no sort is needed.
#pragma once

#include "core/memory.h"
#include "tangents/mikktspace/grouped_plan.h"

namespace tspace::mikk {

/// The tricorners around one node. Numbers in `left` and `right` are positions in the node's list, or kNone.
struct Around {
    std::uint32_t count = 0;
    const std::uint32_t* list = nullptr;  ///< ascending
    std::uint32_t* next = nullptr;        ///< node of the following corner: the edge that leaves
    std::uint32_t* previous = nullptr;    ///< node of the preceding corner: the edge that arrives
    std::uint32_t* left = nullptr;        ///< who lies across the edge that leaves
    std::uint32_t* right = nullptr;       ///< who lies across the edge that arrives
};

/// Nodes of up to this many tricorners are paired by comparing all with all, on the stack.
inline constexpr std::uint32_t kSmallNode = 64;

/// A hash table of queues, for nodes of more than kSmallNode tricorners.
class PairingTable {
  public:
    PairingTable() = default;
    /// Room for nodes of up to `most` tricorners.
    PairingTable(const Allocator* allocator, std::uint32_t most);
    void pair(Around& around);

  private:
    /// Half-edges to or from one neighbour that wait for a partner. All run in one direction.
    struct Queue {
        std::uint32_t neighbour = kNone, first = kNone, last = kNone;
    };
    Queue& find(std::uint32_t neighbour);
    void meet(std::uint32_t member, std::uint32_t neighbour, std::uint32_t* mine, std::uint32_t* theirs,
              std::uint32_t outgoing);

    Buffer<Queue> queues_;
    Buffer<std::uint32_t> behind_;  // 2 per member: who waits behind its arriving and its leaving half-edge
    std::size_t mask_ = 0;
};

/// Fills next and previous from the list.
void readNeighbours(const GroupedPlan& plan, Around& around);

/// Fills left and right of a small node.
void pairSmall(Around& around);

}  // namespace tspace::mikk
