// SPDX-License-Identifier: MIT
// Groups written down as a plan.
#include <algorithm>
#include <cstring>
#include <functional>

#include "core/sort.h"
#include "tangents/mikktspace/node_results.h"
#include "tangents/mikktspace/splits.h"

namespace tspace::mikk {

namespace {

template <class T>
bool sameBits(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

/// Equal vertices may differ in the sign of a zero; then only those of the node give the reference's bits.
bool sameData(const MeshView& mesh, std::uint32_t a, std::uint32_t b) {
    return sameBits(mesh.positions[a], mesh.positions[b]) && sameBits(mesh.normals[a], mesh.normals[b]) &&
           sameBits(mesh.uvs[a], mesh.uvs[b]);
}

class Planner {
  public:
    explicit Planner(const PlanSource& from)
        : from_(from),
          mesh_(from.path.setting.mesh),
          corners_(from.corners),
          allocator_(from.path.setting.options.execution.allocator),
          room_(allocator_, from.grouping.largest()),
          splits_(from.path.setting, from.corners, from.threshold_cosine, allocator_),
          sources_(allocator_),
          ends_(allocator_),
          members_(allocator_),
          adding_(allocator_),
          repeats_(allocator_),
          positive_(allocator_),
          split_groups_(allocator_),
          split_members_(allocator_),
          conflicts_(allocator_),
          default_corners_(allocator_) {}

    EvaluationPlan run() {
        to_.report = corners_.report;
        to_.method = from_.path.setting.options.method;
        to_.refine = from_.path.setting.options.refine;
        to_.convention = from_.path.setting.options.convention;
        to_.vertex_count = mesh_.vertexCount();
        to_.corner_count = mesh_.cornerCount();
        numberTriangles();
        readTriangles();
        for (std::size_t place = 0; place < from_.path.chosen.size(); ++place) {
            if (isPlanned(place)) addNode(place);
        }
        to_.report.default_corner_count = default_corners_.size();
        to_.report.reference_order_abandoned = splits_.abandoned;
        to_.group_count = static_cast<std::uint32_t>(positive_.size());
        to_.group_positive = positive_.exact();
        to_.splits = split_groups_.exact();
        to_.members = split_members_.exact();
        to_.split_rows = splits_.rows.exact();
        to_.split_leaders = splits_.leaders.exact();
        to_.conflicts = conflicts_.exact();
        to_.default_corners = default_corners_.exact();
        return std::move(to_);
    }

  private:
    [[nodiscard]] bool isPlanned(std::size_t place) const {
        return from_.planned.empty() || (place < from_.planned.size() && from_.planned[place] != 0);
    }

    /// The plan has the triangles at planned nodes.
    void numberTriangles() {
        const std::size_t count = corners_.flags.size();
        to_.triangle_count = count;
        if (from_.planned.empty()) return;
        number_ = Buffer<std::uint32_t>(allocator_, count);
        std::uint32_t next = 0;
        for (std::size_t t = 0; t < count; ++t) {
            const std::uint32_t* places = corners_.placesOf(t);
            const bool planned = isPlanned(places[0]) || isPlanned(places[1]) || isPlanned(places[2]);
            number_[t] = planned ? next++ : kNone;
        }
        to_.triangle_count = next;
    }

    [[nodiscard]] std::uint32_t numberOf(std::size_t t) const {
        return number_.empty() ? static_cast<std::uint32_t>(t) : number_[t];
    }

    void readTriangles() {
        const TriangleList& triangles = from_.path.setting.triangles;
        const bool kept = from_.use == PlanUse::kept;
        to_.groups = Buffer<std::uint32_t>(allocator_, 3 * to_.triangle_count, kNone);
        to_.vertices = Buffer<std::uint32_t>(allocator_, 3 * to_.triangle_count + kTermCorners, 0u);
        if (!triangles.corners.empty() || !number_.empty() || !corners_.found.empty())
            to_.slots = Buffer<std::uint32_t>(allocator_, 3 * to_.triangle_count);
        for (std::size_t t = 0; t < corners_.flags.size(); ++t) {
            if (numberOf(t) == kNone) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t to = 3 * std::size_t{numberOf(t)} + k;
                const std::uint32_t slot = triangles.corner(3 * std::size_t{corners_.triangleOf(t)} + k);
                const std::uint32_t own = mesh_.indices[slot];
                const std::uint32_t vertex = from_.path.setting.nodes.vertex(corners_.nodes[3 * t + k]);
                to_.vertices[to] = kept && (own == vertex || sameData(mesh_, own, vertex)) ? own : vertex;
                if (!to_.slots.empty()) to_.slots[to] = slot;
            }
        }
        if (!kept) return;
        to_.uvs = Buffer<Vec2>(allocator_, mesh_.vertexCount());
        for (std::size_t v = 0; v < mesh_.vertexCount(); ++v) to_.uvs[v] = mesh_.uvs[v];
    }

    [[nodiscard]] std::uint32_t halfEdgeOf(const NodeCorner& corner) const {
        const std::uint32_t own = corners_.halfEdgeOf(corner);
        return 3 * numberOf(own / 3) + own % 3;
    }

    void addNode(std::size_t place) {
        const NodeGroups groups = from_.grouping.groupsOf(place, room_);
        const std::size_t count = groups.corners.size();
        const auto first = static_cast<std::uint32_t>(positive_.size());
        positive_.extend(groups.count);
        sources_.drop(sources_.size());
        sources_.extend(count);
        for (std::size_t i = 0; i < count; ++i) {
            const NodeCorner& corner = groups.corners[i];
            sources_[i] = groups.of(i) == kNone ? kNone : first + groups.of(i);
            if (sources_[i] == kNone) continue;
            to_.groups[halfEdgeOf(corner)] = sources_[i] | (corner.addsNothing() ? kMark : 0);
            if (!corner.addsNothing()) positive_[sources_[i]] = (corner.common & kIsUp) != 0 ? 1 : 0;
        }
        to_.report.group_count += groups.count;
        if (from_.path.setting.maySplit() && count > 1) splitGroups(place, groups, first);
        if (from_.path.setting.hasPolygons() && addRepeats(groups)) return;
        for (std::size_t i = 0; i < count; ++i) {
            if (sources_[i] == kNone) default_corners_.push(groups.corners[i].slot);
        }
    }

    /// `first`: the number of the node's first group.
    void splitGroups(std::size_t place, const NodeGroups& groups, std::uint32_t first) {
        // By groups, and ascending within each, as a counting sort leaves them.
        ends_.drop(ends_.size());
        std::fill_n(ends_.extend(groups.count + 1), groups.count + 1, 0u);
        for (const std::uint32_t source : sources_)
            ends_[source == kNone ? 0 : source - first + 1] += source == kNone ? 0 : 1;
        for (std::size_t g = 1; g <= groups.count; ++g) ends_[g] += ends_[g - 1];
        members_.drop(members_.size());
        members_.extend(groups.corners.size());
        for (std::size_t i = 0; i < groups.corners.size(); ++i) {
            if (sources_[i] != kNone) members_[ends_[sources_[i] - first]++] = &groups.corners[i];
        }
        std::uint32_t begin = 0;
        for (std::uint32_t g = 0; g < groups.count; begin = ends_[g++])
            splitGroup(place, groups.corners.data(), {members_.begin() + begin, ends_[g] - begin});
    }

    void splitGroup(std::size_t place, const NodeCorner* corners, Members members) {
        if (members.size() < 2) return;
        adding_.drop(adding_.size());
        Vec3 s, t;
        for (const NodeCorner* corner : members) {
            if (corner->addsNothing()) continue;
            adding_.push(corner);
            s = s + Vec3{corner->s[0], corner->s[1], corner->s[2]};
            t = t + Vec3{corner->t()[0], corner->t()[1], corner->t()[2]};
        }
        if (areTogether({adding_.begin(), adding_.size()}, s, t, from_.threshold_cosine)) return;
        const std::size_t rows = splits_.rows.size(), leaders = splits_.leaders.size();
        if (!splits_.splits(members, mesh_.normals[from_.path.setting.nodes.vertex(from_.path.chosen[place])])) return;
        const auto begin = static_cast<std::uint32_t>(split_members_.size());
        const auto count = static_cast<std::uint32_t>(members.size());
        split_groups_.push({begin, count, rows, leaders, positive_[sources_[members[0] - corners]] != 0});
        to_.largest_split = std::max(to_.largest_split, count);
        for (const NodeCorner* corner : members) {
            const std::uint32_t half_edge = halfEdgeOf(*corner);
            to_.groups[half_edge] = kNone;
            sources_[corner - corners] = kMark | static_cast<std::uint32_t>(split_members_.size());
            split_members_.push(half_edge);
        }
    }

    /// One corner of the mesh of a node, with one of its half-edges.
    struct Repeat {
        std::uint32_t slot, group, index;
        bool operator<(const Repeat& other) const {
            return slot != other.slot     ? slot < other.slot
                   : group != other.group ? group < other.group
                                          : index < other.index;
        }
    };

    /// Half-edges of a polygon's triangles that have one corner of the mesh. Returns false, and does nothing, where there
    /// are none.
    bool addRepeats(const NodeGroups& groups) {
        bool ascending = true;
        for (std::size_t i = 1; i < groups.corners.size(); ++i)
            ascending &= groups.corners[i - 1].slot < groups.corners[i].slot;
        if (ascending) return false;
        repeats_.drop(repeats_.size());
        for (std::uint32_t i = 0; i < groups.corners.size(); ++i)
            repeats_.push({groups.corners[i].slot, groups.of(i), i});
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
        if (end - first == 1) return;
        to_.has_repeats = true;
        const std::uint32_t source = sources_[first->index];
        const bool same = (source & kMark) == 0 &&
                          std::all_of(first, end, [&](const Repeat& r) { return sources_[r.index] == source; });
        for (const Repeat* r = first; r != end; ++r) {
            if (!same) conflicts_.push({r->slot, sources_[r->index]});
            if (!same || r != first) to_.slots[halfEdgeOf(groups.corners[r->index])] |= kMark;
        }
    }

    const PlanSource& from_;
    const MeshView& mesh_;
    const VertexCorners& corners_;
    const Allocator* allocator_;
    EvaluationPlan to_;
    GroupRoom room_;
    SplitFinder splits_;
    Buffer<std::uint32_t> number_;  // of each triangle around chosen nodes, in the plan; empty: its own
    // Of one node.
    Growing<std::uint32_t> sources_;  // of each corner's result, as in Conflict; kNone without
    Growing<std::uint32_t> ends_;     // of groups in members_
    Growing<const NodeCorner*> members_, adding_;
    Growing<Repeat> repeats_;
    // Of the plan.
    Growing<std::uint8_t> positive_;
    Growing<EvaluatedSplit> split_groups_;
    Growing<std::uint32_t> split_members_;
    Growing<Conflict> conflicts_;
    Growing<std::uint32_t> default_corners_;
};

}  // namespace

EvaluationPlan planNodes(const PlanSource& source) { return Planner(source).run(); }

std::size_t EvaluationPlan::memoryBytes() const {
    const auto bytes = [](const auto& buffer) { return buffer.size() * sizeof(*buffer.data()); };
    return sizeof(*this) + bytes(vertices) + bytes(groups) + bytes(slots) + bytes(group_positive) + bytes(uvs) +
           bytes(splits) + bytes(members) + bytes(split_rows) + bytes(split_leaders) + bytes(conflicts) +
           bytes(default_corners) + bytes(skipped_corners) + bytes(copies) + bytes(triangles);
}

}  // namespace tspace::mikk
