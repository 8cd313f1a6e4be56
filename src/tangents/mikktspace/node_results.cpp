// SPDX-License-Identifier: MIT
#include "tangents/mikktspace/node_results.h"

#include "tangents/mikktspace/node_sums.h"
#include "tangents/mikktspace/splits.h"

namespace tspace::mikk {

namespace {

constexpr std::uint32_t kFewGroups = 8;

/// Corners of a polygon's triangles that are one corner of the mesh lie side by side, unless the polygon has two corners
/// at this node. Returns whether they do, and are in one group.
bool repeatsAgree(const NodeGroups& groups) {
    for (std::size_t i = 1; i < groups.corners.size(); ++i) {
        const std::uint32_t slot = groups.corners[i].slot, before = groups.corners[i - 1].slot;
        if (slot < before || (slot == before && groups.of(i) != groups.of(i - 1))) return false;
    }
    return true;
}

}  // namespace

NodeResults::NodeResults(const VertexPath& path, const VertexCorners& corners, float threshold_cosine, Marks& defaults)
    : path_(path),
      sink_(path.setting.out, path.setting.options.convention),
      corners_(corners),
      threshold_cosine_(threshold_cosine),
      defaults_(defaults),
      may_split_(path.setting.maySplit()),
      has_polygons_(path.setting.hasPolygons()),
      tangents_only_(wantsTangentsOnly(path.setting.out)),
      has_t_(has_polygons_ || !tangents_only_ || may_split_) {}

inline void NodeResults::writeCorner(std::uint32_t slot, const Tangents& result) const {
    if (tangents_only_) {
        path_.setting.out.tangents[slot] = {result.s.x, result.s.y, result.s.z, sink_.sign(result.positive)};
    } else {
        sink_.write(slot, result);
    }
}

bool NodeResults::write(std::size_t place, const NodeGroups& groups, NodeCounts& counts) const {
    if (groups.count == 1 && groups.group == nullptr) return writeGroup(place, groups, counts);
    if (groups.count <= 1) return writeGroups<1>(place, groups, counts);
    if (groups.count > kFewGroups || (has_polygons_ && !repeatsAgree(groups))) return false;
    return writeGroups<kFewGroups>(place, groups, counts);
}

/// Of a node with all corners in one group.
bool NodeResults::writeGroup(std::size_t place, const NodeGroups& groups, NodeCounts& counts) const {
    Sum sum;
    for (const NodeCorner& corner : groups.corners) {
        if (!corner.addsNothing()) add(corner, has_polygons_ || !tangents_only_, sum);
    }
    Tangents result;
    if ((may_split_ && sum.adding > 1 && maySplit(place, groups, 0, sum)) || !resultOf(sum, result)) return false;
    for (const NodeCorner& corner : groups.corners) writeCorner(corner.slot, result);
    ++counts.groups;
    return true;
}

template <std::size_t kMost>
bool NodeResults::writeGroups(std::size_t place, const NodeGroups& groups, NodeCounts& counts) const {
    Sum sums[kMost];
    Tangents results[kMost];
    bool any_without = false;
    for (std::size_t i = 0; i < groups.corners.size(); ++i) {
        const std::uint32_t group = groups.of(i);
        any_without |= group == kNone;
        if (group != kNone && !groups.corners[i].addsNothing())
            add(groups.corners[i], has_polygons_ || !tangents_only_, sums[group]);
    }
    if (has_polygons_ && any_without && !repeatsAgree(groups)) return false;
    for (std::uint32_t g = 0; g < groups.count; ++g) {
        if (may_split_ && sums[g].adding > 1 && maySplit(place, groups, g, sums[g])) return false;
        if (!resultOf(sums[g], results[g])) return false;
    }
    std::uint32_t before = kNone;
    for (std::size_t i = 0; i < groups.corners.size(); ++i) {
        const std::uint32_t slot = groups.corners[i].slot, group = groups.of(i);
        writeCorner(slot, group != kNone ? results[group] : Tangents{});
        if (group == kNone) {
            counts.default_corners += slot != before ? 1 : 0;
            if (!defaults_.empty()) defaults_[slot] = 1;
        }
        before = slot;
    }
    counts.groups += groups.count;
    return true;
}

inline void NodeResults::add(const NodeCorner& corner, bool with_lengths, Sum& sum) const {
    sum.common &= corner.common;
    ++sum.adding;
    sum.s += loadFloat4(corner.s);
    if (has_t_) sum.t += loadFloat4(corner.t());
    if (!with_lengths) return;
    const std::uint32_t half_edge = corners_.halfEdgeOf(corner), row = half_edge % kTermCorners;
    sum.length_t += corners_.terms[half_edge / kTermCorners].lengths_t[row % 3][row / 3];
}

/// The angular test. Nearly all groups keep together: their sum shows it, or it is plain for every two.
bool NodeResults::maySplit(std::size_t place, const NodeGroups& groups, std::uint32_t group, const Sum& sum) const {
    if (sum.adding > kSmallNode) return true;
    if (sum.adding > 4 && threshold_cosine_ == -1.0f) {
        float s[4];
        storeFloat4(s, sum.s);
        if (sumCannotSplit(s, sum.common, path_.setting.mesh.normals[path_.setting.nodes.vertex(path_.chosen[place])]))
            return false;
    }
    const NodeCorner* members[kSmallNode];
    std::size_t count = 0;
    for (std::size_t i = 0; i < groups.corners.size(); ++i) {
        if (groups.of(i) == group && !groups.corners[i].addsNothing()) members[count++] = &groups.corners[i];
    }
    return !areTogether({members, count}, vectorOf(sum.s), vectorOf(sum.t), threshold_cosine_);
}

/// Returns false when it is not finite or, but for mikktspace, vanishes. Where polygons may give a corner twice, a NaN in
/// any field counts: it would be merged with itself.
bool NodeResults::resultOf(const Sum& sum, Tangents& result) const {
    result.positive = (sum.common & kIsUp) != 0;
    result.s = unit(vectorOf(sum.s));
    if (!isFinite(result.s) || !(may_split_ || notZero(result.s))) return false;
    if (!has_polygons_ && tangents_only_) return true;
    result = TangentSum{vectorOf(sum.s), vectorOf(sum.t), sum.t[3], sum.length_t, sum.s[3]}.mean(result.positive);
    return !has_polygons_ || sameResult(result, result);
}

}  // namespace tspace::mikk
