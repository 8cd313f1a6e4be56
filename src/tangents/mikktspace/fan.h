// SPDX-License-Identifier: MIT
// Whether the triangles around a node form one connected fan: found while they come by in ascending order (Fan), or from a
// list of them (FanList). Following it as triangles come costs less where they come in mesh order; where they come in any
// order, a processor cannot foresee what each does, and with a list nothing has to be foreseen.
//
// The rule of groups.h links a triangle's leaving half-edge (to the next node) with the oldest waiting
// arriving one from that node, and the other way round. As long as no two half-edges of one direction wait
// for the same neighbour, there is nothing to choose, and the links make paths, each of which is known by its
// two waiting ends. A fan has room for two paths, which is enough for triangles in mesh order. Where triangles
// come in any order, more begin before they meet: such a fan borrows room for four until two are left again.
// Whatever else happens makes the fan complex, and the node is left to the vertex path.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

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

/// The corners at a node, in any order: each goes on to `next` and comes from `previous`, nodes that are given by
/// their distance from some node.
struct alignas(16) FanList {
    static constexpr std::uint32_t kMost = 8;
    static constexpr std::int16_t kNoNext = -32768, kNoPrevious = -32767;  ///< what unused places hold
    static constexpr std::int32_t kLeast = -32766, kLargest = 32767;       ///< distances

    std::int16_t next[kMost], previous[kMost];

    void clear() {
        for (std::uint32_t i = 0; i < kMost; ++i) next[i] = kNoNext;
        for (std::uint32_t i = 0; i < kMost; ++i) previous[i] = kNoPrevious;
    }
    /// Whether a list can hold a distance, which may have passed below zero.
    static bool holds(std::uint32_t distance) {
        constexpr auto kBelow = static_cast<std::uint32_t>(-kLeast);
        return distance + kBelow <= kBelow + kLargest;
    }
    void set(std::uint32_t place, std::uint32_t to_next, std::uint32_t to_previous) {
        next[place] = static_cast<std::int16_t>(to_next);
        previous[place] = static_cast<std::int16_t>(to_previous);
    }
};

/// What follows each place of a list, as eight bytes each.
struct FanLinks {
    std::uint64_t places;  ///< 8 * a place from which the corner goes on, if there is one only
    std::uint64_t counts;  ///< how many there are
};

using EightNumbers = std::uint16_t __attribute__((vector_size(16)));

/// From 256 times a count plus 8 times a place, which are below 256 each.
inline FanLinks splitLinks(EightNumbers links) {
    using EightBytes = std::uint8_t __attribute__((vector_size(8)));
    const auto bytes = [](EightNumbers numbers) {
        return std::bit_cast<std::uint64_t>(__builtin_convertvector(numbers, EightBytes));
    };
    return {bytes(links & 0xff), bytes(links >> 8)};
}

/// Lane by lane, with the other list turned by 0 to 7 lanes: each match adds its place, and 1 to the byte above.
inline FanLinks linksOf(const FanList& list) {
    using FourPairs = std::uint32_t __attribute__((vector_size(16)));
    const auto load = [](const std::int16_t* from) {
        EightNumbers numbers;
        std::memcpy(&numbers, __builtin_assume_aligned(from, sizeof numbers), sizeof numbers);
        return numbers;
    };
    const EightNumbers next = load(list.next), even = load(list.previous);
    const EightNumbers odd = __builtin_shufflevector(even, even, 1, 2, 3, 4, 5, 6, 7, 0);
    const auto even_pairs = std::bit_cast<FourPairs>(even), odd_pairs = std::bit_cast<FourPairs>(odd);
    EightNumbers links = {};
    const auto match = [&](auto previous, std::uint16_t first) {
        const auto place = [=](unsigned i) { return static_cast<std::uint16_t>(0x100 + 8 * ((first + i) % 8)); };
        const EightNumbers places{place(0), place(1), place(2), place(3), place(4), place(5), place(6), place(7)};
        links += std::bit_cast<EightNumbers>(next == std::bit_cast<EightNumbers>(previous)) & places;
    };
    match(even, 0);
    match(odd, 1);
    match(__builtin_shufflevector(even_pairs, even_pairs, 1, 2, 3, 0), 2);
    match(__builtin_shufflevector(odd_pairs, odd_pairs, 1, 2, 3, 0), 3);
    match(__builtin_shufflevector(even_pairs, even_pairs, 2, 3, 0, 1), 4);
    match(__builtin_shufflevector(odd_pairs, odd_pairs, 2, 3, 0, 1), 5);
    match(__builtin_shufflevector(even_pairs, even_pairs, 3, 0, 1, 2), 6);
    match(__builtin_shufflevector(odd_pairs, odd_pairs, 3, 0, 1, 2), 7);
    return splitLinks(links);
}

/// Whether the `count` corners of a list are one fan: each half-edge is there once, and the links of
/// groups.h, between which there is then nothing to choose, make one path or one ring of all of them. Not for
/// an empty list.
inline bool isOneFan(const FanList& list, std::uint32_t count) {
    constexpr std::uint64_t kOnes = 0x0101010101010101u, kPlaces = 0x38 * kOnes;
    const FanLinks links = linksOf(list);
    const std::uint64_t all = kOnes >> (64 - 8 * count);
    // A ring has as many links as corners, a path one less. Then the place that none leads to is what is left of
    // the sum of all places, and a link from the path's end to there makes it a ring.
    const std::uint64_t ends = all & ~links.counts;
    const std::uint64_t rest = 4u * count * (count - 1) - ((links.places * kOnes) >> 56);
    const std::uint64_t places = (links.places + (rest & 0x38) * ends) & kPlaces;
    // Eight steps around a ring come to all of its corners, the first one as well. Where they do, each corner
    // has one that leads to it, so that no half-edge is there twice.
    std::uint64_t place = 0, seen = 0;
    for (std::uint32_t i = 0; i < FanList::kMost; ++i) {
        place = (places >> place) & 0xff;
        seen |= std::uint64_t{1} << place;
    }
    return seen == all && (links.counts & ~kOnes) == 0 && (ends & (ends - 1)) == 0;
}

}  // namespace tspace::mikk
