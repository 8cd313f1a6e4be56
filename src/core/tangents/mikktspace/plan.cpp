// SPDX-License-Identifier: MIT
// The plan half of the method: groups every chosen node (groups.h), finds the groups that an angular threshold splits
// (splits.h), and writes both down as an EvaluationPlan, which evaluate.cpp runs on any pose.
//
// h stands for a half-edge of the plan's own triangles, 3 * t + k: triangle t is triangle triangles[t] of the mesh, or t where
// that list is empty.
//
// list             how many               an entry is                                its top bit (kTopBit) says
// vertices         one per h              the vertex whose data stand for the corner  -
// groups           one per h              the group that takes its result            it adds nothing to the sum (no UV area)
// slots            one per h, or empty    its corner of the mesh                     the corner has several results: conflicts
// triangles        one per t, or empty    its number in the mesh                     -
// group_positive   one per group          1: positive UV area                        -
// uvs, terms       vertices; blocks of t  kept plans have UVs, others CornerTerms    -
// splits           one per split group    a range of `members`, its first row        -
// members          members of these       an h                                       -
// split_rows       one row per member     bit b: member b counts for this member     -
// conflicts        two or more a corner   a corner of the mesh, and a source:        source is a place in `members`, not
//                                         a group whose result it takes              a group
// default_corners  corners without group  a corner of the mesh                       -
// skipped_corners  of ignored faces       a corner of the mesh                       -
// copies           of degenerate t        a corner that copies, and the one copied   -
//
// groups[h] is kNone for half-edges without a group, and for members of groups that split: these have their result from
// splits. While the planner works on a node, groups[h] is a source as in conflicts.
#include "core/tangents/mikktspace/vertex_path.h"

#include <algorithm>
#include <compare>
#include <cstring>
#include <functional>
#include <utility>

#include "core/base/sort.h"
#include "core/tangents/mikktspace/groups.h"
#include "core/tangents/mikktspace/splits.h"

namespace tspace::mikk {

namespace {

template <class T>
bool sameBits(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

/// Whether two equal vertices have equal bits. Where a zero's sign differs, only the data of the node's own vertex give the
/// reference's bits.
bool sameData(const MeshView& mesh, std::uint32_t a, std::uint32_t b) {
    return sameBits(mesh.positions[a], mesh.positions[b]) && sameBits(mesh.normals[a], mesh.normals[b]) &&
           sameBits(mesh.uvs[a], mesh.uvs[b]);
}

class Planner {
  public:
    explicit Planner(const VertexPath& path)
        : path_(path),
          in_(path.setting),
          mesh_(in_.mesh),
          allocator_(in_.options.execution.allocator),
          threshold_cosine_(in_.maySplit() ? thresholdCosine(in_.options.angular_threshold_deg) : -1.0f),
          corners_(readCorners(path)),
          grouping_(path, corners_),
          splits_(in_, corners_, threshold_cosine_, allocator_),
          ends_(allocator_),
          members_(allocator_),
          repeats_(allocator_),
          positive_(allocator_),
          split_groups_(allocator_),
          split_members_(allocator_),
          conflicts_(allocator_),
          default_corners_(allocator_),
          copies_(allocator_) {}

    EvaluationPlan run() {
        to_.report = corners_.report;
        to_.method = in_.options.method;
        to_.refine = in_.options.refine;
        to_.convention = in_.options.convention;
        to_.vertex_count = mesh_.vertexCount();
        to_.corner_count = mesh_.cornerCount();
        to_.triangle_count = corners_.flags.size();
        readTriangles();
        for (std::size_t place = 0; place < path_.chosen.size(); ++place) addNode(place);
        addCopies();
        to_.report.default_corner_count = default_corners_.size();
        to_.report.reference_order_abandoned = splits_.abandoned;
        to_.group_count = static_cast<std::uint32_t>(positive_.size());
        to_.group_positive = positive_.exact();
        to_.splits = split_groups_.exact();
        to_.members = split_members_.exact();
        to_.split_rows = splits_.rows.exact();
        to_.conflicts = conflicts_.exact();
        to_.default_corners = default_corners_.exact();
        to_.copies = copies_.exact();
        to_.triangles = std::move(corners_.found);
        if (path_.use == PlanUse::once) to_.terms = std::move(corners_.terms);
        return std::move(to_);
    }

  private:
    void readTriangles() {
        const std::size_t count = 3 * to_.triangle_count;
        to_.groups = Buffer<std::uint32_t>(allocator_, count, kNone);
        if (!in_.triangles.corners.empty()) to_.slots = Buffer<std::uint32_t>(allocator_, count);
        for (std::uint32_t h = 0; h < to_.slots.size(); ++h) to_.slots[h] = slotOf(h);
        if (path_.use == PlanUse::once) return;
        to_.vertices = Buffer<std::uint32_t>(allocator_, count + kTermCorners, 0u);
        for (std::uint32_t h = 0; h < count; ++h) {
            const std::uint32_t own = mesh_.indices[slotOf(h)], vertex = in_.nodes.vertex(corners_.nodes[h]);
            to_.vertices[h] = own == vertex || sameData(mesh_, own, vertex) ? own : vertex;
        }
        to_.uvs = Buffer<Vec2>(allocator_, mesh_.vertexCount());
        for (std::size_t v = 0; v < mesh_.vertexCount(); ++v) to_.uvs[v] = mesh_.uvs[v];
    }

    [[nodiscard]] std::uint32_t slotOf(std::uint32_t half_edge) const {
        return in_.triangles.corner(corners_.halfEdgeOf(half_edge));
    }

    /// Numbers the groups of a node, splits them, and turns the sources in to_.groups into groups.
    void addNode(std::size_t place) {
        const NodeGroups groups = grouping_.groupsOf(place);
        const auto first = static_cast<std::uint32_t>(positive_.size());
        std::uint8_t* const positive = positive_.extend(groups.count);
        std::uint32_t* const sources = to_.groups.data();
        bool is_done = true;
        for (std::size_t i = 0; i < groups.corners.size(); ++i) {
            const std::uint32_t group = groups.of(i), facing = groups.corners[i].facing;
            is_done &= facing != 0;
            if (group == kNone) continue;
            sources[groups.corners[i].half_edge] = first + group;
            if (facing != 0) positive[group] = facing == kFacesUp ? 1 : 0;
        }
        to_.report.group_count += groups.count;
        if (in_.maySplit() && groups.count != 0) is_done &= !splitGroups(place, groups);
        const bool has_repeats = in_.hasPolygons() && addRepeats(groups);
        for (std::size_t i = 0; !is_done && i < groups.corners.size(); ++i) {
            const NodeCorner& corner = groups.corners[i];
            std::uint32_t& source = sources[corner.half_edge];
            if (source == kNone && !has_repeats) default_corners_.push(slotOf(corner.half_edge));
            if ((source & kTopBit) != 0) source = kNone;
            if (corner.facing == 0) source |= kTopBit;
        }
    }

    /// Returns whether any group of the node splits.
    bool splitGroups(std::size_t place, const NodeGroups& groups) {
        if (groups.group == nullptr) return splitGroup(place, groups.corners);
        // By groups, and ascending within each, as a counting sort leaves them.
        ends_.drop(ends_.size());
        std::fill_n(ends_.extend(groups.count + 1), groups.count + 1, 0u);
        for (std::size_t i = 0; i < groups.corners.size(); ++i)
            ends_[groups.of(i) + 1] += groups.of(i) != kNone ? 1 : 0;
        for (std::size_t g = 1; g <= groups.count; ++g) ends_[g] += ends_[g - 1];
        members_.drop(members_.size());
        members_.extend(groups.corners.size());
        for (std::size_t i = 0; i < groups.corners.size(); ++i) {
            if (groups.of(i) != kNone) members_[ends_[groups.of(i)]++] = groups.corners[i];
        }
        std::uint32_t begin = 0;
        bool any = false;
        for (std::uint32_t g = 0; g < groups.count; begin = ends_[g++])
            any |= splitGroup(place, {members_.begin() + begin, ends_[g] - begin});
        return any;
    }

    bool splitGroup(std::size_t place, Members members) {
        if (areTogether(members, threshold_cosine_)) return false;
        const std::size_t rows = splits_.rows.size();
        if (!splits_.splits(members, mesh_.normals[in_.nodes.vertex(path_.chosen[place])])) return false;
        const auto begin = static_cast<std::uint32_t>(split_members_.size());
        const auto count = static_cast<std::uint32_t>(members.size());
        split_groups_.push({begin, count, rows, positive_[to_.groups[members[0].half_edge]] != 0});
        to_.largest_split = std::max(to_.largest_split, count);
        for (const NodeCorner& corner : members) {
            to_.groups[corner.half_edge] = kTopBit | static_cast<std::uint32_t>(split_members_.size());
            split_members_.push(corner.half_edge);
        }
        return true;
    }

    /// A corner of the mesh, with one of its half-edges at this node.
    struct Repeat {
        std::uint32_t slot, group, index;
        auto operator<=>(const Repeat&) const = default;
    };

    /// Finds corners of the mesh that several half-edges have, as at a quad's diagonal: each of these half-edges becomes a
    /// conflict. Returns false, and does nothing, where there are none.
    bool addRepeats(const NodeGroups& groups) {
        bool ascending = true;
        repeats_.drop(repeats_.size());
        for (std::uint32_t i = 0; i < groups.corners.size(); ++i) {
            repeats_.push({slotOf(groups.corners[i].half_edge), groups.of(i), i});
            ascending &= i == 0 || repeats_[i - 1].slot < repeats_[i].slot;
        }
        if (ascending) return false;
        sortList(repeats_.begin(), repeats_.end(), std::less<>());
        const Repeat *r = repeats_.begin(), *all_end = repeats_.end();
        while (r != all_end) {
            const Repeat* end = std::find_if(r, all_end, [&](const Repeat& other) { return other.slot != r->slot; });
            const Repeat* grouped = std::find_if(r, end, [](const Repeat& other) { return other.group == kNone; });
            grouped == r ? default_corners_.push(r->slot) : addRepeated(groups, r, grouped);
            r = end;
        }
        return true;
    }

    void addRepeated(const NodeGroups& groups, const Repeat* first, const Repeat* end) {
        for (const Repeat* r = first; end - first > 1 && r != end; ++r) {
            const std::uint32_t half_edge = groups.corners[r->index].half_edge;
            conflicts_.push({r->slot, to_.groups[half_edge]});
            to_.slots[half_edge] |= kTopBit;
        }
    }

    /// Plans the corners of degenerate triangles: a copy, or the default where the copied corner has the default or where
    /// there is none to copy.
    void addCopies() {
        if (corners_.copies.empty()) return;
        Marks is_default = noMarks(allocator_, mesh_.cornerCount());
        for (const std::uint32_t corner : default_corners_) is_default[corner] = 1;
        for (const Copy& copy : corners_.copies) {
            if (copy.from == kNone || is_default[copy.from] != 0) {
                default_corners_.push(copy.to);
            } else {
                copies_.push(copy);
            }
        }
    }

    const VertexPath& path_;
    const NodeSetting& in_;
    const MeshView& mesh_;
    const Allocator* allocator_;
    float threshold_cosine_;
    VertexCorners corners_;
    Grouping grouping_;
    EvaluationPlan to_;
    SplitFinder splits_;
    // Scratch, used again for each node.
    Growing<std::uint32_t> ends_;  // where each group ends in members_
    Growing<NodeCorner> members_;  // the node's corners, group by group
    Growing<Repeat> repeats_;
    // Lists of the plan while they grow.
    Growing<std::uint8_t> positive_;
    Growing<EvaluatedSplit> split_groups_;
    Growing<std::uint32_t> split_members_;
    Growing<Conflict> conflicts_;
    Growing<std::uint32_t> default_corners_;
    Growing<Copy> copies_;
};

}  // namespace

EvaluationPlan planChosen(const VertexPath& path) { return Planner(path).run(); }

std::size_t EvaluationPlan::memoryBytes() const {
    const auto bytes = [](const auto& buffer) { return buffer.size() * sizeof(*buffer.data()); };
    return sizeof(*this) + bytes(vertices) + bytes(groups) + bytes(slots) + bytes(group_positive) + bytes(uvs) +
           bytes(splits) + bytes(members) + bytes(split_rows) + bytes(conflicts) + bytes(default_corners) +
           bytes(skipped_corners) + bytes(copies) + bytes(triangles);
}

}  // namespace tspace::mikk
