// SPDX-License-Identifier: MIT
// Implementation of grouping: links, groups, and contested triangles. groups.h has the proofs.
#include "core/tangents/mikktspace/groups.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "core/base/sort.h"
#include "core/base/vec_math.h"
#include "core/tangents/mikktspace/evaluate.h"
#include "core/tangents/mikktspace/node_sums.h"

namespace tspace::mikk {
namespace {

/// Returns whether the links between the corners form a single path or ring, without ambiguity.
bool areOneFan(std::span<const NodeCorner> around) {
    ManyPaths place;
    FanPool room(&place);
    Fan fan;
    for (const NodeCorner& corner : around) fan.add(corner.next, corner.previous, room);
    return fan.isOne();
}

/// Extends a group from its first corner in both directions. joins(i): returns whether corner i may join the group.
template <class Joins>
void spread(std::uint32_t seed, const CornerLinks& links, std::uint32_t* group, const Joins& joins) {
    for (const std::uint32_t* link : {links.left, links.right}) {
        for (std::uint32_t m = link[seed]; m != kNone && group[m] == kNone && joins(m); m = link[m])
            group[m] = group[seed];
    }
}

}  // namespace

/// Sorts half-edges by neighbor, in the high word of the key, and then by corner: the low word is 2 * corner, plus 1
/// for the outgoing edge. All waiting half-edges of one neighbor have the same direction, so the oldest is the partner
/// of the next opposite one.
void linkCorners(std::span<const NodeCorner> around, const CornerLinks& links, std::uint64_t* half_edges) {
    const std::size_t count = 2 * around.size();
    for (std::size_t i = 0; i < around.size(); ++i) {
        links.left[i] = links.right[i] = kNone;
        half_edges[2 * i] = std::uint64_t{around[i].previous} << 32 | 2 * i;
        half_edges[2 * i + 1] = std::uint64_t{around[i].next} << 32 | (2 * i + 1);
    }
    sortList(half_edges, half_edges + count, std::less<>());
    const auto linkOf = [&](std::size_t i) -> std::uint32_t& {
        const auto half_edge = static_cast<std::uint32_t>(half_edges[i]);
        return ((half_edge & 1) != 0 ? links.left : links.right)[half_edge / 2];
    };
    const auto cornerOf = [&](std::size_t i) { return static_cast<std::uint32_t>(half_edges[i]) / 2; };
    for (std::size_t i = 0, oldest = 0; i < count; ++i) {
        while (oldest < i && (half_edges[oldest] >> 32 != half_edges[i] >> 32 || linkOf(oldest) != kNone)) ++oldest;
        if (((half_edges[oldest] ^ half_edges[i]) & 1) == 0) continue;
        linkOf(oldest) = cornerOf(i);
        linkOf(i) = cornerOf(oldest);
    }
}

Grouping::Grouping(const VertexPath& path, VertexCorners& corners)
    : chosen_(path.chosen), bucket_(path.setting.bucket), corners_(corners),
      contested_(path.setting.options.execution.allocator) {
    const Allocator* allocator = path.setting.options.execution.allocator;
    std::size_t largest = 0;
    for (std::size_t place = 0; place < chosen_.size(); ++place)
        largest = std::max(largest, corners.around(place).size());
    scratch_ = Buffer<std::uint32_t>(allocator, 3 * largest);
    half_edges_ = Buffer<std::uint64_t>(allocator, 2 * largest);
    if (corners.report.degenerate_uv_count == 0) return;
    findContested(allocator);
    if (!contested_.empty()) spreadContested(allocator);
}

/// Groups the corners of a node. If no triangle of the node is contested, triangles without UV area join any group.
NodeGroups Grouping::groupsOf(std::size_t place) {
    const std::span<const NodeCorner> around = corners_.around(place);
    if (!contested_of_.empty() && contested_of_[place] != kNone) {
        const Contested& contested = contested_[contested_of_[place]];
        return {around, contested_groups_.data() + contested.begin, contested.group_count};
    }
    const std::uint8_t facing = corners_.facing[place];
    if (facing != kFacing) {
        if (facing == 0) return {around, nullptr, 0};
        if (!bucket_.concerns(chosen_[place]) && areOneFan(around)) return {around, nullptr, 1};
    }
    const auto count = static_cast<std::uint32_t>(around.size());
    std::uint32_t* const group = scratch_.data();
    const CornerLinks links{group + count, group + 2 * std::size_t{count}};
    link(place, links);
    std::fill_n(group, count, kNone);
    std::uint32_t groups = 0;
    for (std::uint32_t seed = 0; seed < count; ++seed) {
        if (around[seed].facing == 0 || group[seed] != kNone) continue;
        group[seed] = groups++;
        const std::uint32_t opposite = around[seed].facing ^ kFacing;
        spread(seed, links, group, [&](std::uint32_t m) { return around[m].facing != opposite; });
    }
    return {around, group, groups};
}

void Grouping::link(std::size_t place, const CornerLinks& links) {
    const std::span<const NodeCorner> around = corners_.around(place);
    linkCorners(around, links, half_edges_.data());
    if (bucket_.concerns(chosen_[place])) applyBucket(around, links);
}

/// Replaces the links of half-edges that the reference pairs differently (last_bucket.h).
void Grouping::applyBucket(std::span<const NodeCorner> around, const CornerLinks& links) const {
    const auto turn = [](std::uint32_t half_edge, std::uint32_t by) {
        return half_edge / 3 * 3 + (half_edge + by) % 3;
    };
    const auto placeOf = [&](std::uint32_t half_edge) {
        const auto at = std::lower_bound(
            around.begin(), around.end(), half_edge,
            [&](const NodeCorner& corner, std::uint32_t h) { return corners_.halfEdgeOf(corner.half_edge) < h; });
        return static_cast<std::uint32_t>(at - around.begin());
    };
    for (std::size_t i = 0; i < around.size(); ++i) {
        const std::uint32_t h = corners_.halfEdgeOf(around[i].half_edge);
        // A partner has the opposite direction: the partner of the outgoing edge ends at the node, and the partner of
        // the incoming edge starts there.
        if (const std::uint32_t* partner = bucket_.partnerOf(h))
            links.left[i] = *partner == kNone ? kNone : placeOf(turn(*partner, 1));
        if (const std::uint32_t* partner = bucket_.partnerOf(turn(h, 2)))
            links.right[i] = *partner == kNone ? kNone : placeOf(*partner);
    }
}

/// Marks contested triangles and their nodes. If a node of such a triangle is not selected, it has no groups, or its
/// triangles are known to have equal orientations.
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
        if (facing != kFacing) continue;
        if (contested_of_.empty()) contested_of_ = Buffer<std::uint32_t>(allocator, chosen_.size() + 1, kNone);
        corners_.flags[t] |= kContested;
        for (std::size_t k = 0; k < 3; ++k) add(places[k]);
    }
}

/// Groups the nodes of contested triangles: first links their corners, then processes all triangles in the reference's
/// order. Each node has a cursor that moves along its corners.
void Grouping::spreadContested(const Allocator* allocator) {
    std::size_t size = 0;
    for (Contested& node : contested_) {
        node.begin = size;
        size += corners_.around(node.place).size();
    }
    contested_groups_ = Buffer<std::uint32_t>(allocator, size, kNone);
    Buffer<std::uint32_t> left(allocator, size), right(allocator, size);
    for (const Contested& node : contested_) link(node.place, {left.data() + node.begin, right.data() + node.begin});
    const auto spreadFrom = [&](Contested& node, std::uint32_t flags) {
        const std::uint32_t seed = node.cursor++;
        std::uint32_t* const group = contested_groups_.data() + node.begin;
        if ((flags & kAny) != 0 || group[seed] != kNone) return;
        group[seed] = node.group_count++;
        const NodeCorner* const around = corners_.around(node.place).data();
        spread(seed, {left.data() + node.begin, right.data() + node.begin}, group,
               [&](std::uint32_t m) { return joinsContested(around[m].half_edge / 3, flags & kFacing); });
    };
    for (std::size_t t = 0; t < corners_.flags.size(); ++t) {
        if ((corners_.flags[t] & kDegenerate) != 0) continue;
        const std::uint32_t* places = corners_.placesOf(t);
        for (std::size_t k = 0; k < 3; ++k) {
            if (contested_of_[places[k]] != kNone) spreadFrom(contested_[contested_of_[places[k]]], corners_.flags[t]);
        }
    }
}

/// Returns whether a triangle joins a group of orientation `facing`. A triangle with UV area needs this orientation.
/// One without joins any group; if it is contested, it adopts the orientation of the first group that reaches it.
bool Grouping::joinsContested(std::uint32_t triangle, std::uint32_t facing) {
    std::uint8_t& flags = corners_.flags[triangle];
    if ((flags & (kAny | kContested)) == kAny) return true;
    if ((flags & kFacing) == 0) flags = static_cast<std::uint8_t>(flags | facing);
    return (flags & kFacing) == facing;
}

// Angular threshold: a fast test which proves that nothing splits, and the comparison of all pairs of members.

namespace {

/// Margin of the fast test, far above the rounding of a projection and three dot products: the sine of an angle to a
/// plane.
constexpr float kOffPlane = 0.02f;
// minimum weight: below it, rounding determines the direction of a corner's row
constexpr float kLeastWeight = 1e-4f;

/// Returns the minimum cosine between a member and the common direction. If all members are within half the threshold
/// of one direction, all pairs are within the threshold. The cosine of the half angle is sqrt((1 + c) / 2).
float halfAngleLimit(float threshold_cosine) { return std::sqrt((1.0f + threshold_cosine) * 0.5f) + kOffPlane; }

/// Returns whether all members are close to the direction of their sum.
bool areNearSum(Members members, float limit) {
    Float4 s{}, t{};
    for (const NodeCorner& corner : members) {
        if (corner.facing == 0) continue;
        s += loadFloat4(corner.s);
        t += loadFloat4(corner.t());
    }
    const Vec3 sum_s = vectorOf(s), sum_t = vectorOf(t);
    const float limit_s = limit * length(sum_s), limit_t = limit * length(sum_t);
    return std::all_of(members.begin(), members.end(), [&](const NodeCorner& corner) {
        if (corner.facing == 0) return true;
        const float *row = corner.s, weight = row[3];
        return weight > kLeastWeight && dot(sum_s, vectorOf(row)) > weight * limit_s &&
               dot(sum_t, vectorOf(corner.t())) > weight * limit_t;
    });
}

/// Computes the unit directions of dP/du and dP/dv, or zero for one that has no direction.
void triangleDirections(const Vec3 (&p)[3], const Vec2 (&uv)[3], Vec3& s, Vec3& t) {
    const Vec2 a = uv[1] - uv[0], b = uv[2] - uv[0];
    const Vec3 d1 = p[1] - p[0], d2 = p[2] - p[0];
    const float area = a.x * b.y - a.y * b.x;
    s = t = {};
    if (!notZero(area)) return;
    const float facing = area > 0.0f ? 1.0f : -1.0f;
    const Vec3 along_u = b.y * d1 - a.y * d2, along_v = (-b.x) * d1 + a.x * d2;
    const float length_s = length(along_u), length_t = length(along_v);
    if (notZero(length_s)) s = (facing / length_s) * along_u;
    if (notZero(length_t)) t = (facing / length_t) * along_v;
}

/// Computes the sine by its Taylor series; for |r| <= pi/4 the error is below 2^-56.
double sine(double r) {
    const double z = r * r;
    double p = 1.0 / 355687428096000.0;
    for (const double c : {-1.0 / 1307674368000.0, 1.0 / 6227020800.0, -1.0 / 39916800.0, 1.0 / 362880.0, -1.0 / 5040.0,
                           1.0 / 120.0, -1.0 / 6.0}) {
        p = p * z + c;
    }
    return r + r * z * p;
}

double cosine(double r) {
    const double z = r * r;
    double p = 1.0 / 20922789888000.0;
    for (const double c :
         {-1.0 / 87178291200.0, 1.0 / 479001600.0, -1.0 / 3628800.0, 1.0 / 40320.0, -1.0 / 720.0, 1.0 / 24.0, -0.5}) {
        p = p * z + c;
    }
    return 1.0 + z * p;
}

}  // namespace

/// Computes the cosine without the C library, so that it has the same bits everywhere.
/// Based on: Cody and Waite, "Software Manual for the Elementary Functions", 1980: pi/2 as two summands, so that the
/// subtraction from the angle is exact.
float thresholdCosine(float degrees) {
    if (degrees == 180.0f) return -1.0f;  // the default, for which the formula below gives the same value
    const double angle = std::fabs((degrees * 3.14159274f) / 180.0f);
    if (!(angle < 1e6)) return std::nanf("");  // no two directions are within such a threshold
    const auto quarter_turns = static_cast<unsigned>(angle * 0x1.45f306dc9c883p-1 + 0.5);
    const double r = (angle - quarter_turns * 0x1.921fb544p+0) - quarter_turns * 0x1.0b4611a626331p-34;
    return static_cast<float>(std::array{cosine(r), -sine(r), -cosine(r), sine(r)}[quarter_turns % 4]);
}

bool areTogether(Members members, float threshold_cosine) {
    return members.size() <= 1 || areNearSum(members, halfAngleLimit(threshold_cosine));
}

SplitFinder::SplitFinder(const WeldedMesh& welded, const VertexCorners& corners, float threshold_cosine,
                         const Allocator* allocator)
    : rows(allocator), in_(welded), corners_(corners), cosine_(threshold_cosine), allocator_(allocator) {}

SplitFinder::Direction SplitFinder::directionOf(const NodeCorner& corner, const Vec3& normal) const {
    Vec3 p[3];
    Vec2 uv[3];
    const std::size_t triangle = corner.half_edge / 3;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = in_.nodes.vertex(corners_.nodes[3 * triangle + k]);
        p[k] = in_.mesh.positions[vertex];
        uv[k] = in_.mesh.uvs[vertex];
    }
    Direction direction;
    triangleDirections(p, uv, direction.s, direction.t);
    return {flatten(normal, direction.s), flatten(normal, direction.t)};
}

/// Returns, for groups above kLargestSplitGroup, whether all members are close to their mean direction.
bool SplitFinder::isNarrow(Members members) const {
    Vec3 s, t;
    const auto forEach = [&](const auto& body) {
        for (std::size_t i = 0; i < members.size(); ++i) {
            if (members[i].facing != 0) body(directions_[i]);
        }
    };
    forEach([&](const Direction& d) {
        s = s + d.s;
        t = t + d.t;
    });
    s = unit(s);
    t = unit(t);
    const float limit = halfAngleLimit(cosine_);
    bool narrow = true;
    forEach([&](const Direction& d) { narrow &= dot(s, d.s) > limit && dot(t, d.t) > limit; });
    return narrow;
}

bool SplitFinder::splits(Members members, const Vec3& normal) {
    const auto count = static_cast<std::uint32_t>(members.size());
    if (directions_.size() < count) directions_ = Buffer<Direction>(allocator_, 2 * std::size_t{count});
    for (std::uint32_t i = 0; i < count; ++i) directions_[i] = directionOf(members[i], normal);
    if (count > kLargestSplitGroup) {
        abandoned |= !isNarrow(members);
        return false;
    }
    const std::size_t words = (std::size_t{count} + 63) / 64;
    std::uint64_t* const first_row = rows.extend(words * count);
    std::fill_n(first_row, words * count, std::uint64_t{0});
    const auto face = [&](std::size_t i) { return in_.triangles.face(corners_.triangleOf(members[i].half_edge / 3)); };
    bool whole = true;
    for (std::uint32_t a = 0; a < count; ++a) {
        const Direction& da = directions_[a];
        for (std::uint32_t b = 0; b < count; ++b) {
            if (members[b].facing == 0) continue;  // this member contributes to no subset
            const Direction& db = directions_[b];
            const bool together = members[a].facing == 0 || (dot(da.s, db.s) > cosine_ && dot(da.t, db.t) > cosine_) ||
                                  face(a) == face(b);
            if (together) first_row[a * words + b / 64] |= std::uint64_t{1} << (b % 64);
            whole &= together;
        }
    }
    if (whole) rows.drop(words * count);
    return !whole;
}

}  // namespace tspace::mikk
