// SPDX-License-Identifier: MIT
// Groups and results of one node, as groups.cpp and evaluate.cpp make them, but without a plan in between.
#include "tangents/mikktspace/node_groups.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#include "tangents/mikktspace/corner_source.h"
#include "tangents/mikktspace/fan_list.h"
#include "tangents/mikktspace/triangle_pass.h"

namespace tspace::mikk {

namespace {

/// Sine of the angle that vectors must keep from a plane: far more than rounding errors.
constexpr float kOffPlane = 0.02f;
constexpr float kLeastWeight = 1e-4f;  // below, a corner says too little about its direction
/// Cosine of an angle of about 177 degrees. Rounding errors of the products are far below what is missing to
/// 180.
constexpr float kNotOpposed = -0.999f;
constexpr std::uint32_t kFewMembers = 4;  // all pairs of so few are compared at once

Vec3 vectorOf(const float* row) { return {row[0], row[1], row[2]}; }
Vec3 vectorOf(Float4 row) { return {row[0], row[1], row[2]}; }

/// Whether the links between them make one path or ring, without a choice.
bool areOneFan(std::span<const UnclearCorner> around) {
    if (around.size() == 2) return around[0].next == around[1].previous || around[1].next == around[0].previous;
    if (around.size() > FanList::kMost) return false;
    FanList list;
    list.clear();
    constexpr std::uint32_t kFar = 1u << 14;  // half of what a list holds: then one bit tells of all that are farther
    std::uint32_t any = 0;
    for (std::uint32_t i = 0; i < around.size(); ++i) {
        const std::uint32_t next = around[i].next - around[0].next, previous = around[i].previous - around[0].next;
        list.set(i, next, previous);
        any |= (next + kFar) | (previous + kFar);
    }
    return any < 2 * kFar && isOneFan(list, static_cast<std::uint32_t>(around.size()));
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
      sink_(out, signFactor(options.convention) * normalFactor(options.convention), signFactor(options.convention)),
      corners_(corners),
      may_split_(options.method == Method::mikktspace),
      has_polygons_(!triangles.faces.empty()),
      tangents_only_(wantsTangentsOnly(out)),
      full_(has_polygons_ || !tangents_only_),
      has_t_(full_ || may_split_) {}

Links::Links(std::span<const UnclearCorner> around) {
    if (!linkUnambiguous(around)) linkAny(around);
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
    const std::size_t lanes = (count + 3) / 4 * 4;
    for (std::size_t i = count; i < lanes; ++i) previous[i] = kNone;
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

bool Links::areOnePath(std::size_t count) const {
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
    if (copies_elsewhere) return kLeft;
    if (corners_.facing[place] == 0) return writeDefaults(around, counts);
    if (around.size() > kSmallNode) return kLeft;
    const bool one_orientation = corners_.facing[place] != (kFacesUp | kFacesDown);
    // The usual case: one fan of one orientation, and nothing else to see to.
    if (one_orientation && (around.size() == 1 || areOneFan(around))) return finishOneGroup(place, around, counts);
    const Links links(around);
    if (one_orientation && links.areOnePath(around.size())) return finishOneGroup(place, around, counts);
    Members members(around);
    formGroups(members, links);
    return finish(place, members, counts);
}

/// Of a node without groups. Corners of a polygon's triangles that are one corner of the mesh are neighbours.
NodeState NodeGroups::writeDefaults(std::span<const UnclearCorner> around, WalkCounts& counts) const {
    if (around.empty()) return kDone;
    std::uint32_t before = around[0].slot;
    std::uint64_t defaults = 1;
    bool ascending = true;
    const Vec4 tangent{1, 0, 0, sink_.sign(false)};
    for (const UnclearCorner& corner : around) {
        ascending &= before <= corner.slot;
        defaults += corner.slot != before ? 1 : 0;
        before = corner.slot;
        if (tangents_only_) {
            out_.tangents[before] = tangent;
        } else {
            sink_.write(before, Tangents{});
        }
    }
    if (!ascending && (around.size() > kSmallNode || repeatsApart(around))) return kLeft;
    counts.defaults += defaults;
    return kFirstIsDefault;
}

inline void NodeGroups::add(const UnclearCorner& corner, bool with_lengths, Sum& sum) const {
    sum.common &= corner.common;
    sum.adding += corner.addsNothing() ? 0 : 1;
    sum.s += loadFloat4(corner.s);
    if (has_t_) sum.t += loadFloat4(corner.t());
    if (!with_lengths) return;
    const std::uint32_t tricorner = corners_.tricornerOf(corner), row = tricorner % kTermCorners;
    sum.length_t += corners_.terms[tricorner / kTermCorners].lengths_t[row % 3][row / 3];
}

NodeGroups::Sum NodeGroups::sumOf(std::span<const UnclearCorner> around, bool with_lengths) const {
    Sum sum;
    for (const UnclearCorner& corner : around) add(corner, with_lengths, sum);
    sum.positive = (sum.common & kIsUp) != 0;
    return sum;
}

NodeState NodeGroups::finishOneGroup(std::size_t place, std::span<const UnclearCorner> around,
                                     WalkCounts& counts) const {
    const Sum sum = sumOf(around, !tangents_only_);
    if (may_split_ && sum.adding > 1 && splits(place, sum, around, [](std::size_t) { return true; })) return kLeft;
    if (!tangents_only_) {
        const Tangents result = resultOf(sum);
        if (!isSound(result)) return kLeft;
        for (const UnclearCorner& corner : around) sink_.write(corner.slot, result);
    } else {
        const Vec3 s = unit(vectorOf(sum.s));
        if (has_polygons_ && !restIsSound(sum) ? !isSound(resultOf(sumOf(around, true)))
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
    return (sum.common & (kFacesUp | kFacesDown)) != 0 && square > 0 && square < std::numeric_limits<float>::infinity();
}

bool NodeGroups::isSound(const Tangents& result) const {
    return isFinite(result.s) && (!has_polygons_ || sameResult(result, result)) && (may_split_ || notZero(result.s));
}

/// Groups of a node without contested triangles: those without UV area join any.
void NodeGroups::formGroups(Members& members, const Links& links) {
    const std::uint32_t count = members.count();
    std::fill_n(members.group, count, kNoGroup);
    for (std::uint32_t seed = 0; seed < count; ++seed) {
        const UnclearCorner& first = members.corners[seed];
        if (first.addsNothing() || members.group[seed] != kNoGroup) continue;
        const auto group = static_cast<std::uint8_t>(members.group_count++);
        members.group[seed] = group;
        for (const std::uint8_t* to : {links.left, links.right}) {
            for (std::uint8_t m = to[seed]; m != Links::kNoLink && members.group[m] == kNoGroup; m = to[m]) {
                if ((members.corners[m].common & first.common & (kIsUp | kIsDown)) == 0) break;
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
        if (members.group[i] == kNoGroup || corner.addsNothing()) continue;
        Sum& sum = sums[members.group[i]];
        sum.positive = (corner.common & kIsUp) != 0;
        add(corner, full_, sum);
    }
    for (std::uint32_t g = 0; g < members.group_count; ++g) {
        const auto isMember = [&](std::size_t i) { return members.group[i] == g; };
        if (may_split_ && sums[g].adding > 1 && splits(place, sums[g], members.corners, isMember)) return kLeft;
        if (tangents_only_ && (!has_polygons_ || restIsSound(sums[g]))) {
            results[g].s = unit(vectorOf(sums[g].s));
            results[g].positive = sums[g].positive;
            if (!isFinite(results[g].s) || !(may_split_ || notZero(results[g].s))) return kLeft;
        } else {
            results[g] = resultOf(sums[g]);
            if (!isSound(results[g])) return kLeft;
        }
    }
    counts.groups += members.group_count;
    return write(members, sums, results, counts);
}

/// The angular test. Nearly all groups keep together: no two members come near opposite directions, or of
/// many the sum shows it, or they keep to one side of the planes across their sums. Of other pairs the
/// directions are compared as the reference does.
template <class IsMember>
bool NodeGroups::splits(std::size_t place, const Sum& sum, std::span<const UnclearCorner> around,
                        const IsMember& isMember) const {
    const Vec3& normal = normalOf(place);
    const bool few = sum.adding <= kFewMembers;
    float sum_s[4];
    storeFloat4(sum_s, sum.s);
    if (!few && sumCannotSplit(sum_s, sum.common, normal)) return false;
    const UnclearCorner* members[kSmallNode];
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < around.size(); ++i) {
        members[count] = &around[i];
        count += isMember(i) && !around[i].addsNothing() ? 1 : 0;
    }
    const Adding adding{members, count};
    if (few ? allFarFromOpposed(adding) : onOneSide(adding, sum)) return false;
    return anyOpposed(adding, normal);
}

/// One array per component of up to kSmallNode rows, in whole lanes: the last ones repeat the first row.
struct NodeGroups::Columns {
    Float4 sx[kSmallNode / 4], sy[kSmallNode / 4], sz[kSmallNode / 4], weight[kSmallNode / 4];
    Float4 tx[kSmallNode / 4], ty[kSmallNode / 4], tz[kSmallNode / 4];

    explicit Columns(Adding adding) {
        for (std::size_t block = 0; 4 * block < adding.size(); ++block) {
            const auto at = [&](std::size_t i) { return adding[4 * block + i < adding.size() ? 4 * block + i : 0]; };
            const UnclearCorner *a = at(0), *b = at(1), *c = at(2), *d = at(3);
            Float4 s[4] = {loadFloat4(a->s), loadFloat4(b->s), loadFloat4(c->s), loadFloat4(d->s)};
            Float4 t[4] = {loadFloat4(a->t()), loadFloat4(b->t()), loadFloat4(c->t()), loadFloat4(d->t())};
            transpose4(s[0], s[1], s[2], s[3]);
            transpose4(t[0], t[1], t[2], t[3]);
            sx[block] = s[0];
            sy[block] = s[1];
            sz[block] = s[2];
            weight[block] = s[3];
            tx[block] = t[0];
            ty[block] = t[1];
            tz[block] = t[2];
        }
    }
};

bool NodeGroups::anyOpposed(Adding adding, const Vec3& normal) const {
    const Columns of(adding);
    Direction directions[kSmallNode];
    std::uint64_t known = 0;  // which of them
    const auto directionAt = [&](std::size_t i) -> const Direction& {
        if ((known >> i & 1) == 0) directions[i] = directionOf(*adding[i], normal);
        known |= std::uint64_t{1} << i;
        return directions[i];
    };
    for (std::size_t i = 1; i < adding.size(); ++i) {
        const float *s = adding[i]->s, *t = adding[i]->t();
        for (std::size_t block = 0; 4 * block < i; ++block) {
            const Float4 limit = splat(kNotOpposed * s[3]) * of.weight[block];
            const Mask4 far =
                (splat(s[0]) * of.sx[block] + splat(s[1]) * of.sy[block] + splat(s[2]) * of.sz[block] > limit) &
                (splat(t[0]) * of.tx[block] + splat(t[1]) * of.ty[block] + splat(t[2]) * of.tz[block] > limit) &
                (of.weight[block] > splat(kLeastWeight)) & (splat(s[3]) > splat(kLeastWeight));
            const unsigned before = i - 4 * block < 4 ? (1u << (i - 4 * block)) - 1 : 0xfu;
            for (unsigned doubts = ~laneBits(far) & before; doubts != 0; doubts &= doubts - 1) {
                const std::size_t j = 4 * block + static_cast<std::size_t>(std::countr_zero(doubts));
                if (faceOf(*adding[i]) == faceOf(*adding[j])) continue;
                const Direction &a = directionAt(i), &b = directionAt(j);
                if (!(dot(a.s, b.s) > -1.0f && dot(a.t, b.t) > -1.0f)) return true;
            }
        }
    }
    return false;
}

/// Whether all keep to one side of the planes across their sums.
bool NodeGroups::onOneSide(Adding adding, const Sum& sum) {
    const Vec3 s = vectorOf(sum.s), t = vectorOf(sum.t);
    const float limit_s = kOffPlane * length(s), limit_t = kOffPlane * length(t);
    for (const UnclearCorner* corner : adding) {
        const float weight = corner->s[3];
        if (!(weight > kLeastWeight) || !(dot(s, vectorOf(corner->s)) > weight * limit_s) ||
            !(dot(t, vectorOf(corner->t())) > weight * limit_t))
            return false;
    }
    return true;
}

/// Whether it is plain that neither the tangents nor the bitangents of two corners have opposite directions.
bool NodeGroups::farFromOpposed(const UnclearCorner& a, const UnclearCorner& b) {
    const float weight = a.s[3], other = b.s[3], limit = kNotOpposed * weight * other;
    return (int{weight > kLeastWeight} & int{other > kLeastWeight} & int{dot(vectorOf(a.s), vectorOf(b.s)) > limit} &
            int{dot(vectorOf(a.t()), vectorOf(b.t())) > limit}) != 0;
}

/// Whether it is plain that of no two of up to kFewMembers the tangents or the bitangents have opposite
/// directions: each of the four lanes is compared with the next one, and with the one after that. (No row is
/// opposed to itself.)
bool NodeGroups::allFarFromOpposed(Adding adding) {
    static_assert(kFewMembers == 4);
    if (adding.size() == 2) return farFromOpposed(*adding[0], *adding[1]);
    const Columns of(adding);
    const auto next = [](Float4 v) { return __builtin_shufflevector(v, v, 1, 2, 3, 0); };
    const auto afterNext = [](Float4 v) { return __builtin_shufflevector(v, v, 2, 3, 0, 1); };
    const auto areFar = [&](const auto& turned) {
        const Float4 limit = splat(kNotOpposed) * of.weight[0] * turned(of.weight[0]);
        return (of.sx[0] * turned(of.sx[0]) + of.sy[0] * turned(of.sy[0]) + of.sz[0] * turned(of.sz[0]) > limit) &
               (of.tx[0] * turned(of.tx[0]) + of.ty[0] * turned(of.ty[0]) + of.tz[0] * turned(of.tz[0]) > limit);
    };
    return laneBits((of.weight[0] > splat(kLeastWeight)) & areFar(next) & areFar(afterNext)) == 0xf;
}

NodeGroups::Direction NodeGroups::directionOf(const UnclearCorner& corner, const Vec3& normal) const {
    Vec3 p[3];
    Vec2 uv[3];
    const std::size_t triangle = corners_.numberOf(corner);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = nodes_.vertex(corners_.nodes[3 * triangle + k]);
        p[k] = mesh_.positions[vertex];
        uv[k] = mesh_.uvs[vertex];
    }
    const TriangleFrame frame = triangleShape(p[0], p[1], p[2], uv[0], uv[1], uv[2]).frame;
    return {flatten(normal, frame.s), flatten(normal, frame.t)};
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
    bool ascending = true;
    for (std::size_t j = 1; j < around.size(); ++j) ascending &= around[j - 1].slot <= around[j].slot;
    if (ascending) return false;
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

NodeState NodeGroups::write(const Members& members, const Sum* sums, const Tangents* results,
                            WalkCounts& counts) const {
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
            writeMerged(slot, members.group + i, members.group + end, sums);
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
                             const Sum* sums) const {
    std::uint8_t lowest = kNoGroup, highest = 0;
    for (const std::uint8_t* g = first; g != end; ++g) {
        if (*g == kNoGroup) continue;
        lowest = std::min(lowest, *g);
        highest = std::max(highest, *g);
    }
    Tangents merged = resultOf(sums[lowest]);
    for (std::uint32_t next = lowest + 1u; next <= highest; ++next) {
        for (const std::uint8_t* g = first; g != end; ++g) {
            if (*g == next) merge(merged, resultOf(sums[next]));
        }
    }
    writeOne(slot, merged);
}

}  // namespace tspace::mikk
