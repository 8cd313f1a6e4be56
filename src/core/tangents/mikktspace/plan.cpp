// SPDX-License-Identifier: MIT
// Planning: groups every selected node (groups.h), finds the groups that an angular threshold splits (SplitFinder), and
// stores both as an EvaluationPlan, which evaluate.cpp runs on any pose.
//
// h denotes a half-edge of the plan's own triangles, 3 * t + k: triangle t is triangle triangles[t] of the mesh, or t
// if that list is empty.
//
// list             how many               an entry is                                kTopBit in the entry means
// vertices         one per h              the vertex with the data of its corner      -
// groups           one per h              its group                                  no UV area: h contributes nothing
// slots            one per h, or empty    its corner of the mesh                     several results: see conflicts
// triangles        one per t, or empty    its number in the mesh                     -
// group_positive   one per group          1: positive UV area                        -
// uvs, terms       vertices; blocks of t  kept plans have UVs, others CornerTerms    -
// splits           one per split group    a range of `members`, and its first row    -
//                                         in split_rows
// members          members of these       a half-edge h                              -
// split_rows       one row per member     bit b: member b counts for this member     -
// conflicts        two or more per corner  a corner of the mesh, and a source:        source is in `members`, no group
//                                         a group whose result it takes
// default_corners  one per corner         a corner of the mesh without a group       -
// skipped_corners  one per corner         a corner of an ignored face                -
// copies           one per corner         a corner of a degenerate triangle, and the corner that it copies
//
// groups[h] is kNone for half-edges without a group, and for members of groups that split: `splits` contains their
// results. While the planner processes a node, groups[h] is a source as in conflicts.
#include "core/tangents/mikktspace/vertex_path.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstring>
#include <functional>
#include <utility>

#include "core/base/sort.h"
#include "core/base/vec_math.h"
#include "core/tangents/mikktspace/groups.h"

namespace tspace::mikk {
namespace {

template <class T>
bool sameBits(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

/// Returns whether two equal vertices have equal bits. If the signs of zeros differ, only the data of the node's own
/// vertex give the bits of the reference.
bool sameData(const MeshView& mesh, std::uint32_t a, std::uint32_t b) {
    return sameBits(mesh.positions[a], mesh.positions[b]) && sameBits(mesh.normals[a], mesh.normals[b]) &&
           sameBits(mesh.uvs[a], mesh.uvs[b]);
}

class Planner {
  public:
    explicit Planner(const VertexPath& path)
        : path_(path), in_(path.setting), mesh_(in_.mesh), allocator_(in_.options.execution.allocator),
          threshold_cosine_(in_.maySplit() ? thresholdCosine(in_.options.angular_threshold_deg) : -1.0f),
          corners_(readCorners(path)), grouping_(path, corners_), splits_(in_, corners_, threshold_cosine_, allocator_),
          ends_(allocator_), members_(allocator_), repeats_(allocator_), positive_(allocator_),
          split_groups_(allocator_), split_members_(allocator_), conflicts_(allocator_), default_corners_(allocator_),
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
        if (!isKept(path_.use)) to_.terms = std::move(corners_.terms);
        return std::move(to_);
    }

  private:
    void readTriangles() {
        const std::size_t count = 3 * to_.triangle_count;
        to_.groups = Buffer<std::uint32_t>(allocator_, count, kNone);
        if (!in_.triangles.corners.empty()) to_.slots = Buffer<std::uint32_t>(allocator_, count);
        for (std::uint32_t h = 0; h < to_.slots.size(); ++h) to_.slots[h] = slotOf(h);
        if (!isKept(path_.use)) return;
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

    /// Numbers the groups of a node, splits them, and replaces the sources in to_.groups by groups.
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
        if (in_.hasPolygons()) addRepeats(groups);
        for (std::size_t i = 0; !is_done && i < groups.corners.size(); ++i) {
            const NodeCorner& corner = groups.corners[i];
            std::uint32_t& source = sources[corner.half_edge];
            if (source == kNone && !in_.hasPolygons()) default_corners_.push(slotOf(corner.half_edge));
            if ((source & kTopBit) != 0) source = kNone;
            if (corner.facing == 0) source |= kTopBit;
        }
    }

    /// Returns whether any group of the node splits.
    bool splitGroups(std::size_t place, const NodeGroups& groups) {
        if (groups.group == nullptr) return splitGroup(place, groups.corners);
        // Counting sort of the members by group; members are ascending within each group.
        ends_.drop(ends_.size());
        std::fill_n(ends_.extend(groups.count + 1), groups.count + 1, 0u);
        for (std::size_t i = 0; i < groups.corners.size(); ++i)
            ends_[groups.of(i) + 1] += groups.of(i) != kNone ? 1u : 0u;
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

    /// A corner of the mesh, and one of its half-edges at this node.
    struct Repeat {
        std::uint32_t slot, group, index;
        auto operator<=>(const Repeat&) const = default;
    };

    /// Finds corners of the mesh with several half-edges, as at a quad's diagonal: each of these half-edges becomes a
    /// conflict. Also adds corners without a group to default_corners_, once each.
    void addRepeats(const NodeGroups& groups) {
        repeats_.drop(repeats_.size());
        for (std::uint32_t i = 0; i < groups.corners.size(); ++i)
            repeats_.push({slotOf(groups.corners[i].half_edge), groups.of(i), i});
        sortList(repeats_.begin(), repeats_.end(), std::less<>());
        const Repeat *r = repeats_.begin(), *all_end = repeats_.end();
        while (r != all_end) {
            const Repeat* end = std::find_if(r, all_end, [&](const Repeat& other) { return other.slot != r->slot; });
            const Repeat* grouped = std::find_if(r, end, [](const Repeat& other) { return other.group == kNone; });
            grouped == r ? default_corners_.push(r->slot) : addRepeated(groups, r, grouped);
            r = end;
        }
    }

    void addRepeated(const NodeGroups& groups, const Repeat* first, const Repeat* end) {
        for (const Repeat* r = first; end - first > 1 && r != end; ++r) {
            const std::uint32_t half_edge = groups.corners[r->index].half_edge;
            conflicts_.push({r->slot, to_.groups[half_edge]});
            to_.slots[half_edge] |= kTopBit;
        }
    }

    /// Plans the corners of degenerate triangles: a copy, or the default if the copied corner has the default or if
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
    // Scratch memory, which is reused for each node.
    Growing<std::uint32_t> ends_;  // end of each group in members_
    Growing<NodeCorner> members_;  // corners of the node, group by group
    Growing<Repeat> repeats_;
    // Arrays of the plan, while it is built.
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

// Lists the corners of selected nodes: finds the triangles around them, computes their terms, unifies the orientation
// of each face, sorts corners by node (a counting sort), and plans copies for corners of degenerate triangles.

namespace {

constexpr std::size_t kBlockGrain = 16;

class CornerReader {
  public:
    explicit CornerReader(const VertexPath& path)
        : path_(path), in_(path.setting),
          source_(cornerSource({in_.mesh.positions, in_.mesh.normals}, in_.mesh.uvs, in_.options.method, false)),
          terms_(cornerTermsFor(in_.options.execution.simd)), allocator_(in_.options.execution.allocator),
          by_node_(in_, nullptr), to_(allocator_), good_(allocator_) {
        source_.adding_only = true;
        if (isKept(path.use) && !in_.maySplit()) source_.weighting = Weighting::none;
    }

    VertexCorners run() {
        if (!path_.are_all) findTriangles();
        count_ = path_.are_all ? in_.triangles.count : to_.found.size();
        readTriangles();
        if (!in_.triangles.faces.empty()) unifyFaces();
        countCorners();
        placeCorners();
        if (to_.report.degenerate_triangle_count != 0) planCopies();
        return std::move(to_);
    }

  private:
    void findTriangles() {
        place_of_ = Buffer<std::uint32_t>(allocator_, in_.nodes.count, kNone);
        for (std::uint32_t i = 0; i < path_.chosen.size(); ++i) place_of_[path_.chosen[i]] = i;
        const auto markOf = [places = place_of_.data(), nodes = in_.nodes.of_vertex.data()](std::uint32_t vertex) {
            return ~places[nodes == nullptr ? vertex : nodes[vertex]];
        };
        to_.found = collectTriangles(in_.mesh, in_.triangles, markOf, ~0u, allocator_, path_.parallel);
    }

    void readTriangles() {
        to_.nodes = Buffer<std::uint32_t>(allocator_, 3 * count_);
        if (!path_.are_all) to_.places = Buffer<std::uint32_t>(allocator_, 3 * count_);
        to_.flags = Buffer<std::uint8_t>(allocator_, count_);
        to_.terms = Buffer<CornerTerms>(allocator_, (count_ + kTermTriangles - 1) / kTermTriangles);
        path_.parallel.forRanges(to_.terms.size(), kBlockGrain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t block = begin; block < end; ++block) readBlock(block);
        });
        for (const std::uint8_t flags : to_.flags) {
            to_.report.degenerate_triangle_count += flags == kDegenerate ? 1 : 0;
            to_.report.degenerate_uv_count += flags == kAny ? 1 : 0;
            to_.report.mirrored_count += flags == kFacesDown ? 1 : 0;
        }
    }

    void readBlock(std::size_t block) {
        const std::size_t begin = block * kTermTriangles, count = std::min(kTermTriangles, count_ - begin);
        std::uint32_t vertices[kTermCorners], *nodes = to_.nodes.data() + 3 * begin;
        if (path_.are_all) {
            by_node_.read(begin, count, vertices, nodes);
        } else {
            by_node_.readSome(to_.found.data() + begin, count, vertices, nodes);
            std::uint32_t* const places = to_.places.data() + 3 * begin;
            const auto nowhere = static_cast<std::uint32_t>(path_.chosen.size());
            for (std::size_t i = 0; i < 3 * count; ++i) places[i] = std::min(place_of_[nodes[i]], nowhere);
        }
        // Kernels read whole blocks, so the rest of the last block needs valid vertices. A block has at least one
        // triangle.
        std::fill(vertices + 3 * count, vertices + kTermCorners, vertices[0]);
        CornerTerms& terms = to_.terms[block];
        terms_(source_, vertices, count, terms);
        std::uint8_t* flags = to_.flags.data() + begin;
        for (std::size_t t = 0; t < count; ++t) flags[t] = flagsOf(terms.marks[0][t]);
    }

    /// Counts the corners of each node, without those of degenerate triangles, and allocates their list.
    void countCorners() {
        const std::size_t chosen_count = path_.chosen.size();
        to_.facing = noMarks(allocator_, chosen_count + 1);
        to_.begin = Buffer<std::uint32_t>(allocator_, chosen_count + 3, 0u);
        std::uint8_t* facing = to_.facing.data();
        std::uint32_t *begin = to_.begin.data(), *sizes = begin + 2;
        const std::uint8_t* flags = to_.flags.data();
        const std::uint32_t* places = to_.placesOf(0);
        const std::size_t count = count_;
        for (std::size_t t = 0; t < count; ++t, places += 3) {
            const std::uint8_t of_triangle = flags[t];
            if ((of_triangle & kDegenerate) != 0) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                ++sizes[places[k]];
                facing[places[k]] |= of_triangle & kFacing;
            }
        }
        facing[chosen_count] = 0;
        // After this loop, begin[place + 1] is the start of the list of a place; placeCorners moves it to the end of
        // the list.
        for (std::size_t place = 0; place < chosen_count; ++place) begin[place + 2] += begin[place + 1];
        to_.corners = Buffer<NodeCorner>(allocator_, begin[chosen_count + 1]);
    }

    void placeCorners() {
        const auto nowhere = static_cast<std::uint32_t>(path_.chosen.size());
        std::uint32_t* const ends = to_.begin.data() + 1;
        NodeCorner* const corners = to_.corners.data();
        const std::uint32_t *n = to_.nodes.data(), *places = to_.placesOf(0);
        const std::uint8_t* const all_flags = to_.flags.data();
        const CornerTerms* const terms = to_.terms.data();
        const auto count = static_cast<std::uint32_t>(3 * count_);
        for (std::uint32_t h = 0; h < count; h += 3, n += 3, places += 3) {
            const std::uint32_t flags = all_flags[h / 3], facing = flags & kFacing;
            if ((flags & kDegenerate) != 0) continue;
            const float(*const rows)[4] = terms[h / kTermCorners].s + h % kTermCorners;
            if (places[0] != nowhere) corners[ends[places[0]]++] = {rows[0], h, n[1], n[2], facing};
            if (places[1] != nowhere) corners[ends[places[1]]++] = {rows[1], h + 1, n[2], n[0], facing};
            if (places[2] != nowhere) corners[ends[places[2]]++] = {rows[2], h + 2, n[0], n[1], facing};
        }
    }

    static std::uint8_t flagsOf(std::uint32_t marks) {
        if ((marks & kDegenerateMark) != 0) return kDegenerate;
        if ((marks & kNoUvArea) != 0) return kAny;
        return static_cast<std::uint8_t>((marks & kMirroredMark) != 0 ? kFacesDown : kFacesUp);
    }

    [[nodiscard]] float uvArea(std::size_t t) const {
        Vec2 uv[3];
        for (std::size_t k = 0; k < 3; ++k) uv[k] = in_.mesh.uvs[in_.nodes.vertex(to_.nodes[3 * t + k])];
        const Vec2 a = uv[1] - uv[0], b = uv[2] - uv[0];
        return a.x * b.y - a.y * b.x;
    }

    [[nodiscard]] std::uint32_t faceOf(std::size_t t) const { return in_.triangles.faces[to_.triangleOf(t)]; }

    /// Unifies the orientation of all triangles of a face, for every face. If the triangles of a face have different
    /// orientations, all of them have been collected.
    void unifyFaces() {
        for (std::size_t t = 1; t < count_;) {
            if (to_.flags[t] == to_.flags[t - 1] || faceOf(t) != faceOf(t - 1)) {
                ++t;
                continue;
            }
            std::size_t first = t - 1;
            while (first > 0 && faceOf(first - 1) == faceOf(t)) --first;
            while (t < count_ && faceOf(t) == faceOf(first)) ++t;
            unifyFace(first, t);
        }
    }

    /// Unifies the orientation of the triangles of one face; degenerate triangles are ignored.
    void unifyFace(std::size_t first, std::size_t end) {
        good_.drop(good_.size());
        std::uint32_t facing = 0;
        for (std::size_t t = first; t < end; ++t) {
            if ((to_.flags[t] & kDegenerate) != 0) continue;
            good_.push(static_cast<std::uint32_t>(t));
            facing |= to_.flags[t] & kFacing;
        }
        const bool degenerate_uv_may_choose = good_.size() == 2 && isAny(0) && facing != 0;
        if (facing != kFacing && !degenerate_uv_may_choose) return;
        const auto orientation = static_cast<std::uint8_t>(uvArea(orientingTriangle()) > 0 ? kFacesUp : kFacesDown);
        for (const std::uint32_t t : good_) {
            if ((to_.flags[t] & kAny) == 0) to_.flags[t] = orientation;
        }
    }

    [[nodiscard]] bool isAny(std::size_t i) const { return (to_.flags[good_[i]] & kAny) != 0; }

    /// Returns the triangle whose orientation the face uses. For a quad, it is the first triangle, unless the second
    /// has a usable UV area and the area of the first is not at least as large; for an n-gon, it is the largest
    /// triangle with a usable UV area.
    [[nodiscard]] std::size_t orientingTriangle() const {
        const auto area = [&](std::size_t i) { return std::fabs(uvArea(good_[i])); };
        if (good_.size() == 2) return good_[!isAny(1) && !(area(0) >= area(1)) ? 1 : 0];
        std::size_t chosen = 0;
        for (std::size_t i = 1; i < good_.size(); ++i) {
            if (!isAny(i) && (isAny(chosen) || area(i) > area(chosen))) chosen = i;
        }
        return good_[chosen];
    }

    /// Plans copies for corners that belong to degenerate triangles only. If the face also has valid triangles, such a
    /// corner copies the corner of the face at its own position; otherwise it copies the first valid corner of its
    /// node. (The reference searches the face's valid triangle for the position; in a quad there is only one such
    /// corner.) All corners of degenerate triangles are at selected nodes.
    void planCopies() {
        // one per corner of polygons: 1 if the corner belongs to a valid triangle, 2 if its copy is planned
        Buffer<std::uint8_t> done;
        if (!in_.triangles.faces.empty()) {
            done = Buffer<std::uint8_t>(allocator_, in_.mesh.cornerCount(), std::uint8_t{0});
            for (std::size_t t = 0; t < count_; ++t) {
                if ((to_.flags[t] & kDegenerate) != 0) continue;
                for (std::uint32_t k = 0; k < 3; ++k) done[slot(t, k)] = 1;
            }
        }
        for (std::size_t t = 0; t < count_; ++t) {
            if ((to_.flags[t] & kDegenerate) == 0) continue;
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t to = slot(t, k);
                std::uint32_t from = kNone;
                if (!done.empty()) {
                    if (done[to] != 0) continue;
                    done[to] = 2;
                    from = copiedInFace(t, k, done);
                }
                const std::span<const NodeCorner> around = to_.around(to_.placesOf(t)[k]);
                if (from == kNone && !around.empty()) from = in_.triangles.corner(to_.halfEdgeOf(around[0].half_edge));
                to_.copies.push({to, from});
            }
        }
    }

    /// Returns another corner of the triangle at the same position that also belongs to a valid triangle of the face;
    /// kNone if there is none.
    std::uint32_t copiedInFace(std::size_t t, std::uint32_t k, const Buffer<std::uint8_t>& done) const {
        const auto position = [&](std::uint32_t corner) { return in_.mesh.positions[in_.mesh.indices[corner]]; };
        for (std::uint32_t j = 1; j < 3; ++j) {
            const std::uint32_t other = slot(t, (k + j) % 3);
            if (done[other] == 1 && position(other) == position(slot(t, k))) return other;
        }
        return kNone;
    }

    [[nodiscard]] std::uint32_t slot(std::size_t t, std::uint32_t k) const {
        return in_.triangles.corner(3 * std::size_t{to_.triangleOf(t)} + k);
    }

    const VertexPath& path_;
    const NodeSetting& in_;
    CornerSource source_;
    CornerTermsFunction terms_;
    const Allocator* allocator_;
    MeshTriangles by_node_;
    VertexCorners to_;
    Buffer<std::uint32_t> place_of_;  // position in `chosen` of each node, or kNone
    std::size_t count_ = 0;           // number of triangles around the selected nodes
    Growing<std::uint32_t> good_;     // triangles of the current face that are not degenerate
};

}  // namespace

VertexCorners readCorners(const VertexPath& path) { return CornerReader(path).run(); }

}  // namespace tspace::mikk
