// SPDX-License-Identifier: MIT
// Sums of weighted face normals per point, computed with SIMD in blocks of triangles. No list of the corners around a
// point is needed: where the mean of a point vanishes, the substitute normal of each corner depends only on the
// corner's face. Ranges of points are summed, finished and written one after the other, and fit into a cache if
// triangles are stored close together.
// Based on: Thuermer & Wuethrich, "Computing Vertex Normals from Polygonal Facets", 1998.
#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "core/base/memory.h"
#include "core/base/mesh_loops.h"
#include "core/base/range_lists.h"
#include "core/base/vec_math.h"
#include "core/normals/normals_call.h"

namespace tspace {
namespace {

using smooth::FaceTerms, smooth::FaceSource, smooth::kTermGroup, smooth::kTermTriangles, smooth::kDoubtful,
    smooth::kVanished;

static_assert(kTermTriangles == TriangleBatch::kMost && kTermTriangles % kTermGroup == 0);
constexpr std::size_t kNearPoints = 32768;   ///< number of points whose sums, 1 MB, fit into typical L2 caches
constexpr std::size_t kRangesPerThread = 4;  ///< minimum number of ranges per thread

/// Weighted sum of the unit normals at a point. It is later replaced by four floats: the unit normal, and a mark whose
/// sign bit is set if there is no normal.
struct PointSum {
    double x, y, z, weights;  ///< `weights` is negative if the sum must be recomputed

    // Accessors for functions that operate on Float4.
    [[nodiscard]] float* floats() { return reinterpret_cast<float*>(this); }
    [[nodiscard]] const float* floats() const { return reinterpret_cast<const float*>(this); }

    /// Returns whether the result is marked as having no normal although triangles contribute to it.
    [[nodiscard]] bool isDoubtful() const { return isMarked(loadFloat4(floats())) && weights > 0; }
    static bool isMarked(Float4 normal) { return (laneBits(std::bit_cast<Mask4>(normal)) & 8) != 0; }

    void setMark() { *this = {0, 0, 0, -0.0}; }
    [[nodiscard]] bool isTakenAgain() const { return std::signbit(weights); }
    void add(double weight, const DVec3& term) { *this = {x + term.x, y + term.y, z + term.z, weights - weight}; }
    /// Replaces the sum by the unit mean, or marks it as having no normal.
    void finish() {
        const double length = std::sqrt(x * x + y * y + z * z);
        const bool has_mean = length > kVanished * -weights;
        const Vec3 unit = has_mean ? toFloat((1.0 / length) * DVec3{x, y, z}) : Vec3{};
        weights = -weights;
        storeFloat4(floats(), Float4{unit.x, unit.y, unit.z, has_mean ? 0.0f : -0.0f});
    }
};

/// Sums of a range of points, as rows in memory.
struct RangeSums {
    GroupRange range;
    PointSum* rows;  ///< rows of the points from range.begin on, up to the end of a group

    [[nodiscard]] PointSum& at(std::uint32_t point) const { return rows[point - range.begin]; }
};

class TriangleSmoother {
  public:
    explicit TriangleSmoother(const NormalsCall& call) : call_(call), lists_(makeLists()) {}

    /// Computes the normals. If triangles are stored close together, each range is written after it is summed, with
    /// memory for one range per task, which stays in the cache. Otherwise, and for `best`, which processes all sums
    /// before any is written, vertices get copies of the sums of their points, so that corners need not look up points,
    /// and all corners are written at the end.
    NormalReport run() {
        const bool is_near = is_near_ && !call_.is_best;
        const std::size_t ranges = lists_.count(), size = lists_.range(0).size() + kTermGroup;
        const std::size_t tasks =
            call_.parallel.width() == 1 ? 1 : std::min(ranges, kRangesPerThread * call_.parallel.width());
        sums_ = Buffer<PointSum>(call_.allocator, is_near ? tasks * size : call_.mesh.vertexCount() + kTermGroup);
        std::atomic<std::uint64_t> degenerate{0}, substitutes{0};
        call_.parallel.forTasks(tasks, [&](std::size_t task) {
            for (std::size_t r = ranges * task / tasks; r < ranges * (task + 1) / tasks; ++r) {
                const GroupRange range = lists_.range(r);
                const RangeSums place{range, sums_.data() + (is_near ? task * size : range.begin)};
                degenerate += sum(r, place);
                if (is_near) substitutes += write({call_.items, lists_, r}, place);
            }
        });
        if (call_.is_best)
            smooth::refine(call_, call_.items, 3,
                           {reinterpret_cast<Vec3*>(sums_.data()), call_.mesh.vertexCount(), sizeof(PointSum)}, {});
        if (!is_near) {
            for (std::size_t v = 0; v < call_.points.size(); ++v) {
                if (call_.points[v] != v) sums_[v] = sums_[call_.points[v]];
            }
            const Buffer<std::uint32_t> own;
            const PointItems vertices(call_.mesh, call_.faces, own, call_.allocator);
            const RangeSums all{{0, static_cast<std::uint32_t>(call_.mesh.vertexCount())}, sums_.data()};
            call_.parallel.forRanges(lists_.blockCount(vertices.count), Parallel::kGrain / kTermTriangles,
                                     [&](std::size_t begin, std::size_t end) {
                                         substitutes += write({vertices, kTermTriangles, begin, end}, all);
                                     });
        }
        return {call_.items.count, degenerate, substitutes};
    }

  private:
    /// Creates the ranges. Small ranges are used if blocks of triangles are compact. Otherwise each thread has one
    /// range, because more ranges would only read the triangles more often.
    [[nodiscard]] RangeLists makeLists() {
        const std::size_t points = call_.mesh.vertexCount();
        const std::size_t width = call_.items.count < Parallel::kGrain ? 1 : call_.parallel.width();
        const std::size_t shared = std::max(std::bit_floor(points / (kRangesPerThread * width)), kTermGroup);
        const std::size_t near = width == 1 ? kNearPoints : std::min(kNearPoints, shared);
        is_near_ = near < points && RangeLists::areCompact(call_.items, kTermTriangles, points, near);
        if (!is_near_) return {kTermTriangles, points, std::bit_ceil((points + width - 1) / width)};
        return {call_.items, kTermTriangles, points, near, call_.allocator, call_.parallel};
    }

    /// Computes the unit normals of a range; returns the number of degenerate triangles whose first point is in it.
    std::uint64_t sum(std::size_t index, const RangeSums& place) const {
        const GroupRange range = place.range;
        const std::size_t size = (range.size() + kTermGroup - 1) / kTermGroup * kTermGroup;
        std::memset(place.rows, 0, size * sizeof(PointSum));
        double* const sums = &place.rows->x;
        const FaceSource source = call_.source(call_.posed, call_.by_angle, call_.by_area);
        TriangleBatch batch;
        FaceTerms terms;
        std::uint64_t degenerate = 0;
        for (RangeLists::Batches batches(call_.items, lists_, index); batches.next(batch);) {
            const std::uint32_t* const v = fillGroup(batch.vertices, batch.count, kTermGroup, batch.own_vertices);
            const std::size_t without_area = call_.kernel.compute(source, v, batch.count, terms);
            for (std::size_t t = 0; without_area != 0 && t < batch.count; ++t)
                degenerate += terms.normal[t][3] == 0.0 && range.has(batch.groups[3 * t]) ? 1u : 0u;
            call_.kernel.add(terms, batch.groups, batch.count, sums, range.begin, range.end);
        }
        // In double precision, squares of sums of products of floats neither overflow nor underflow.
        if (call_.kernel.finish(sums, size, kDoubtful) != 0) [[unlikely]]
            sumDoubtful(index, place);
        return degenerate;
    }

    /// Recomputes the marked sums, with angles in double precision.
    void sumDoubtful(std::size_t index, const RangeSums& place) const {
        PointSum* const end = place.rows + place.range.size();
        for (PointSum* row = place.rows; row != end; ++row) {
            if (row->isDoubtful()) row->setMark();
        }
        TriangleBatch batch;
        for (RangeLists::Batches batches(call_.items, lists_, index); batches.next(batch);) {
            for (std::size_t t = 0; t < batch.count; ++t)
                addExactly(batch.vertices + 3 * t, batch.groups + 3 * t, place);
        }
        for (PointSum* row = place.rows; row != end; ++row) {
            if (row->isTakenAgain()) row->finish();
        }
    }

    void addExactly(const std::uint32_t* v, const std::uint32_t* points, const RangeSums& place) const {
        for (std::size_t k = 0; k < 3; ++k) {
            if (!place.range.has(points[k]) || !place.at(points[k]).isTakenAgain()) continue;
            const DVec3 here = toDouble(call_.posed.positions[v[k]]);
            const DVec3 e1 = toDouble(call_.posed.positions[v[(k + 1) % 3]]) - here;
            const DVec3 e2 = toDouble(call_.posed.positions[v[(k + 2) % 3]]) - here;
            const DVec3 turn = cross(e1, e2);
            const double size = length(turn);
            if (!(size > 0) || !std::isfinite(size)) return;
            const double weight = (call_.by_angle ? polarAngle(dot(e1, e2), size) : 1) * (call_.by_area ? size : 1);
            place.at(points[k]).add(weight, (weight * call_.factor / size) * turn);
        }
    }

    /// Writes the corners of triangles at the points of a range; returns the number of substitutes.
    std::uint64_t write(RangeLists::Batches batches, const RangeSums& place) const {
        std::uint64_t substitutes = 0;
        TriangleBatch batch;
        while (batches.next(batch, false)) {
            if (!batch.is_whole || !writeBlock(batch, place)) substitutes += writeEach(batch, place);
        }
        return substitutes;
    }

    /// Writes a block. Returns false if a corner has no normal (see PointSum).
    bool writeBlock(const TriangleBatch& batch, const RangeSums& place) const {
        auto* to = reinterpret_cast<std::byte*>(&call_.out[std::size_t{3} * batch.numbers[0]]);
        // Local copies, which the compiler knows not to alias the arrays that are written.
        const RangeSums sums = place;
        const std::uint32_t* const points = batch.groups;
        const auto normalAt = [&](std::size_t i) __attribute__((always_inline)) {
            return loadFloat4(sums.at(points[i]).floats());
        };
        const std::size_t count = 3 * batch.count, stride = call_.out.stride_bytes;
        Float4 marks = splat(0.0f);
        std::size_t i = 0;
        if (stride == sizeof(Vec3)) {
            prefetchLines<true>(to, count * sizeof(Vec3));
            for (; i + 4 <= count; i += 4, to += 4 * sizeof(Vec3)) {
                const Float4 a = normalAt(i), b = normalAt(i + 1), c = normalAt(i + 2), d = normalAt(i + 3);
                marks = or4(or4(marks, or4(a, b)), or4(c, d));
                auto* const floats = reinterpret_cast<float*>(to);
                const Float4 az_bx = __builtin_shufflevector(a, b, 2, 2, 4, 4);
                const Float4 cz_dx = __builtin_shufflevector(c, d, 2, 2, 4, 4);
                storeFloat4(floats, __builtin_shufflevector(a, az_bx, 0, 1, 4, 6));
                storeFloat4(floats + 4, __builtin_shufflevector(b, c, 1, 2, 4, 5));
                storeFloat4(floats + 8, __builtin_shufflevector(cz_dx, d, 0, 2, 5, 6));
            }
        }
        for (; i < count; ++i, to += stride) {
            const Float4 normal = normalAt(i);
            marks = or4(marks, normal);
            storeVec3(*reinterpret_cast<Vec3*>(to), normal);
        }
        return !PointSum::isMarked(marks);
    }

    /// Writes the corners at the points of a range one by one; returns the number of substitutes.
    [[gnu::noinline]] std::uint64_t writeEach(const TriangleBatch& batch, const RangeSums& place) const {
        std::uint64_t substitutes = 0;
        for (std::size_t i = 0; i < 3 * batch.count; ++i) {
            if (!place.range.has(batch.groups[i])) continue;
            const Float4 normal = loadFloat4(place.at(batch.groups[i]).floats());
            Vec3& to = call_.out[std::size_t{3} * batch.number(i / 3) + i % 3];
            storeVec3(to, normal);
            if (!PointSum::isMarked(normal)) [[likely]]
                continue;
            to = ownNormal(batch.number(i / 3));
            ++substitutes;
        }
        return substitutes;
    }

    /// Returns the substitute for a mean that vanished.
    [[nodiscard]] Vec3 ownNormal(std::size_t triangle) const {
        std::uint32_t vertices[3 * kTermGroup];
        FaceTerms terms;
        const std::uint32_t* const v = readIndices(call_.mesh.indices, 3 * triangle, 3, vertices);
        call_.kernel.compute(call_.source(call_.posed, false, false), fillGroup(v, 1, kTermGroup, vertices), 1, terms);
        const double(&normal)[4] = terms.normal[0];
        return normal[3] == 0.0 ? Vec3{0, 0, 1} : toFloat({normal[0], normal[1], normal[2]});
    }

    const NormalsCall& call_;
    bool is_near_ = false;
    RangeLists lists_;
    Buffer<PointSum> sums_;  ///< sums of one range per task; for `best`, sums of all points
};

}  // namespace

NormalReport smoothTriangles(const NormalsCall& call) { return TriangleSmoother(call).run(); }

}  // namespace tspace
