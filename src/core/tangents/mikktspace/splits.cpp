// SPDX-License-Identifier: MIT
// The angular threshold: quick tests that nothing splits, and the comparison of all members with all.
#include "core/tangents/mikktspace/splits.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/float4.h"
#include "core/tangents/mikktspace/results.h"

namespace tspace::mikk {

namespace {

/// Margins far above the rounding of a projection and three dot products: the sine of an angle from a plane, and a difference
/// of cosines.
constexpr float kOffPlane = 0.02f, kMargin = 1e-3f;
constexpr float kLeastWeight = 1e-4f;    // below, rounding decides the direction of a corner's row
constexpr std::size_t kFewMembers = 64;  // largest group of which the quick test compares all pairs

/// If all members lie within half the threshold of one direction, all pairs are within the threshold: the cosine of the
/// half angle is sqrt((1 + c) / 2).
float halfAngleLimit(float threshold_cosine) { return std::sqrt((1.0f + threshold_cosine) * 0.5f) + kOffPlane; }

/// Whether all members lie near the direction of their sum.
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

/// Whether all pairs of at most kFewMembers are well within the threshold.
bool areNearEachOther(Members members, float limit) {
    const float *s[kFewMembers], *t[kFewMembers];
    std::size_t count = 0;
    for (const NodeCorner& corner : members) {
        if (corner.facing == 0) continue;
        const float* const row = s[count] = corner.s;
        const float* const row_t = t[count] = corner.t();
        if (!(row[3] > kLeastWeight)) return false;
        for (std::size_t j = 0; j < count; ++j) {
            const float least = limit * row[3] * s[j][3];
            if (!(dot(vectorOf(row), vectorOf(s[j])) > least && dot(vectorOf(row_t), vectorOf(t[j])) > least))
                return false;
        }
        ++count;
    }
    return true;
}

/// Directions of dP/du and dP/dv (zero when they have none).
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

/// Taylor series; |r| <= pi/4 leaves an error below 2^-56.
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

/// Without the C library, so that it has the same bits everywhere. Based on: Cody and Waite, "Software Manual for the
/// Elementary Functions", 1980: pi/2 in two parts, so that what is taken away from the angle is exact.
float thresholdCosine(float degrees) {
    if (degrees == 180.0f) return -1.0f;  // the default; the formula below gives this value too
    const double angle = std::fabs((degrees * 3.14159274f) / 180.0f);
    if (!(angle < 1e6)) return std::nanf("");  // no two directions are within it
    const auto quarter_turns = static_cast<unsigned>(angle * 0x1.45f306dc9c883p-1 + 0.5);
    const double r = (angle - quarter_turns * 0x1.921fb544p+0) - quarter_turns * 0x1.0b4611a626331p-34;
    return static_cast<float>(std::array{cosine(r), -sine(r), -cosine(r), sine(r)}[quarter_turns % 4]);
}

bool areTogether(Members members, float threshold_cosine) {
    if (members.size() <= 1) return true;
    const float near = threshold_cosine + kMargin;
    if (members.size() <= 4) return areNearEachOther(members, near);
    return areNearSum(members, halfAngleLimit(threshold_cosine)) ||
           (members.size() <= kFewMembers && areNearEachOther(members, near));
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

/// For groups above kLargestSplitGroup: whether all members lie near their mean direction.
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
    if (directions_.size() < count) directions_ = Buffer<Direction>(allocator_, std::max<std::size_t>(count, 64));
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
            if (members[b].facing == 0) continue;  // it adds nothing to any subset
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
