// SPDX-License-Identifier: MIT
// Which corner of a node lies across each of its edges, worked out for one node alone.
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

#include <span>

#include "tangents/mikktspace/vertex_corners.h"

namespace tspace::mikk {

/// Nodes of up to this many corners are paired by comparing all with all, on the stack.
inline constexpr std::uint32_t kSmallNode = 64;

/// For each corner of a node the one that lies across the edge that leaves here, and across the edge that arrives: its
/// place among them, or kNone.
struct CornerLinks {
    std::uint32_t* left;
    std::uint32_t* right;
};

/// For small nodes.
void linkSmall(std::span<const NodeCorner> around, const CornerLinks& links);

/// A hash table of queues, for larger ones.
class LinkTable {
  public:
    LinkTable() = default;
    /// Room for nodes of up to `most` corners.
    LinkTable(const Allocator* allocator, std::uint32_t most);
    void link(std::span<const NodeCorner> around, const CornerLinks& links);

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

}  // namespace tspace::mikk
