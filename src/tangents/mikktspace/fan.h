// SPDX-License-Identifier: MIT
// Whether the triangles around a node form one connected fan, found while they come by in ascending order,
// without a list of them.
//
// The rule of pairing.h links a triangle's leaving half-edge (to the next node) with the oldest waiting
// arriving one from that node, and the other way round. As long as no two half-edges of one direction wait
// for the same neighbour, there is nothing to choose, and the links make paths, each of which is known by its
// two waiting ends. Two paths are kept, which is enough for triangles in mesh order, and for nine in ten
// nodes of six triangles in any order. Whatever else happens makes the fan unclear, and the node is left to
// the general steps (plan.h).
#pragma once

#include <cstdint>

namespace tspace::mikk {

struct Fan {
    static constexpr std::uint32_t kFree = 0xffffffffu;    ///< no path
    static constexpr std::uint32_t kClosed = 0xfffffffeu;  ///< a path that is a ring; no node has this number

    /// Path i leaves towards leaves[i], where a triangle on its other side may follow, and arrives from
    /// arrives[i].
    std::uint32_t leaves[2] = {kFree, kFree};
    std::uint32_t arrives[2] = {kFree, kFree};

    [[nodiscard]] bool isEmpty() const { return leaves[0] == kFree; }
    [[nodiscard]] bool isOne() const { return leaves[0] != kFree && leaves[1] == kFree; }

    /// Adds the triangle whose corner here goes on to `next` and comes from `previous`. Returns false when
    /// the fan has become unclear; then it stays so, whatever isOne() says.
    bool add(std::uint32_t next, std::uint32_t previous) {
        const bool extends_end = leaves[0] == previous, extends_start = arrives[0] == next;
        if (leaves[1] != kFree || !(extends_end || extends_start)) return addToPaths(next, previous);
        if (extends_end && extends_start) {
            leaves[0] = arrives[0] = kClosed;
        } else if (extends_end) {
            leaves[0] = next;
        } else {
            arrives[0] = previous;
        }
        return true;
    }

  private:
    bool addToPaths(std::uint32_t next, std::uint32_t previous) {
        const int end = leaves[0] == previous ? 0 : leaves[1] == previous ? 1 : -1;
        const int start = arrives[0] == next ? 0 : arrives[1] == next ? 1 : -1;
        if (end < 0 && start < 0) {
            const int place = leaves[0] == kFree ? 0 : 1;
            if (leaves[place] != kFree) return false;
            leaves[place] = next;
            arrives[place] = previous;
        } else if (start < 0) {
            leaves[end] = next;
        } else if (end < 0) {
            arrives[start] = previous;
        } else if (end == start) {
            return false;  // a ring, and another path
        } else {
            leaves[0] = leaves[start];
            arrives[0] = arrives[end];
            leaves[1] = arrives[1] = kFree;
        }
        return leaves[1] == kFree || (leaves[0] != leaves[1] && arrives[0] != arrives[1]);
    }
};

}  // namespace tspace::mikk
