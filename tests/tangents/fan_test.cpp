// SPDX-License-Identifier: MIT
// Following a fan by its open ends must agree with pairing all of its half-edges.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <vector>

#include "tangents/mikktspace/fan.h"
#include "tangents/mikktspace/groups.h"

namespace tspace::mikk {
namespace {

struct Corners {
    std::vector<std::uint32_t> next, previous;
};

struct Places {
    std::vector<ManyPaths> places;
    FanRoom room;
    explicit Places(std::size_t count = 2) : places(count), room(places.data(), count) {}
};

/// How many connected parts the links of groups.h make.
std::size_t countParts(const Corners& corners) {
    const auto count = static_cast<std::uint32_t>(corners.next.size());
    std::vector<NodeCorner> around(count);
    for (std::size_t i = 0; i < count; ++i) around[i] = {nullptr, corners.next[i], corners.previous[i], 0, 0};
    std::vector<std::uint32_t> left(count), right(count), part(count, kNone);
    linkSmall(around, {left.data(), right.data()});
    std::size_t parts = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (part[i] != kNone) continue;
        ++parts;
        for (std::uint32_t m = i; m != kNone && part[m] == kNone; m = left[m]) part[m] = 1;
        for (std::uint32_t m = right[i]; m != kNone && part[m] == kNone; m = right[m]) part[m] = 1;
    }
    return parts;
}

/// Neighbours around a ring or path, in random order, and some corners that do not fit.
Corners randomCorners() {
    const auto size = *rc::gen::inRange<std::uint32_t>(2, 10);
    const bool closed = *rc::gen::arbitrary<bool>();
    Corners corners;
    for (std::uint32_t i = 0; i < size; ++i) {
        corners.next.push_back(i);
        corners.previous.push_back(closed ? (i + 1) % size : i + 1);
    }
    for (int i = *rc::gen::element(0, 0, 1, 3); i > 0; --i) {
        const auto a = *rc::gen::inRange<std::uint32_t>(0, size + 2);
        corners.next.push_back(a);
        corners.previous.push_back((a + *rc::gen::inRange<std::uint32_t>(1, size + 2)) % (size + 2));
    }
    for (std::size_t i = corners.next.size(); *rc::gen::element(true, true, false) && i-- > 1;) {
        const auto j = *rc::gen::inRange<std::size_t>(0, i + 1);
        std::swap(corners.next[i], corners.next[j]);
        std::swap(corners.previous[i], corners.previous[j]);
    }
    return corners;
}

RC_GTEST_PROP(Fan, IsOneWhenPairingMakesOnePart, ()) {
    const Corners corners = randomCorners();
    Places places;
    Fan fan;
    bool known = true;
    for (std::size_t i = 0; i < corners.next.size(); ++i)
        known &= fan.add(corners.next[i], corners.previous[i], places.room);
    RC_TAG(known);
    if (known) RC_ASSERT(fan.isOne() == (countParts(corners) == 1));
}

bool listIsOneFan(const Corners& corners) {
    FanList list;
    list.clear();
    for (std::uint32_t i = 0; i < corners.next.size(); ++i) list.set(i, corners.next[i], corners.previous[i]);
    return isOneFan(list, static_cast<std::uint32_t>(corners.next.size()));
}

/// Each half-edge once, and one part.
bool isPlainFan(const Corners& corners) {
    const auto allDiffer = [](const std::vector<std::uint32_t>& of) {
        return std::set<std::uint32_t>(of.begin(), of.end()).size() == of.size();
    };
    return allDiffer(corners.next) && allDiffer(corners.previous) && countParts(corners) == 1;
}

RC_GTEST_PROP(FanList, IsOneFanWhenPairingMakesOnePartOfDifferentHalfEdges, ()) {
    const Corners corners = randomCorners();
    RC_PRE(corners.next.size() <= FanList::kMost);
    RC_TAG(isPlainFan(corners));
    RC_ASSERT(listIsOneFan(corners) == isPlainFan(corners));
}

TEST(FanList, KnowsAllFansOfUpToFourCornersWithFourNeighbours) {
    constexpr std::uint32_t kNeighbours = 4, kKinds = kNeighbours * (kNeighbours - 1);
    std::size_t fans = 0;
    for (std::size_t count = 1, ways = kKinds; count <= 4; ++count, ways *= kKinds) {
        for (std::size_t way = 0; way < ways; ++way) {
            Corners corners;
            for (std::size_t i = 0, left = way; i < count; ++i, left /= kKinds) {
                const auto next = static_cast<std::uint32_t>(left % kNeighbours),
                           further = static_cast<std::uint32_t>(left % kKinds / kNeighbours);
                corners.next.push_back(next);
                corners.previous.push_back((next + 1 + further) % kNeighbours);
            }
            ASSERT_EQ(listIsOneFan(corners), isPlainFan(corners)) << count << " corners, way " << way;
            fans += isPlainFan(corners) ? 1 : 0;
        }
    }
    // Rings: 6 of two corners, 8 of three, 6 of four. Paths: 12, 24 and 24. Each in any order.
    EXPECT_EQ(fans, 12u + 2u * (6 + 24) + 6u * (8 + 24) + 24u * 6);
}

TEST(FanList, KnowsRingsAndPathsOfEightInAnyOrder) {
    for (const std::uint32_t neighbours : {8u, 9u}) {
        std::uint32_t order[] = {0, 1, 2, 3, 4, 5, 6, 7};
        do {
            FanList list;
            list.clear();
            for (std::uint32_t i = 0; i < 8; ++i) list.set(i, order[i], (order[i] + 1) % neighbours);
            ASSERT_TRUE(isOneFan(list, 8));
        } while (std::next_permutation(std::begin(order), std::end(order)));
    }
}

TEST(FanList, HoldsTheDistancesThatItCanTellFromUnusedPlaces) {
    for (std::int32_t distance = -70000; distance <= 70000; ++distance) {
        const auto number = static_cast<std::uint32_t>(distance);
        ASSERT_EQ(FanList::holds(number), FanList::kLeast <= distance && distance <= FanList::kLargest);
        if (!FanList::holds(number)) continue;
        FanList list;
        list.clear();
        list.set(0, number, number);
        ASSERT_EQ(list.next[0], distance);
        ASSERT_EQ(list.previous[0], distance);
        ASSERT_NE(list.next[0], FanList::kNoPrevious);
        ASSERT_NE(list.previous[0], FanList::kNoNext);
    }
}

TEST(Fan, FollowsTrianglesInTheOrderOfAMesh) {
    Places places(0);
    Fan fan;
    EXPECT_TRUE(fan.isEmpty());
    // Two strips of three triangles around a node, as the rows of a grid bring them.
    const std::uint32_t next[] = {0, 1, 2, 5, 4, 3}, previous[] = {1, 2, 3, 0, 5, 4};
    for (int i = 0; i < 6; ++i) ASSERT_TRUE(fan.add(next[i], previous[i], places.room)) << i;
    EXPECT_TRUE(fan.isOne());
}

TEST(Fan, FollowsEightTrianglesInAnyOrder) {
    std::uint32_t order[] = {0, 1, 2, 3, 4, 5, 6, 7};
    do {
        Places places(1);
        Fan fan;
        bool known = true;
        for (const std::uint32_t i : order) known &= fan.add(i, (i + 1) % 8, places.room);
        ASSERT_TRUE(known && fan.isOne());
    } while (std::next_permutation(std::begin(order), std::end(order)));
}

TEST(Fan, GivesUpWhereAFifthPathBegins) {
    Places places;
    Fan fan;
    for (std::uint32_t i = 0; i < 4; ++i) EXPECT_TRUE(fan.add(2 * i, 2 * i + 1, places.room));
    EXPECT_FALSE(fan.add(8, 9, places.room));
}

TEST(Fan, GivesUpWhereNoRoomIsLeftForAThirdPath) {
    Places places(1);
    Fan first, second;
    for (std::uint32_t i = 0; i < 3; ++i) EXPECT_TRUE(first.add(2 * i, 2 * i + 1, places.room));
    for (std::uint32_t i = 0; i < 2; ++i) EXPECT_TRUE(second.add(2 * i, 2 * i + 1, places.room));
    EXPECT_TRUE(first.add(1, 2, places.room));   // two paths become one, and the place is free again
    EXPECT_TRUE(second.add(4, 5, places.room));  // takes it
    EXPECT_FALSE(first.add(10, 11, places.room));
}

}  // namespace
}  // namespace tspace::mikk
