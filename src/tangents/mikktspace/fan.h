// SPDX-License-Identifier: MIT
// Whether the triangles around a node form one connected fan, found while they come by in ascending order,
// without a list of them.
//
// The rule of corner_links.h links a triangle's leaving half-edge (to the next node) with the oldest waiting
// arriving one from that node, and the other way round. As long as no two half-edges of one direction wait
// for the same neighbour, there is nothing to choose, and the links make paths, each of which is known by its
// two waiting ends. A fan has room for two paths, which is enough for triangles in mesh order. Where triangles
// come in any order, more begin before they meet: such a fan borrows room for four until two are left again.
// Whatever else happens makes the fan complex, and the node is left to the vertex path.
#pragma once

#include <cstdint>

namespace tspace::mikk {

/// The paths of a fan that has more than two. Those from `count` on mean nothing.
struct ManyPaths {
    static constexpr std::uint32_t kMost = 4;
    std::uint32_t leaves[kMost], arrives[kMost];
};

/// Places for fans of many paths. Each task has some of its own.
class FanRoom {
  public:
    static constexpr std::uint32_t kNone = 0xffffffffu;

    FanRoom(ManyPaths* places, std::size_t count) : places_(places), unused_(static_cast<std::uint32_t>(count)) {}

    ManyPaths& operator[](std::uint32_t place) { return places_[place]; }
    /// kNone when all are taken.
    std::uint32_t take() {
        if (free_ == kNone) return unused_ == 0 ? kNone : --unused_;
        const std::uint32_t place = free_;
        free_ = places_[place].leaves[0];
        return place;
    }
    void giveBack(std::uint32_t place) {
        places_[place].leaves[0] = free_;
        free_ = place;
    }

  private:
    ManyPaths* places_;
    std::uint32_t unused_;        // places [0, unused_) were never taken
    std::uint32_t free_ = kNone;  // a list of those that were given back, by leaves[0]
};

struct Fan {
    static constexpr std::uint32_t kFree = 0xffffffffu;    ///< no path
    static constexpr std::uint32_t kClosed = 0xfffffffeu;  ///< a path that is a ring; no node has this number
    /// In arrives[1], plus 3 or 4: that many paths, in the place leaves[1].
    static constexpr std::uint32_t kMany = 0xfffffff0u;

    /// Path i leaves towards leaves[i], where a triangle on its other side may follow, and arrives from
    /// arrives[i].
    std::uint32_t leaves[2] = {kFree, kFree};
    std::uint32_t arrives[2] = {kFree, kFree};

    [[nodiscard]] bool isEmpty() const { return leaves[0] == kFree; }
    [[nodiscard]] bool isOne() const { return leaves[0] != kFree && leaves[1] == kFree; }

    /// Adds the triangle whose corner here goes on to `next` and comes from `previous`. Returns false when
    /// the fan has become complex; then it stays so, whatever isOne() says.
    bool add(std::uint32_t next, std::uint32_t previous, FanRoom& room) {
        const bool extends_end = leaves[0] == previous, extends_start = arrives[0] == next;
        if (leaves[1] != kFree || !(extends_end || extends_start)) return addToPaths(next, previous, room);
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
    bool addToPaths(std::uint32_t next, std::uint32_t previous, FanRoom& room) {
        if (arrives[1] - kMany < kClosed - kMany) [[unlikely]]
            return addToMany(next, previous, room);
        const int end = leaves[0] == previous ? 0 : leaves[1] == previous ? 1 : -1;
        const int start = arrives[0] == next ? 0 : arrives[1] == next ? 1 : -1;
        if (end < 0 && start < 0) {
            if (leaves[0] != kFree && leaves[1] != kFree) return moveToRoom(next, previous, room);
            const int place = leaves[0] == kFree ? 0 : 1;
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

    /// A third path begins.
    [[gnu::noinline]] bool moveToRoom(std::uint32_t next, std::uint32_t previous, FanRoom& room) {
        if (leaves[0] == next || leaves[1] == next || arrives[0] == previous || arrives[1] == previous ||
            leaves[0] == kClosed || leaves[1] == kClosed)
            return false;
        const std::uint32_t place = room.take();
        if (place == FanRoom::kNone) return false;
        room[place] = {{leaves[0], leaves[1], next}, {arrives[0], arrives[1], previous}};
        leaves[1] = place;
        arrives[1] = kMany + 3;
        return true;
    }

    [[gnu::noinline]] bool addToMany(std::uint32_t next, std::uint32_t previous, FanRoom& room) {
        ManyPaths& paths = room[leaves[1]];
        const std::uint32_t count = arrives[1] - kMany;
        std::uint32_t end = count, start = count;
        bool simple = true;
        for (std::uint32_t i = 0; i < count; ++i) {
            if (paths.leaves[i] == previous) end = i;
            if (paths.arrives[i] == next) start = i;
            simple &= paths.leaves[i] != next && paths.arrives[i] != previous;
        }
        if (end < count && start < count) {
            if (end == start) return false;  // a ring, and other paths
            paths.leaves[end] = paths.leaves[start];
            paths.leaves[start] = paths.leaves[count - 1];
            paths.arrives[start] = paths.arrives[count - 1];
            --arrives[1];
            if (count == 3) moveBack(room);
            return true;
        }
        if (end < count) {
            paths.leaves[end] = next;
        } else if (start < count) {
            paths.arrives[start] = previous;
        } else {
            if (count == ManyPaths::kMost) return false;
            paths.leaves[count] = next;
            paths.arrives[count] = previous;
            ++arrives[1];
        }
        return simple;
    }

    /// Two paths are left.
    void moveBack(FanRoom& room) {
        const std::uint32_t place = leaves[1];
        const ManyPaths paths = room[place];
        room.giveBack(place);
        for (int i = 0; i < 2; ++i) {
            leaves[i] = paths.leaves[i];
            arrives[i] = paths.arrives[i];
        }
    }
};

}  // namespace tspace::mikk
