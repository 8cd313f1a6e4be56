// SPDX-License-Identifier: MIT
// Following a fan by its open ends must give the same result as pairing all of its half-edges.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <vector>

#include "core/tangents/mikktspace/groups.h"
#include "core/tangents/mikktspace/node_sums.h"

namespace tspace::mikk {
namespace {

struct Corners {
    std::vector<std::uint32_t> next, previous;
};

std::vector<NodeCorner> around(const Corners& corners) {
    std::vector<NodeCorner> around(corners.next.size());
    for (std::size_t i = 0; i < around.size(); ++i)
        around[i] = {nullptr, static_cast<std::uint32_t>(i), corners.next[i], corners.previous[i], kFacesUp};
    return around;
}

/// Links the corners of a node by comparing all pairs.
void linkByPairs(std::span<const NodeCorner> around, const CornerLinks& links) {
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

/// Returns the number of components that are connected by the links between the corners.
std::size_t countParts(const Corners& corners) {
    const auto count = static_cast<std::uint32_t>(corners.next.size());
    std::vector<std::uint32_t> left(count), right(count), part(count, kNone);
    linkByPairs(around(corners), {left.data(), right.data()});
    std::size_t parts = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (part[i] != kNone) continue;
        ++parts;
        for (std::uint32_t m = i; m != kNone && part[m] == kNone; m = left[m]) part[m] = 1;
        for (std::uint32_t m = right[i]; m != kNone && part[m] == kNone; m = right[m]) part[m] = 1;
    }
    return parts;
}

/// Returns the corners of a ring or path in random order, with some additional corners that do not fit.
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

bool isFoundOne(const Corners& corners) {
    ManyPaths place;
    FanPool room(&place);
    Fan fan;
    for (std::size_t i = 0; i < corners.next.size(); ++i) fan.add(corners.next[i], corners.previous[i], room);
    return fan.isOne();
}

/// Returns whether each half-edge occurs once, and there is one component.
bool isPlainFan(const Corners& corners) {
    const auto allDiffer = [](const std::vector<std::uint32_t>& of) {
        return std::set<std::uint32_t>(of.begin(), of.end()).size() == of.size();
    };
    return allDiffer(corners.next) && allDiffer(corners.previous) && countParts(corners) == 1;
}

RC_GTEST_PROP(Fan, IsOneOnlyWherePairingMakesOnePart, ()) {
    const Corners corners = randomCorners();
    const bool found = isFoundOne(corners);
    RC_TAG(found);
    if (found) RC_ASSERT(countParts(corners) == 1u);
    // With more corners, there may be more paths than fit into the fixed space.
    if (corners.next.size() <= 8 && isPlainFan(corners)) RC_ASSERT(found);
}

RC_GTEST_PROP(Links, AreThoseOfComparingAllPairs, ()) {
    Corners corners = randomCorners(), more = randomCorners();
    corners.next.insert(corners.next.end(), more.next.begin(), more.next.end());
    corners.previous.insert(corners.previous.end(), more.previous.begin(), more.previous.end());
    const std::size_t count = corners.next.size();
    std::vector<std::uint32_t> left(count), right(count), sorted_left(count), sorted_right(count);
    std::vector<std::uint64_t> half_edges(2 * count);
    linkByPairs(around(corners), {left.data(), right.data()});
    linkCorners(around(corners), {sorted_left.data(), sorted_right.data()}, half_edges.data());
    RC_ASSERT(left == sorted_left);
    RC_ASSERT(right == sorted_right);
}

TEST(Fan, KnowsAllFansOfUpToFourCornersWithFourNeighbors) {
    constexpr std::uint32_t kNeighbors = 4, kKinds = kNeighbors * (kNeighbors - 1);
    std::size_t fans = 0;
    for (std::size_t count = 1, ways = kKinds; count <= 4; ++count, ways *= kKinds) {
        for (std::size_t way = 0; way < ways; ++way) {
            Corners corners;
            for (std::size_t i = 0, left = way; i < count; ++i, left /= kKinds) {
                const auto next = static_cast<std::uint32_t>(left % kNeighbors),
                           further = static_cast<std::uint32_t>(left % kKinds / kNeighbors);
                corners.next.push_back(next);
                corners.previous.push_back((next + 1 + further) % kNeighbors);
            }
            const bool found = isFoundOne(corners), is_plain = isPlainFan(corners);
            ASSERT_TRUE(found || !is_plain) << count << " corners, way " << way;
            ASSERT_TRUE(!found || countParts(corners) == 1) << count << " corners, way " << way;
            fans += is_plain ? 1 : 0;
        }
    }
    // There are 6 rings of two corners, 8 of three and 6 of four, and 12, 24 and 24 paths; all of them in any order.
    EXPECT_EQ(fans, 12u + 2u * (6 + 24) + 6u * (8 + 24) + 24u * 6);
}

TEST(Fan, KnowsRingsAndPathsOfEightInAnyOrder) {
    for (const std::uint32_t neighbors : {8u, 9u}) {
        std::uint32_t order[] = {0, 1, 2, 3, 4, 5, 6, 7};
        do {
            ManyPaths place;
            FanPool room(&place);
            Fan fan;
            for (const std::uint32_t i : order) fan.add(i, (i + 1) % neighbors, room);
            ASSERT_TRUE(fan.isOne());
        } while (std::next_permutation(std::begin(order), std::end(order)));
    }
}

TEST(Fan, FollowsTrianglesInTheOrderOfAMesh) {
    ManyPaths place;
    FanPool room(&place);
    Fan fan;
    EXPECT_FALSE(fan.isOne());
    // A node between two strips of three triangles, in the order of a grid's rows.
    const std::uint32_t next[] = {0, 1, 2, 5, 4, 3}, previous[] = {1, 2, 3, 0, 5, 4};
    for (int i = 0; i < 6; ++i) fan.add(next[i], previous[i], room);
    EXPECT_TRUE(fan.isOne());
}

/// Returns whether a ring is detected if first every second triangle is added, and then the others.
bool isRingFound(std::uint32_t size) {
    ManyPaths place;
    FanPool room(&place);
    Fan fan;
    for (std::uint32_t first : {0u, 1u}) {
        for (std::uint32_t i = first; i < size; i += 2) fan.add(i, (i + 1) % size, room);
    }
    return fan.isOne();
}

TEST(Fan, GivesUpWhereAFifthPathBegins) {
    for (const std::uint32_t size : {2u, 4u, 6u, 8u}) EXPECT_TRUE(isRingFound(size)) << size;
    EXPECT_FALSE(isRingFound(10));
}

TEST(Fan, GivesItsPlaceBackWhereTwoPathsAreLeft) {
    ManyPaths places[3] = {};
    FanPool room(places);
    Fan fans[3];
    for (std::uint32_t i = 0; i < 3; ++i) {
        for (Fan* fan : {&fans[0], &fans[1]}) fan->add(2 * i, 2 * i + 1, room);
    }
    fans[0].add(1, 2, room);
    for (const std::uint32_t i : {0u, 2u, 4u, 1u, 3u, 5u}) fans[2].add(i, (i + 1) % 6, room);
    EXPECT_TRUE(fans[2].isOne());
    fans[0].add(3, 4, room);
    for (const std::uint32_t i : {1u, 3u}) fans[1].add(i, i + 1, room);
    EXPECT_TRUE(fans[0].isOne());
    EXPECT_TRUE(fans[1].isOne());
    EXPECT_EQ(places[2].paths[0].leaves, 0u);  // its space is not used
}

TEST(Fan, StaysComplexOnceTwoWaitForOneNeighbor) {
    ManyPaths place;
    FanPool room(&place);
    Fan fan;
    fan.add(0, 1, room);
    fan.add(0, 2, room);
    fan.add(3, 0, room);
    fan.add(2, 3, room);
    EXPECT_FALSE(fan.isOne());
}

}  // namespace
}  // namespace tspace::mikk
