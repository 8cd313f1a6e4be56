// SPDX-License-Identifier: MIT
// Groups and results of one node, as groups.cpp and evaluate.cpp make them, but without a plan in between.
#include "tangents/mikktspace/node_groups.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#include "tangents/mikktspace/corner_source.h"
#include "tangents/mikktspace/triangle_pass.h"

namespace tspace::mikk {

namespace {

/// Sine of the angle that vectors must keep from a plane: far more than rounding errors.
constexpr float kOffPlane = 0.02f;
constexpr float kLeastWeight = 1e-4f;  // below, a corner says too little about its direction
/// Cosine of an angle of about 177 degrees. Rounding errors of the products are far below what is missing to
/// 180.
constexpr float kNotOpposed = -0.999f;
constexpr std::uint32_t kFewMembers = 3;  // all pairs of so few are compared at once

Vec3 vectorOf(const float* row) { return {row[0], row[1], row[2]}; }
Vec3 vectorOf(Float4 row) { return {row[0], row[1], row[2]}; }

/// Whether it is plain that neither the tangents nor the bitangents of two corners have opposite directions.
bool farFromOpposed(const UnclearCorner& a, const UnclearCorner& b) {
    const float weight = a.s[3], other = b.s[3], limit = kNotOpposed * weight * other;
    return (int{weight > kLeastWeight} & int{other > kLeastWeight} &
            int{dot(vectorOf(a.s), vectorOf(b.s)) > limit} &
            int{dot(vectorOf(a.t), vectorOf(b.t)) > limit}) != 0;
}

}  // namespace

NodeGroups::NodeGroups(const MeshView& mesh, const TangentOptions& options, const TriangleList& triangles,
                       const Nodes& nodes, std::span<const std::uint32_t> chosen, const TangentOutput& out,
                       const UnclearCorners& corners)
    : mesh_(mesh),
      triangles_(triangles),
      nodes_(nodes),
      chosen_(chosen),
      out_(out),
      sink_(out, signFactor(options.convention) * normalFactor(options.convention),
            signFactor(options.convention)),
      corners_(corners),
      may_split_(options.method == Method::mikktspace),
      has_polygons_(!triangles.faces.empty()),
      tangents_only_(wantsTangentsOnly(out)),
      full_(has_polygons_ || !tangents_only_) {}

Links::Links(std::span<const UnclearCorner> around) {
    if (!linkUnambiguous(around)) linkAny(around);
    one_path = isOnePath(around.size());
}

/// Where each half-edge has one possible partner at most, that is the one. Returns false where there is a
/// choice, or too many members.
bool Links::linkUnambiguous(std::span<const UnclearCorner> around) {
    constexpr std::size_t kMost = 16;
    const std::size_t count = around.size();
    if (count > kMost) return false;
    alignas(16) std::uint32_t previous[kMost];
    for (std::size_t i = 0; i < count; ++i) {
        previous[i] = around[i].previous;
        right[i] = kNoLink;
    }
    std::size_t lanes = count;
    for (; lanes % 4 != 0; ++lanes) previous[lanes] = kNone;
    std::uint32_t taken = 0, again = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const auto next = static_cast<std::int32_t>(around[i].next);
        const Mask4 wanted = Mask4{next, next, next, next};
        std::uint32_t found = 0;
        for (std::size_t j = 0; j < lanes; j += 4) {
            Mask4 here;
            std::memcpy(&here, previous + j, sizeof here);
            found |= laneBits(here == wanted) << j;
        }
        again |= (found & taken) | (found & (found - 1));
        taken |= found;
        const auto partner = static_cast<std::uint8_t>(found == 0 ? int{kNoLink} : std::countr_zero(found));
        left[i] = partner;
        right[partner] = static_cast<std::uint8_t>(i);
    }
    return again == 0;
}

void Links::linkAny(std::span<const UnclearCorner> around) {
    std::uint32_t next[kSmallNode], previous[kSmallNode], to_left[kSmallNode], to_right[kSmallNode];
    const auto count = static_cast<std::uint32_t>(around.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        next[i] = around[i].next;
        previous[i] = around[i].previous;
    }
    Around all{count, nullptr, next, previous, to_left, to_right};
    pairSmall(all);
    for (std::uint32_t i = 0; i < count; ++i) {
        left[i] = to_left[i] == kNone ? kNoLink : static_cast<std::uint8_t>(to_left[i]);
        right[i] = to_right[i] == kNone ? kNoLink : static_cast<std::uint8_t>(to_right[i]);
    }
}

bool Links::isOnePath(std::size_t count) const {
    std::uint8_t start = 0;
    while (start < count && right[start] != kNoLink) ++start;
    if (start == count) start = 0;  // rings only
    std::size_t reached = 1;
    for (std::uint8_t m = left[start]; m != kNoLink && m != start; m = left[m]) ++reached;
    return reached == count;
}

NodeState NodeGroups::walk(std::size_t place, WalkCounts& counts) const {
    const std::span<const UnclearCorner> around = corners_.around(place);
    const bool copies_elsewhere =
        !corners_.entangled.empty() && corners_.entangled[place] == UnclearCorners::kOtherNode;
    if (around.size() > kSmallNode || copies_elsewhere) return kLeft;
    if (around.empty()) return kDone;
    Sum sum;
    for (const UnclearCorner& corner : around) sum.add(corner);
    if (sum.adding == 0 && !(has_polygons_ && repeatsApart(around))) return writeDefaults(around, counts);
    const std::uint32_t facing = sum.common & (kIsUp | kIsDown);
    sum.positive = (facing & kIsUp) != 0;
    if (around.size() == 1) return finishOneGroup(place, around, sum, counts);
    // The usual case: one fan of one orientation, and nothing else to see to.
    const Links links(around);
    if (links.one_path && facing != 0 && sum.adding != 0) return finishOneGroup(place, around, sum, counts);
    Members members(around);
    formGroups(members, links);
    return finish(place, members, counts);
}

/// Of a node without groups. Corners of a polygon's triangles that are one corner of the mesh are neighbours.
NodeState NodeGroups::writeDefaults(std::span<const UnclearCorner> around, WalkCounts& counts) const {
    std::uint32_t before = kNone;
    for (const UnclearCorner& corner : around) {
        if (corner.slot == before) continue;
        before = corner.slot;
        writeOne(before, Tangents{});
        ++counts.defaults;
    }
    return kFirstIsDefault;
}

NodeState NodeGroups::finishOneGroup(std::size_t place, std::span<const UnclearCorner> around, const Sum& sum,
                                     WalkCounts& counts) const {
    if (may_split_ && sum.adding > 1 && splits(place, sum, around, [](std::size_t) { return true; }))
        return kLeft;
    if (!tangents_only_) {
        const Tangents result = resultOf(sum);
        if (!isSound(result)) return kLeft;
        for (const UnclearCorner& corner : around) sink_.write(corner.slot, result);
    } else {
        const Vec3 s = unit(vectorOf(sum.s));
        if (has_polygons_ && !restIsSound(sum) ? !isSound(resultOf(sum))
                                               : !isFinite(s) || !(may_split_ || notZero(s)))
            return kLeft;
        const Vec4 tangent{s.x, s.y, s.z, sink_.sign(sum.positive)};
        for (const UnclearCorner& corner : around) out_.tangents[corner.slot] = tangent;
    }
    ++counts.groups;
    return kDone;
}

/// Whether it is plain that a result's bitangent and lengths are no NaN: all members have finite lengths and
/// weights.
bool NodeGroups::restIsSound(const Sum& sum) {
    const Vec3 t = vectorOf(sum.t);
    const float square = dot(t, t);
    return (sum.common & (kFacesUp | kFacesDown)) != 0 && square > 0 &&
           square < std::numeric_limits<float>::infinity();
}

bool NodeGroups::isSound(const Tangents& result) const {
    return isFinite(result.s) && (!has_polygons_ || sameResult(result, result)) &&
           (may_split_ || notZero(result.s));
}

/// Groups of a node without contested triangles: those without UV area join any.
void NodeGroups::formGroups(Members& members, const Links& links) {
    const std::uint32_t count = members.count();
    std::fill_n(members.group, count, kNoGroup);
    for (std::uint32_t seed = 0; seed < count; ++seed) {
        const std::uint32_t flags = members.corners[seed].flags;
        if ((flags & kAny) != 0 || members.group[seed] != kNoGroup) continue;
        const auto group = static_cast<std::uint8_t>(members.group_count++);
        members.group[seed] = group;
        for (const std::uint8_t* to : {links.left, links.right}) {
            for (std::uint8_t m = to[seed]; m != Links::kNoLink && members.group[m] == kNoGroup; m = to[m]) {
                const std::uint32_t other = members.corners[m].flags;
                if ((other & kAny) == 0 && ((other ^ flags) & kPositive) != 0) break;
                members.group[m] = group;
            }
        }
    }
}

NodeState NodeGroups::finish(std::size_t place, const Members& members, WalkCounts& counts) const {
    return members.group_count <= 2   ? finishGroups<2>(place, members, counts)
           : members.group_count <= 8 ? finishGroups<8>(place, members, counts)
                                      : finishGroups<kSmallNode>(place, members, counts);
}

template <std::size_t kMost>
NodeState NodeGroups::finishGroups(std::size_t place, const Members& members, WalkCounts& counts) const {
    if (has_polygons_ && repeatsApart(members.corners)) return kLeft;
    if (isEntangled(place, members)) return kLeft;
    Sum sums[kMost];
    Tangents results[kMost];
    for (std::uint32_t i = 0; i < members.count(); ++i) {
        const UnclearCorner& corner = members.corners[i];
        if (members.group[i] == kNoGroup || (corner.flags & kAny) != 0) continue;
        Sum& sum = sums[members.group[i]];
        sum.positive = (corner.flags & kPositive) != 0;
        sum.add(corner);
    }
    for (std::uint32_t g = 0; g < members.group_count; ++g) {
        const auto isMember = [&](std::size_t i) { return members.group[i] == g; };
        if (may_split_ && sums[g].adding > 1 && splits(place, sums[g], members.corners, isMember))
            return kLeft;
        results[g] = resultOf(sums[g]);
        if (!isSound(results[g])) return kLeft;
    }
    counts.groups += members.group_count;
    return write(members, results, counts);
}

/// The angular test. Nearly all groups keep together: their sum shows it, or all members keep to one side of
/// the planes across their sums, or no two come near opposite directions. Of others all pairs are compared as
/// the reference does.
template <class IsMember>
bool NodeGroups::splits(std::size_t place, const Sum& sum, std::span<const UnclearCorner> around,
                        const IsMember& isMember) const {
    const Vec3& normal = normalOf(place);
    const bool few = sum.adding <= kFewMembers;
    float sum_s[4];
    storeFloat4(sum_s, sum.s);
    if (!few && sumCannotSplit(sum_s, sum.common, normal)) return false;
    const UnclearCorner* adding[kSmallNode];
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < around.size(); ++i) {
        if (isMember(i) && (around[i].flags & kAny) == 0) adding[count++] = &around[i];
    }
    if (!few && onOneSide({adding, count}, sum)) return false;
    std::uint32_t doubts = 0;
    for (std::uint32_t i = 1; i < count; ++i) {
        for (std::uint32_t j = 0; j < i; ++j) {
            if (farFromOpposed(*adding[i], *adding[j])) continue;
            if (++doubts > count) return anyOpposed({adding, count}, normal);  // frames of all, once each
            const UnclearCorner* const pair[2] = {adding[j], adding[i]};
            if (anyOpposed(pair, normal)) return true;
        }
    }
    return false;
}

/// Whether all keep to one side of the planes across their sums.
bool NodeGroups::onOneSide(std::span<const UnclearCorner* const> adding, const Sum& sum) {
    const Vec3 s = vectorOf(sum.s), t = vectorOf(sum.t);
    const float limit_s = kOffPlane * length(s), limit_t = kOffPlane * length(t);
    for (const UnclearCorner* corner : adding) {
        const float weight = corner->s[3];
        if (!(weight > kLeastWeight) || !(dot(s, vectorOf(corner->s)) > weight * limit_s) ||
            !(dot(t, vectorOf(corner->t)) > weight * limit_t))
            return false;
    }
    return true;
}

bool NodeGroups::anyOpposed(std::span<const UnclearCorner* const> adding, const Vec3& normal) const {
    struct Direction {
        Vec3 s, t;
        std::uint32_t face;
    };
    Direction directions[kSmallNode];
    std::uint32_t count = 0;
    for (const UnclearCorner* corner : adding) {
        const TriangleFrame frame = frameOf(corner->triangle);
        const Direction here{flatten(normal, frame.s), flatten(normal, frame.t), faceOf(*corner)};
        for (std::uint32_t j = 0; j < count; ++j) {
            const Direction& other = directions[j];
            if (other.face != here.face && !(dot(here.s, other.s) > -1.0f && dot(here.t, other.t) > -1.0f))
                return true;
        }
        directions[count++] = here;
    }
    return false;
}

TriangleFrame NodeGroups::frameOf(std::uint32_t triangle) const {
    Vec3 p[3];
    Vec2 uv[3];
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = nodes_.vertex(corners_.nodes[3 * std::size_t{triangle} + k]);
        p[k] = mesh_.positions[vertex];
        uv[k] = mesh_.uvs[vertex];
    }
    return triangleShape(p[0], p[1], p[2], uv[0], uv[1], uv[2]).frame;
}

Tangents NodeGroups::resultOf(const Sum& sum) const {
    Tangents r;
    r.positive = sum.positive;
    r.s = unit(vectorOf(sum.s));
    if (!full_) return r;
    r.t = unit(vectorOf(sum.t));
    r.mag_s = sum.t[3];
    r.mag_t = sum.length_t;
    if (sum.s[3] > 0) {
        r.mag_s /= sum.s[3];
        r.mag_t /= sum.s[3];
    }
    return r;
}

/// Whether corners of triangles that are one corner of the mesh have others between them. So it is only
/// in a polygon with two corners at one node.
bool NodeGroups::repeatsApart(std::span<const UnclearCorner> around) {
    for (std::size_t j = 2; j < around.size(); ++j) {
        const std::uint32_t slot = around[j].slot;
        if (around[j - 1].slot == slot) continue;
        for (std::size_t i = 0; i + 1 < j; ++i) {
            if (around[i].slot == slot) return true;
        }
    }
    return false;
}

/// Whether a copy of one of the node's corners depends on more than its first corner.
bool NodeGroups::isEntangled(std::size_t place, const Members& members) const {
    if (corners_.entangled.empty() || corners_.entangled[place] == 0) return false;
    if (corners_.entangled[place] == UnclearCorners::kOtherNode) return true;
    const std::uint8_t* end = members.group + members.count();
    return members.group_count != 0 && std::find(members.group, end, kNoGroup) != end;
}

NodeState NodeGroups::write(const Members& members, const Tangents* results, WalkCounts& counts) const {
    NodeState state = kDone;
    const std::uint32_t count = members.count();
    for (std::uint32_t i = 0; i < count;) {
        const std::uint32_t slot = members.corners[i].slot;
        const std::uint8_t group = members.group[i];
        std::uint32_t end = i + 1;
        bool same = true;
        for (; has_polygons_ && end < count && members.corners[end].slot == slot; ++end)
            same &= members.group[end] == group;
        if (!same) {
            writeMerged(slot, members.group + i, members.group + end, results);
        } else if (group != kNoGroup) {  // merging it with itself changes nothing: it is sound
            writeOne(slot, results[group]);
        } else {
            writeOne(slot, Tangents{});
            ++counts.defaults;
            if (i == 0) state = kFirstIsDefault;
        }
        i = end;
    }
    return state;
}

void NodeGroups::writeOne(std::uint32_t slot, const Tangents& result) const {
    if (tangents_only_) {
        out_.tangents[slot] = {result.s.x, result.s.y, result.s.z, sink_.sign(result.positive)};
    } else {
        sink_.write(slot, result);
    }
}

/// The corners of a polygon's triangles that are one corner of the mesh are neighbours in the list. Their
/// groups' results are merged in the order of groups; some of them has one.
void NodeGroups::writeMerged(std::uint32_t slot, const std::uint8_t* first, const std::uint8_t* end,
                             const Tangents* results) const {
    std::uint8_t lowest = kNoGroup, highest = 0;
    for (const std::uint8_t* g = first; g != end; ++g) {
        if (*g == kNoGroup) continue;
        lowest = std::min(lowest, *g);
        highest = std::max(highest, *g);
    }
    Tangents merged = results[lowest];
    for (std::uint32_t next = lowest + 1u; next <= highest; ++next) {
        for (const std::uint8_t* g = first; g != end; ++g) {
            if (*g == next) merge(merged, results[next]);
        }
    }
    writeOne(slot, merged);
}

}  // namespace tspace::mikk
