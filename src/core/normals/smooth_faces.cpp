// SPDX-License-Identifier: MIT
// General path of normal smoothing, which processes ranges of points: the corners at each point are collected with
// their face normals and weights; then the components around each point are found, and the mean of each is computed.
// The kernel computes normals and angles of triangles.
// Based on: Gouraud 1971 (uniform); Thuermer & Wuethrich, "Computing Vertex Normals from Polygonal Facets", 1998
// (angle); Max, "Weights for Computing Vertex Normals from Facet Normals", 1999 (max).
#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

#include "core/base/range_lists.h"
#include "core/base/vec_math.h"
#include "core/normals/normals_call.h"

namespace tspace {
namespace {

using smooth::FaceTerms, smooth::kDoubtful, smooth::kTermTriangles, smooth::kVanished;

// maximum and minimum number of points per range, and number of ranges of a small mesh
constexpr std::size_t kMostRange = 4096, kLeastRange = 64, kRanges = 8;
constexpr std::uint32_t kNoPoint = ~std::uint32_t{0};
constexpr std::size_t kItemsPerTask = 1024;

/// Presents corners as triangles to `best`. The triangle of a corner consists of it and its two neighbors in the face;
/// only the corner itself contributes, to the sum of its component.
class ComponentCorners final : public TriangleGroups {
  public:
    /// flag of a corner whose face is degenerate and contributes nothing
    static constexpr std::uint32_t kExcluded = 0x80000000u;

    /// `components`: the lowest corner of each corner's component, with the flag kExcluded for excluded corners.
    ComponentCorners(const MeshView& mesh, const MeshFaces& faces, const Buffer<std::uint32_t>& components)
        : TriangleGroups(components.size()), mesh_(mesh), faces_(faces), components_(components) {}

    void read(std::size_t first, std::size_t size, std::uint32_t* vertices, std::uint32_t* groups) const override {
        for (std::size_t i = 0; i < size; ++i) {
            const auto corner = static_cast<std::uint32_t>(first + i);
            // Excluded corners use index `count`, which has a dummy entry.
            const auto own =
                (components_[corner] & kExcluded) != 0 ? static_cast<std::uint32_t>(count) : components_[corner];
            std::fill_n(groups + 3 * i, 3, own);
            if (vertices == nullptr) continue;
            const MeshFaces::Around around = faces_.around(corner);
            for (std::size_t k = 0; k < 3; ++k) {
                if (k != 0) groups[3 * i + k] = components_[around.corners[k]] & ~kExcluded;
                vertices[3 * i + k] = mesh_.indices[around.corners[k]];
            }
        }
    }

  private:
    const MeshView& mesh_;
    const MeshFaces& faces_;
    const Buffer<std::uint32_t>& components_;
};

/// Weighted sum of normals at a point.
struct Sum {
    static constexpr double kLeastExact = 1e-140;  ///< length below which squares are rounded coarsely
    using Pair = double __attribute__((vector_size(16)));
    Pair xy = {}, z_weights = {};

    void add(double weight, const FaceRow& row) {
        xy += weight * Pair{row.x, row.y};
        z_weights += weight * Pair{row.z, row.size};
    }
    /// Writes the unit mean; returns false if it is not above `least` times the weights.
    [[nodiscard]] bool write(double least, Vec3& out) const {
        DVec3 sum{xy[0], xy[1], z_weights[0]};
        double l = length(sum), weights = z_weights[1];
        if (l < kLeastExact) {  // weights of `max` may be so small that their squares underflow; sums never overflow
            sum = (1 / kLeastExact) * sum;
            weights *= 1 / kLeastExact;
            l = length(sum);
        }
        if (!(l > least * weights)) return false;
        out = toFloat((1 / l) * sum);
        return true;
    }
};

/// Returns the interior angle, above pi at reflex corners, so that the weight of a polygon does not depend on its
/// triangulation.
double interiorAngle(const DVec3& e1, const DVec3& e2, const DVec3& outward) {
    const DVec3 turn = cross(e1, e2);
    const double angle = polarAngle(dot(e1, e2), length(turn));
    return dot(turn, outward) < 0 ? 2 * kPi - angle : angle;
}

double maxWeight(const DVec3& e1, const DVec3& e2) {
    const double lengths = dot(e1, e1) * dot(e2, e2);
    return lengths > 0 ? length(cross(e1, e2)) / lengths : 0;
}

/// Arguments that all ranges share.
struct Setting {
    explicit Setting(const NormalsCall& c) : call(c), rule(c) {}

    /// Returns the weight of a face's row at a corner, in double precision. A face that visits a point with several
    /// consecutive corners (a collapsed edge) is counted once, at the first of them: the others have weight 0.
    [[nodiscard]] double weightOf(NormalWeighting by, std::uint32_t point, std::uint32_t corner,
                                  const FaceRow& row) const {
        const std::uint32_t previous = call.faces.previous(corner);
        if (row.isDegenerate() || call.items.pointOf(previous) == point) return 0;
        if (by != NormalWeighting::angle && by != NormalWeighting::angleArea && by != NormalWeighting::max) return 1;
        std::uint32_t next = call.faces.next(corner);
        // This loop ends, because `previous` is another point.
        while (call.items.pointOf(next) == point) next = call.faces.next(next);
        const auto position = [&](std::uint32_t c) { return toDouble(call.posed.positions[call.mesh.indices[c]]); };
        const DVec3 here = position(corner), e1 = position(next) - here, e2 = position(previous) - here;
        return by == NormalWeighting::max ? maxWeight(e1, e2) / row.size
                                          : interiorAngle(e1, e2, call.factor * DVec3{row.x, row.y, row.z});
    }

    const NormalsCall& call;
    SmoothingRule rule;
    // Arrays for `best`, one entry per corner: the means by `max` (zero for a mean that vanished), and components for
    // ComponentCorners.
    Vec3* sharp = nullptr;
    std::uint32_t* components = nullptr;
};

/// Scratch memory for one range of points.
struct RangeMemory {
    FaceRow* rows;      ///< row of each triangle, computed from the pose
    FaceRow* deciding;  ///< rows of the mesh, which determine hard edges; equal to `rows` without a pose
    LocalTriangle* triangles;
    Link* links;
    /// `entries`: corners, grouped by point; `begins`: first entry of each point; `parents`: scratch for findComponents
    std::uint32_t *entries, *parents, *begins;
};

class RangeWork {
  public:
    RangeWork(const Setting& setting, const RangeMemory& room)
        : setting_(setting), call_(setting.call), memory_(room) {}

    /// Reads the triangles at the points of a range; returns the number of degenerate faces, each counted once.
    std::uint64_t read(GroupRange range, RangeLists::Batches items) {
        first_ = range.begin;
        count_ = static_cast<std::uint32_t>(range.size());
        size_ = 0;
        degenerate_ = 0;
        std::fill_n(memory_.begins, count_ + 3, 0u);
        while (items.next(batch_, call_.are_triangles)) call_.are_triangles ? addTriangles() : addCorners();
        sortByPoint();
        return degenerate_;
    }

    /// Writes the means of a range, or their substitutes; returns the number of corners with a substitute.
    std::uint64_t average() {
        std::uint64_t substitutes = 0;
        for (std::uint32_t p = 0; p < count_; ++p) {
            const std::uint32_t begin = memory_.begins[p], count = memory_.begins[p + 1] - begin;
            if (count == 0) continue;
            const PointCorners at{first_ + p, count, memory_.entries + begin, memory_.triangles};
            const Link* const links =
                findComponents(setting_.rule, memory_.deciding, at, memory_.links, memory_.parents);
            for (std::uint32_t first = 0, past = 0; first < count; first = past) {
                while (past < count && links[past].key == links[first].key) ++past;
                for (std::uint32_t i = first; call_.shared != nullptr && i < past; ++i)
                    call_.shared[at.corner(links[i].slot)] = at.corner(links[first].slot);
                substitutes += write(at, links + first, past - first);
            }
        }
        return substitutes;
    }

  private:
    /// Returns the index of a point in `begins`; all points of other ranges share one index.
    [[nodiscard]] std::uint32_t placeOf(std::uint32_t point) const { return std::min(point - first_, count_); }
    /// Counts an entry of a point, as the first step of a counting sort of entries by point. `begins` counts two
    /// entries ahead, so that after summing and filling it contains the begin of each point.
    void countAt(std::uint32_t point) { ++memory_.begins[placeOf(point) + 2]; }
    void enter(std::uint32_t point, std::uint32_t entry) {
        memory_.entries[memory_.begins[placeOf(point) + 1]++] = entry;
    }

    void addTriangles() {
        const std::size_t count = batch_.count;
        const std::uint32_t* const v = fillGroup(batch_.vertices, count, smooth::kTermGroup, batch_.own_vertices);
        if (memory_.deciding != memory_.rows) {
            call_.kernel.compute(call_.source(call_.mesh, false, false), v, count, terms_);
            std::memcpy(memory_.deciding + size_, terms_.normal, count * sizeof(FaceRow));
        }
        const std::size_t degenerate =
            call_.kernel.compute(call_.source(call_.posed, call_.by_angle, call_.by_area), v, count, terms_);
        std::memcpy(memory_.rows + size_, terms_.normal, count * sizeof(FaceRow));
        for (std::size_t t = 0; t < count; ++t) {
            const std::uint32_t* const p = batch_.groups + 3 * t;
            memory_.triangles[size_ + t] = {{p[0], p[1], p[2], p[0], p[1]},
                                            3 * batch_.number(t),
                                            {terms_.angle[0][t], terms_.angle[1][t], terms_.angle[2][t]}};
            for (std::size_t k = 0; k < 3; ++k) countAt(p[k]);
        }
        if (degenerate != 0 || call_.weighting == NormalWeighting::max || memory_.deciding != memory_.rows)
            computeSpecialCases();
        size_ += static_cast<std::uint32_t>(count);
    }

    /// Handles what the kernel does not: counts degenerate triangles, computes the weights of `max`, and sets the
    /// weight of a repeated corner of a collapsed edge to 0. With a pose, such a triangle need not be degenerate.
    void computeSpecialCases() {
        for (std::size_t t = size_; t < size_ + batch_.count; ++t) {
            LocalTriangle& triangle = memory_.triangles[t];
            const FaceRow& row = memory_.rows[t];
            if (row.isDegenerate() && placeOf(triangle.points[0]) < count_) ++degenerate_;
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t point = triangle.points[k];
                if (call_.weighting == NormalWeighting::max)
                    triangle.weights[k] = setting_.weightOf(NormalWeighting::max, point, triangle.corner + k, row);
                else if (triangle.points[k + 2] == point)
                    triangle.weights[k] = 0;
            }
        }
    }

    /// Adds the corners of faces that are not triangles, which are items of their own.
    void addCorners() {
        for (std::size_t i = 0; i < batch_.count; ++i) {
            const std::uint32_t corner = batch_.number(i), point = batch_.groups[3 * i], face = call_.faces.of(corner);
            if (placeOf(point) == count_) continue;
            const std::uint32_t next = call_.items.pointOf(call_.faces.next(corner));
            const std::uint32_t previous = call_.items.pointOf(call_.faces.previous(corner));
            addFace(face);
            const FaceRow& row = memory_.rows[size_];
            if (row.isDegenerate() && corner == call_.faces.first(face)) ++degenerate_;
            memory_.triangles[size_++] = {{point, next, previous, kNoPoint, kNoPoint},
                                          corner,
                                          {setting_.weightOf(call_.weighting, point, corner, row), 0, 0}};
            countAt(point);
        }
    }

    void addFace(std::uint32_t face) {
        if (size_ != 0 && face == last_face_) {
            memory_.rows[size_] = memory_.rows[size_ - 1];
            memory_.deciding[size_] = memory_.deciding[size_ - 1];
            return;
        }
        last_face_ = face;
        const std::uint32_t first = call_.faces.first(face), past = call_.faces.past(face);
        memory_.rows[size_] = faceRow(call_.posed, first, past, call_.factor, call_.by_area);
        if (memory_.deciding != memory_.rows)
            memory_.deciding[size_] = faceRow(call_.mesh, first, past, call_.factor, false);
    }

    void sortByPoint() {
        for (std::uint32_t p = 2; p < count_ + 3; ++p) memory_.begins[p] += memory_.begins[p - 1];
        for (std::uint32_t t = 0; t < size_; ++t) {
            const std::uint32_t* const p = memory_.triangles[t].points;
            enter(p[0], 4 * t);
            if (!call_.are_triangles) continue;
            enter(p[1], 4 * t + 1);
            enter(p[2], 4 * t + 2);
        }
    }

    std::uint64_t write(const PointCorners& at, const Link* links, std::uint32_t count) {
        Vec3 normal;
        if (!mean(at, links, count, normal)) {
            writeSubstitutes(at, links, count);
            return count;
        }
        for (std::uint32_t i = 0; i < count; ++i) call_.out[at.corner(links[i].slot)] = normal;
        if (call_.is_best && exactMean(NormalWeighting::max, at, links, count, normal))
            writeSharp(at, links, count, normal);
        return 0;
    }

    void writeSharp(const PointCorners& at, const Link* links, std::uint32_t count, const Vec3& normal) const {
        for (std::uint32_t i = 0; i < count; ++i) {
            const bool adds = !memory_.rows[at.triangle(links[i].slot)].isDegenerate();
            setting_.sharp[at.corner(links[i].slot)] = normal;
            setting_.components[at.corner(links[i].slot)] =
                at.corner(links[0].slot) | (adds ? 0 : ComponentCorners::kExcluded);
        }
    }

    bool mean(const PointCorners& at, const Link* links, std::uint32_t count, Vec3& normal) const {
        Sum sum;
        for (std::uint32_t i = 0; i < count; ++i)
            sum.add(at.weight(links[i].slot), memory_.rows[at.triangle(links[i].slot)]);
        return sum.write(kDoubtful, normal) || exactMean(call_.weighting, at, links, count, normal);
    }
    [[gnu::noinline]] bool exactMean(NormalWeighting weighting, const PointCorners& at, const Link* links,
                                     std::uint32_t count, Vec3& normal) const {
        Sum sum;
        for (std::uint32_t i = 0; i < count; ++i) {
            const FaceRow& row = memory_.rows[at.triangle(links[i].slot)];
            sum.add(setting_.weightOf(weighting, at.point, at.corner(links[i].slot), row), row);
        }
        return sum.write(kVanished, normal);
    }

    /// Writes the substitute for corners without a mean: the normal of their face, or the mean of the other corners at
    /// their point.
    [[gnu::noinline]] void writeSubstitutes(const PointCorners& at, const Link* links, std::uint32_t count) {
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t corner = at.corner(links[i].slot);
            const FaceRow& row = memory_.rows[at.triangle(links[i].slot)];
            if (!row.isDegenerate()) {
                call_.out[corner] = toFloat(row.unit());
                continue;
            }
            if (others_point_ != at.point) {  // computed once per point, however many components vanish
                others_point_ = at.point;
                const Link* const all = oneComponent(at.count, memory_.links + at.count);
                if (!mean(at, all, at.count, of_others_)) of_others_ = {0, 0, 1};
            }
            call_.out[corner] = of_others_;
        }
    }

    const Setting& setting_;
    const NormalsCall& call_;
    RangeMemory memory_;
    std::uint32_t first_ = 0, count_ = 0;  ///< first point and number of points of the current range
    std::uint32_t size_ = 0;               ///< number of local triangles
    std::uint32_t last_face_ = 0;
    std::uint64_t degenerate_ = 0;
    std::uint32_t others_point_ = kNoPoint;
    Vec3 of_others_;  ///< mean of all corners at point others_point_
    TriangleBatch batch_;
    FaceTerms terms_;
};

}  // namespace

NormalReport smoothFaces(const NormalsCall& call) {
    const std::size_t corner_count = call.mesh.cornerCount(), point_count = call.mesh.vertexCount();
    if (call.faces.usedCount() != call.mesh.faceCount()) {
        for (std::size_t c = 0; c < corner_count; ++c) {
            if (!call.faces.isUsed(call.faces.of(static_cast<std::uint32_t>(c)))) call.out[c] = {};
        }
    }
    NormalReport report{call.faces.usedCount(), 0, 0};
    if (report.face_count == 0) return report;

    Setting setting(call);
    Parallel& parallel = call.parallel;
    const std::size_t most_tasks = std::clamp<std::size_t>(call.items.count / kItemsPerTask, 1, parallel.width());
    const std::size_t range_points =
        std::clamp(std::bit_floor(point_count / (kRanges * most_tasks)), kLeastRange, kMostRange);
    const RangeLists lists(call.items, kTermTriangles, point_count, range_points, call.allocator, parallel);
    const std::size_t tasks = std::min(lists.count(), most_tasks);
    const bool has_pose = !setting.rule.connectsAll() && call.mesh.positions.data != call.posed.positions.data;
    const std::size_t items = lists.mostTriangles(call.items.count), corners = (call.are_triangles ? 3 : 1) * items;
    const std::size_t numbers_each = 2 * corners + lists.range(0).size() + 3;
    Buffer<FaceRow> rows(call.allocator, tasks * items), deciding(call.allocator, has_pose ? tasks * items : 0);
    Buffer<LocalTriangle> triangles(call.allocator, tasks * items);
    Buffer<Link> links(call.allocator, tasks * 2 * corners);
    Buffer<std::uint32_t> numbers(call.allocator, tasks * numbers_each);
    const auto roomOf = [&](std::size_t task) -> RangeMemory {
        std::uint32_t* const mine = numbers.data() + task * numbers_each;
        return {rows.data() + task * items,
                (has_pose ? deciding : rows).data() + task * items,
                triangles.data() + task * items,
                links.data() + task * 2 * corners,
                mine,
                mine + corners,
                mine + 2 * corners};
    };
    Buffer<Vec3> sharp;
    Buffer<std::uint32_t> components;
    if (call.is_best) {
        sharp = Buffer<Vec3>(call.allocator, corner_count + smooth::kPaddingVectors, Vec3{});
        components = Buffer<std::uint32_t>(call.allocator, corner_count);
        std::iota(components.begin(), components.end(), 0u);
        setting.sharp = sharp.data();
        setting.components = components.data();
    }
    std::atomic<std::uint64_t> degenerate{0}, substitutes{0};
    parallel.forTasks(tasks, [&](std::size_t task) {
        RangeWork work(setting, roomOf(task));
        for (std::size_t r = lists.count() * task / tasks; r < lists.count() * (task + 1) / tasks; ++r) {
            degenerate += work.read(lists.range(r), {call.items, lists, r});
            substitutes += work.average();
        }
    });
    report.degenerate_face_count = degenerate;
    report.fallback_corner_count = substitutes;
    if (call.is_best) {
        smooth::refine(call, ComponentCorners(call.mesh, call.faces, components), 1, call.out, std::move(sharp));
        parallel.forRanges(corner_count, Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c) {
                const std::uint32_t component = components[c] & ~ComponentCorners::kExcluded;
                if (component != c) call.out[c] = call.out[component];
                components[c] = component;
            }
        });
        if (call.components != nullptr) *call.components = std::move(components);
    }
    return report;
}

}  // namespace tspace
