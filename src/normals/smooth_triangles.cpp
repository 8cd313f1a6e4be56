// SPDX-License-Identifier: MIT
// Sums of weighted face normals per point, in blocks of triangles whose arithmetic is SIMD. No list of the
// corners around a point is needed: where its mean vanishes, a corner's substitute depends on its own face.
// Based on: Thuermer & Wuethrich, "Computing Vertex Normals from Polygonal Facets", 1998.
#include "normals/smooth_triangles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "core/angle.h"
#include "core/float4.h"
#include "core/sum_ranges.h"
#include "core/vec_math.h"
#include "core/vertex_ranges.h"
#include "normals/best_triangles.h"
#include "normals/face_terms.h"
#include "normals/weld.h"

namespace tspace {

namespace {

using smooth::FaceTerms, smooth::FaceSource, smooth::kTermGroup;

constexpr std::size_t kBlock = VertexRanges::kBlock;
static_assert(kBlock == smooth::kTermTriangles && kBlock % kTermGroup == 0);
constexpr std::size_t kGrain = 16384;
// In triangles. An estimate, from some 50 us for a thread to start; not yet measured on idle cores.
constexpr std::size_t kWorthThreads = 16384;

// Below the first fraction of the weights a sum is what rounding left of normals that cancel. Below the
// second it shows how single-precision angles were rounded: it is then taken again, with angles in double.
constexpr double kVanished = 1e-10, kDoubtful = 1e-2;

/// The weighted sum of the unit normals at a point. Later its place holds four floats: the normal, and a mark
/// whose sign is set when there is none.
struct PointSum {
    double x, y, z, weights;

    /// Writes the unit mean, or the mark when the mean is not above `least`; returns which.
    bool finish(double least, float* floats) const {
        const double length = std::sqrt(x * x + y * y + z * z);
        if (length > least * weights) [[likely]] {
            const Vec3 unit = toFloat((1.0 / length) * DVec3{x, y, z});
            storeFloat4(floats, Float4{unit.x, unit.y, unit.z, 0.0f});
            return true;
        }
        storeFloat4(floats, Float4{0.0f, 0.0f, 0.0f, -0.0f});
        return false;
    }
    // For the functions of float4.h.
    [[nodiscard]] float* floats() { return reinterpret_cast<float*>(this); }
    [[nodiscard]] const float* floats() const { return reinterpret_cast<const float*>(this); }

    /// Has the mark although something was added.
    [[nodiscard]] bool isDoubtful() const { return isMarked(loadFloat4(floats())) && weights > 0; }
    static bool isMarked(Float4 normal) { return (laneBits(std::bit_cast<Mask4>(normal)) & 8) != 0; }

    // A doubtful place can also hold a number.
    void setNumber(std::size_t number) { weights = static_cast<double>(number + 1); }
    [[nodiscard]] std::size_t number() const { return static_cast<std::size_t>(weights) - 1; }
};

/// A block of triangles: their vertices and points where these are not read from the mesh, and what they add.
struct Block {
    std::uint32_t vertices[3 * kBlock];
    std::uint32_t points[3 * kBlock];
    FaceTerms terms;
};

/// Whole groups are read, so the last one is filled up. The triangles' vertices: `vertices`, or `buffer`, which may be
/// the same.
const std::uint32_t* fillGroup(const std::uint32_t* vertices, std::size_t count, std::uint32_t* buffer) {
    const std::size_t end = (count + kTermGroup - 1) / kTermGroup * kTermGroup;
    if (end == count) return vertices;
    if (vertices != buffer) std::copy_n(vertices, 3 * count, buffer);
    std::fill(buffer + 3 * count, buffer + 3 * end, buffer[0]);
    return buffer;
}

class TriangleSmoother {
  public:
    /// Vertices are welded by the mesh's positions; all else is computed from `positions`.
    TriangleSmoother(const MeshView& mesh, const StridedSpan<const Vec3>& positions, const NormalOptions& options,
                     StridedSpan<Vec3> out, Parallel& parallel)
        : mesh_(mesh),
          positions_(positions),
          options_(options),
          is_best_(options.weighting == NormalWeighting::best),
          by_angle_(options.weighting == NormalWeighting::angle ||
                    options.weighting == NormalWeighting::angleArea || is_best_),
          by_area_(options.weighting == NormalWeighting::area ||
                   options.weighting == NormalWeighting::angleArea || is_best_),
          factor_(normalFactor(options.convention)),
          kernel_(smooth::faceKernelFor(options.execution.simd)),
          out_(out),
          allocator_(options.execution.allocator),
          parallel_(parallel),
          triangle_count_(mesh.faceCount()),
          ranges_(mesh.vertexCount()) {
        if (options.weld_positions) points_ = weldPositions(mesh, allocator_, parallel_);
        sums_ = Buffer<PointSum>(allocator_, mesh.vertexCount());
    }

    NormalReport run() {
        if (parallel_.width() > 1 && triangle_count_ >= kWorthThreads) {
            const auto points = [&](std::size_t first, std::size_t count, std::uint32_t* buffer) {
                return pointsOf(blockVertices(mesh_.indices, first, count, buffer), count, buffer);
            };
            ranges_.cut(parallel_.width(), triangle_count_, points, allocator_, parallel_);
        }
        std::array<std::uint64_t, VertexRanges::kMostRanges> degenerate{}, doubtful{};
        parallel_.forTasks(ranges_.count(), [&](std::size_t task) {
            const auto index = static_cast<unsigned>(task);
            degenerate[task] = sum(index);
            doubtful[task] = finish(ranges_.range(index));
        });
        NormalReport report{triangle_count_, 0, 0};
        for (const std::uint64_t count : degenerate) report.degenerate_face_count += count;
        if (const auto count = std::accumulate(doubtful.begin(), doubtful.end(), std::uint64_t{0});
            count != 0) {
            sumDoubtful(count);
        }
        if (is_best_) smooth::refineTriangles(mesh_, positions_, points_, options_, sums_.data()->floats(), parallel_);
        copyToRepeated();
        report.fallback_corner_count =
            sumRanges(parallel_, triangle_count_, kGrain,
                      [&](std::size_t begin, std::size_t end) { return writeCorners(begin, end); });
        return report;
    }

  private:
    /// The points of the corners of `count` triangles: `vertices` itself or `buffer`, which may be the same.
    const std::uint32_t* pointsOf(const std::uint32_t* vertices, std::size_t count,
                                  std::uint32_t* buffer) const {
        if (points_.empty()) return vertices;
        for (std::size_t i = 0; i < 3 * count; ++i) buffer[i] = points_[vertices[i]];
        return buffer;
    }

    /// Sums at the points of a range; returns the degenerate triangles whose first point is in it.
    std::uint64_t sum(unsigned index) {
        const VertexRange range = ranges_.range(index);
        std::fill(sums_.data() + range.begin, sums_.data() + range.end, PointSum{});
        double* const sums = &sums_.data()->x;
        const FaceSource source = faceSource(by_angle_, by_area_);
        Block block;
        std::uint64_t degenerate = 0;
        for (std::size_t first = 0, b = 0; first < triangle_count_; first += kBlock, ++b) {
            if (!ranges_.names(b, index)) continue;
            std::size_t count = std::min(kBlock, triangle_count_ - first);
            const std::uint32_t* v = blockVertices(mesh_.indices, first, count, block.vertices);
            const std::uint32_t* points = pointsOf(v, count, block.points);
            if (ranges_.namesOnly(b, index)) {
                kernel_.compute(source, fillGroup(v, count, block.vertices), count, block.terms);
                degenerate += kernel_.add(block.terms, points, count, sums);
            } else {
                count = select(v, points, count, range, block);
                kernel_.compute(source, fillGroup(block.vertices, count, block.vertices), count, block.terms);
                degenerate += kernel_.add_some(block.terms, block.points, count, sums, range.begin, range.end);
            }
        }
        return degenerate;
    }

    [[nodiscard]] FaceSource faceSource(bool by_angle, bool by_area) const {
        FaceSource source;
        source.positions = reinterpret_cast<const std::byte*>(positions_.data);
        source.stride = positions_.stride_bytes;
        source.last_vertex = static_cast<std::uint32_t>(positions_.count - 1);
        source.factor = factor_;
        source.by_angle = by_angle;
        source.by_area = by_area;
        return source;
    }

    /// Takes the triangles that have a point in the range, and returns how many.
    static std::size_t select(const std::uint32_t* v, const std::uint32_t* points, std::size_t count,
                              VertexRange range, Block& block) {
        std::size_t taken = 0;
        for (std::size_t i = 0; i < 3 * count; i += 3) {
            bool any = false;
            for (std::size_t k = 0; k < 3; ++k) {
                any |= points[i + k] - range.begin < range.end - range.begin;
                block.vertices[3 * taken + k] = v[i + k];
                block.points[3 * taken + k] = points[i + k];
            }
            taken += any ? 1 : 0;
        }
        return taken;
    }

    /// Turns sums into unit normals and returns how many are doubtful. Sums of products of floats neither
    /// overflow nor vanish when squared.
    std::uint64_t finish(VertexRange range) {
        PointSum* const end = sums_.data() + range.end;
        PointSum* place = sums_.data() + range.begin;
        const std::size_t whole_groups = (range.end - range.begin) / kTermGroup * kTermGroup;
        std::uint64_t doubtful = kernel_.finish(&place->x, whole_groups, kDoubtful);
        for (place += whole_groups; place != end; ++place) {
            const PointSum sum = *place;
            doubtful += sum.finish(kDoubtful, place->floats()) || sum.weights == 0 ? 0 : 1;
        }
        return doubtful;
    }

    /// Takes the sums again that are marked, with angles in double.
    void sumDoubtful(std::uint64_t count) {
        Buffer<PointSum> exact(allocator_, count, PointSum{});
        std::size_t number = 0;
        for (PointSum& place : sums_) {
            if (place.isDoubtful()) place.setNumber(number++);
        }
        parallel_.forTasks(ranges_.count(), [&](std::size_t task) {
            const auto index = static_cast<unsigned>(task);
            const VertexRange range = ranges_.range(index);
            for (std::size_t t = 0; t < triangle_count_; ++t) {
                if (ranges_.names(t / kBlock, index)) addExactly(t, range, exact);
            }
            for (std::uint32_t p = range.begin; p < range.end; ++p) {
                if (sums_[p].isDoubtful()) exact[sums_[p].number()].finish(kVanished, sums_[p].floats());
            }
        });
    }

    void addExactly(std::size_t triangle, VertexRange range, Buffer<PointSum>& exact) const {
        std::uint32_t buffer[3], point_buffer[3];
        const std::uint32_t* const v = blockVertices(mesh_.indices, triangle, 1, buffer);
        const std::uint32_t* const points = pointsOf(v, 1, point_buffer);
        for (std::size_t k = 0; k < 3; ++k) {
            if (points[k] - range.begin >= range.end - range.begin || !sums_[points[k]].isDoubtful())
                continue;
            const DVec3 here = toDouble(positions_[v[k]]);
            const DVec3 e1 = toDouble(positions_[v[(k + 1) % 3]]) - here;
            const DVec3 e2 = toDouble(positions_[v[(k + 2) % 3]]) - here;
            const DVec3 turn = cross(e1, e2);
            const double size = length(turn);
            if (!(size > 0) || !std::isfinite(size)) return;
            const double weight = (by_angle_ ? polarAngle(dot(e1, e2), size) : 1) * (by_area_ ? size : 1);
            PointSum& sum = exact[sums_[points[k]].number()];
            const DVec3 term = (weight * factor_ / size) * turn;
            sum = {sum.x + term.x, sum.y + term.y, sum.z + term.z, sum.weights + weight};
        }
    }

    /// Where few vertices share a point with another one, these get its normal: then each corner's is at its vertex.
    void copyToRepeated() {
        parallel_.forRanges(points_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t v = begin; v < end; ++v) {
                if (points_[v] != v) sums_[v] = sums_[points_[v]];
            }
        });
        points_ = {};
    }

    /// Returns how many corners of a range of triangles got a substitute.
    std::uint64_t writeCorners(std::size_t begin, std::size_t end) {
        std::uint64_t substitutes = 0;
        std::uint32_t buffer[3 * kBlock];
        for (std::size_t first = begin; first < end; first += kBlock) {
            const std::size_t count = std::min(kBlock, end - first);
            const std::uint32_t* v = blockVertices(mesh_.indices, first, count, buffer);
            auto* const to = reinterpret_cast<std::byte*>(&out_[3 * first]);
            const Float4 marks = out_.stride_bytes == sizeof(Vec3) ? writeNormals(v, 3 * count, to, sizeof(Vec3))
                                                                   : writeNormals(v, 3 * count, to, out_.stride_bytes);
            if (PointSum::isMarked(marks)) [[unlikely]] substitutes += writeSubstitutes(first, v, count);
        }
        return substitutes;
    }

    /// Returns a mark if any of the normals has one.
    [[gnu::always_inline]] Float4 writeNormals(const std::uint32_t* v, std::size_t count, std::byte* to,
                                               std::size_t stride) const {
        const PointSum* const sums = sums_.data();
        Float4 marks = splat(0.0f);
        for (std::size_t i = 0; i + 1 < count; ++i, to += stride) {
            const Float4 normal = loadFloat4(sums[v[i]].floats());
            marks = or4(marks, normal);
            if (stride == sizeof(Vec3))
                storeFloat4(reinterpret_cast<float*>(to), normal);  // the fourth is overwritten by the next
            else
                storeVec3(*reinterpret_cast<Vec3*>(to), normal);
        }
        const Float4 last = loadFloat4(sums[v[count - 1]].floats());
        storeVec3(*reinterpret_cast<Vec3*>(to), last);
        return or4(marks, last);
    }

    std::uint64_t writeSubstitutes(std::size_t first, const std::uint32_t* v, std::size_t count) const {
        std::uint64_t substitutes = 0;
        for (std::size_t i = 0; i < 3 * count; ++i) {
            if (!PointSum::isMarked(loadFloat4(sums_[v[i]].floats()))) continue;
            out_[3 * first + i] = ownNormal(first + i / 3);
            ++substitutes;
        }
        return substitutes;
    }

    /// What stands for a mean that vanished.
    [[nodiscard, gnu::noinline]] Vec3 ownNormal(std::size_t triangle) const {
        Block block;
        const std::uint32_t* v = blockVertices(mesh_.indices, triangle, 1, block.vertices);
        kernel_.compute(faceSource(false, false), fillGroup(v, 1, block.vertices), 1, block.terms);
        const double(&normal)[4] = block.terms.normal[0];
        if (normal[3] == 0.0) return {0, 0, 1};
        return toFloat({normal[0], normal[1], normal[2]});
    }

    const MeshView& mesh_;
    StridedSpan<const Vec3> positions_;
    const NormalOptions& options_;
    bool is_best_;  ///< the sums are means by angle * area first
    bool by_angle_, by_area_;
    double factor_;
    smooth::FaceKernel kernel_;
    StridedSpan<Vec3> out_;
    const Allocator* allocator_;
    Parallel& parallel_;
    std::size_t triangle_count_;
    VertexRanges ranges_;
    Buffer<std::uint32_t> points_;  ///< the point of each vertex; empty when each is its own
    Buffer<PointSum> sums_;
};

}  // namespace

bool canSmoothTriangles(const MeshView& mesh, const NormalOptions& options) {
    return mesh.face_sizes.empty() && mesh.face_size == 3 && mesh.vertexCount() != 0 &&
           options.crease_angle_deg >= 180 && options.smoothing_groups.empty() &&
           options.weighting != NormalWeighting::flat && options.weighting != NormalWeighting::max;
}

NormalReport smoothTriangles(const MeshView& mesh, const StridedSpan<const Vec3>& positions, const NormalOptions& options,
                             StridedSpan<Vec3> out, Parallel& parallel) {
    return TriangleSmoother(mesh, positions, options, out, parallel).run();
}

}  // namespace tspace
