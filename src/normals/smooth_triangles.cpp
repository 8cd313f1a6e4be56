// SPDX-License-Identifier: MIT
// Sums of weighted face normals per point, in blocks of triangles whose arithmetic is SIMD. No list of the
// corners around a point is needed: where its mean vanishes, a corner's substitute depends on its own face. Where
// blocks of triangles lie close together, ranges of points are summed, finished and written one after the other. Based
// on: Thuermer & Wuethrich, "Computing Vertex Normals from Polygonal Facets", 1998.
#include "normals/smooth_triangles.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "core/angle.h"
#include "core/border.h"
#include "core/float4.h"
#include "core/typed_indices.h"
#include "core/vec_math.h"
#include "core/vertex_ranges.h"
#include "core/weld.h"
#include "normals/best_rounds.h"
#include "normals/face_terms.h"
#include "normals/faces.h"

namespace tspace {

namespace {

using smooth::FaceTerms, smooth::FaceSource, smooth::kTermGroup, smooth::kDoubtful, smooth::kVanished;

constexpr std::size_t kBlock = VertexRanges::kBlock;
static_assert(kBlock == smooth::kTermTriangles && kBlock % kTermGroup == 0);
constexpr std::size_t kNearPoints = 16384;   ///< and up to twice as many: their sums fit into a second cache
constexpr std::size_t kRangesPerThread = 4;  ///< at least

/// The weighted sum of the unit normals at a point. Later its place holds four floats: the normal, and a mark
/// whose sign is set when there is none.
struct PointSum {
    double x, y, z, weights;

    /// Writes the unit mean, or the mark when the mean is not above `least`; returns which.
    bool finish(double least) {
        const double length = std::sqrt(x * x + y * y + z * z);
        if (length > least * weights) [[likely]] {
            const Vec3 unit = toFloat((1.0 / length) * DVec3{x, y, z});
            storeFloat4(floats(), Float4{unit.x, unit.y, unit.z, 0.0f});
            return true;
        }
        storeFloat4(floats(), Float4{0.0f, 0.0f, 0.0f, -0.0f});
        return false;
    }
    // For the functions of float4.h.
    [[nodiscard]] float* floats() { return reinterpret_cast<float*>(this); }
    [[nodiscard]] const float* floats() const { return reinterpret_cast<const float*>(this); }

    /// Has the mark although something was added.
    [[nodiscard]] bool isDoubtful() const { return isMarked(loadFloat4(floats())) && weights > 0; }
    static bool isMarked(Float4 normal) { return (laneBits(std::bit_cast<Mask4>(normal)) & 8) != 0; }
};

/// The places of a range of points.
struct RangeSums {
    PointSum* rows;  ///< of the points from range.begin on
    VertexRange range;
    std::uint64_t* doubtful;  ///< room for a bit per point

    [[nodiscard]] bool has(std::uint32_t point) const { return range.has(point); }
    [[nodiscard]] PointSum& at(std::uint32_t point) const { return rows[point - range.begin]; }
    [[nodiscard]] std::size_t size() const { return range.end - range.begin; }
};

constexpr std::size_t wordsFor(std::size_t bits) { return (bits + 63) / 64; }

/// A block of triangles: their vertices and points where these are not read from the mesh, and what they add.
struct Block {
    std::uint32_t vertices[3 * kBlock];
    std::uint32_t points[3 * kBlock];
    FaceTerms terms;
};

class TriangleSmoother {
  public:
    /// Vertices are welded by the mesh's positions; all else is computed from `positions`.
    TriangleSmoother(const MeshView& mesh, const StridedSpan<const Vec3>& positions, const NormalOptions& options,
                     StridedSpan<Vec3> out, Parallel& parallel)
        : mesh_(mesh),
          positions_(positions),
          options_(options),
          is_best_(options.weighting == NormalWeighting::best),
          by_angle_(options.weighting == NormalWeighting::angle || options.weighting == NormalWeighting::angleArea ||
                    is_best_),
          by_area_(options.weighting == NormalWeighting::area || options.weighting == NormalWeighting::angleArea ||
                   is_best_),
          factor_(normalFactor(options.convention)),
          kernel_(smooth::faceKernelFor(options.execution.simd)),
          out_(out),
          allocator_(options.execution.allocator),
          parallel_(parallel),
          triangle_count_(mesh.faceCount()),
          points_(options.weld_positions ? weldPositions(mesh, allocator_, parallel_) : Buffer<std::uint32_t>()),
          ranges_(mesh.indices, triangle_count_, mesh.vertexCount(), points_.data()) {}

    Result<NormalReport> run() {
        const bool threads = parallel_.width() > 1 && triangle_count_ >= Parallel::kGrain;
        const std::size_t near = std::max(mesh_.vertexCount() / kNearPoints,
                                          threads ? kRangesPerThread * parallel_.width() : std::size_t{1});
        const bool is_near = !is_best_ && near > 1 && ranges_.wouldBeCompact(near);
        if (is_near || threads) {
            if (!ranges_.cut(is_near ? near : parallel_.width(), allocator_, parallel_)) return indexError();
        } else if (Error e = indexError(); e.code != ErrorCode::ok) {
            return e;
        }
        return sumAndWrite(is_near);
    }

  private:
    [[nodiscard]] Error indexError() const { return checkIndices(mesh_.indices, mesh_.vertexCount()); }

    /// `is_near`: each range is written when it is summed, with memory for the sums of one per task, which stays in the
    /// cache. Otherwise all corners are written behind all sums.
    NormalReport sumAndWrite(bool is_near) {
        const std::size_t ranges = ranges_.count(), size = ranges_.range(0).end;
        const std::size_t tasks = parallel_.width() == 1 ? 1 : std::min(ranges, kRangesPerThread * parallel_.width());
        sums_ = Buffer<PointSum>(allocator_, is_near ? tasks * size : mesh_.vertexCount());
        Buffer<std::uint64_t> doubtful(allocator_, tasks * wordsFor(size));
        std::atomic<std::uint64_t> degenerate{0}, substitutes{0};
        parallel_.forTasks(tasks, [&](std::size_t task) {
            for (std::size_t r = ranges * task / tasks; r < ranges * (task + 1) / tasks; ++r) {
                const auto index = static_cast<unsigned>(r);
                const VertexRange range = ranges_.range(index);
                const RangeSums place{sums_.data() + (is_near ? task * size : range.begin), range,
                                      doubtful.data() + task * wordsFor(size)};
                degenerate += sum(index, place);
                if (is_near) substitutes += writeRange(index, place);
            }
        });
        if (is_best_) {
            const Faces faces(mesh_, allocator_);
            smooth::refineTriangles(PointItems(mesh_, faces, points_), mesh_.vertexCount(), positions_, options_,
                                    sums_.data()->floats(), parallel_);
        }
        if (!is_near) {
            copyToRepeated();
            parallel_.forRanges(triangle_count_, Parallel::kGrain,
                                [&](std::size_t begin, std::size_t end) { substitutes += writeCorners(begin, end); });
        }
        return {triangle_count_, degenerate, substitutes};
    }

    /// The points of the corners of `count` triangles: `vertices` itself or `buffer`, which may be the same.
    const std::uint32_t* pointsOf(const std::uint32_t* vertices, std::size_t count, std::uint32_t* buffer) const {
        for (std::size_t i = 0; i < 3 * count; ++i) buffer[i] = points_[vertices[i]];
        return buffer;
    }
    const std::uint32_t* blockPoints(std::size_t block, const std::uint32_t* vertices, std::size_t count,
                                     std::uint32_t* buffer) const {
        return ranges_.hasRepeated(block) ? pointsOf(vertices, count, buffer) : vertices;
    }
    [[nodiscard]] std::size_t blockSize(std::size_t block) const {
        return std::min(kBlock, triangle_count_ - block * kBlock);
    }

    /// Makes the unit normals of a range; returns the degenerate triangles whose first point is in it.
    std::uint64_t sum(unsigned index, const RangeSums& place) const {
        std::memset(place.rows, 0, place.size() * sizeof(PointSum));
        double* const sums = &place.rows->x;
        const FaceSource source = faceSource(by_angle_, by_area_);
        Block block;
        std::uint64_t degenerate = 0;
        ranges_.forBlocks(index, [&](std::size_t b) {
            std::size_t count = blockSize(b);
            const std::uint32_t* v = readIndices(mesh_.indices, 3 * b * kBlock, 3 * count, block.vertices);
            const std::uint32_t* points = blockPoints(b, v, count, block.points);
            if (ranges_.isWithinOne(b)) {
                degenerate +=
                    kernel_.compute(source, fillGroup(v, count, kTermGroup, block.vertices), count, block.terms);
                kernel_.add(block.terms, points, count, sums, place.range.begin);
            } else {
                count = select(v, points, count, place, block);
                const std::uint32_t* const vertices = fillGroup(block.vertices, count, kTermGroup, block.vertices);
                if (kernel_.compute(source, vertices, count, block.terms) != 0)
                    degenerate += degenerateIn(block, count, place);
                kernel_.add_some(block.terms, block.points, count, sums, place.range.begin, place.range.end);
            }
        });
        if (finish(place) != 0) [[unlikely]]
            sumDoubtful(index, place);
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
                              const RangeSums& place, Block& block) {
        std::size_t taken = 0;
        for (std::size_t i = 0; i < 3 * count; i += 3) {
            bool any = false;
            for (std::size_t k = 0; k < 3; ++k) {
                any |= place.has(points[i + k]);
                block.vertices[3 * taken + k] = v[i + k];
                block.points[3 * taken + k] = points[i + k];
            }
            taken += any ? 1 : 0;
        }
        return taken;
    }

    /// How many of a block's triangles are degenerate and have their first point in the range.
    static std::uint64_t degenerateIn(const Block& block, std::size_t count, const RangeSums& place) {
        std::uint64_t degenerate = 0;
        for (std::size_t t = 0; t < count; ++t)
            degenerate += block.terms.normal[t][3] == 0.0 && place.has(block.points[3 * t]) ? 1 : 0;
        return degenerate;
    }

    /// Turns sums into unit normals and returns how many are doubtful. Sums of products of floats neither
    /// overflow nor vanish when squared.
    [[nodiscard]] std::uint64_t finish(const RangeSums& place) const {
        const std::size_t whole_groups = place.size() / kTermGroup * kTermGroup;
        std::uint64_t doubtful = kernel_.finish(&place.rows->x, whole_groups, kDoubtful);
        for (std::size_t i = whole_groups; i < place.size(); ++i)
            doubtful += place.rows[i].finish(kDoubtful) || !place.rows[i].isDoubtful() ? 0 : 1;
        return doubtful;
    }

    /// Takes the sums again that are marked, with angles in double.
    void sumDoubtful(unsigned index, const RangeSums& place) const {
        std::fill_n(place.doubtful, wordsFor(place.size()), std::uint64_t{0});
        for (std::size_t i = 0; i < place.size(); ++i) {
            if (!place.rows[i].isDoubtful()) continue;
            place.doubtful[i / 64] |= std::uint64_t{1} << i % 64;
            place.rows[i] = {};
        }
        ranges_.forBlocks(index, [&](std::size_t b) {
            for (std::size_t t = b * kBlock; t < b * kBlock + blockSize(b); ++t) addExactly(t, place);
        });
        for (std::size_t i = 0; i < place.size(); ++i) {
            if ((place.doubtful[i / 64] >> i % 64 & 1) != 0) place.rows[i].finish(kVanished);
        }
    }

    void addExactly(std::size_t triangle, const RangeSums& place) const {
        std::uint32_t buffer[3], point_buffer[3];
        const std::uint32_t* const v = readIndices(mesh_.indices, 3 * triangle, 3, buffer);
        const std::uint32_t* const points = blockPoints(triangle / kBlock, v, 1, point_buffer);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = points[k] - place.range.begin;
            if (!place.has(points[k]) || (place.doubtful[i / 64] >> i % 64 & 1) == 0) continue;
            const DVec3 here = toDouble(positions_[v[k]]);
            const DVec3 e1 = toDouble(positions_[v[(k + 1) % 3]]) - here;
            const DVec3 e2 = toDouble(positions_[v[(k + 2) % 3]]) - here;
            const DVec3 turn = cross(e1, e2);
            const double size = length(turn);
            if (!(size > 0) || !std::isfinite(size)) return;
            const double weight = (by_angle_ ? polarAngle(dot(e1, e2), size) : 1) * (by_area_ ? size : 1);
            PointSum& sum = place.rows[i];
            const DVec3 term = (weight * factor_ / size) * turn;
            sum = {sum.x + term.x, sum.y + term.y, sum.z + term.z, sum.weights + weight};
        }
    }

    /// Writes the corners at the points of a range; returns how many got a substitute.
    std::uint64_t writeRange(unsigned index, const RangeSums& place) const {
        std::uint64_t substitutes = 0;
        std::uint32_t buffer[3 * kBlock], point_buffer[3 * kBlock];
        ranges_.forBlocks(index, [&](std::size_t b) {
            const std::size_t count = blockSize(b);
            const std::uint32_t* v = readIndices(mesh_.indices, 3 * b * kBlock, 3 * count, buffer);
            const std::uint32_t* points = blockPoints(b, v, count, point_buffer);
            substitutes += ranges_.isWithinOne(b) ? writeBlock(b * kBlock, points, count, place)
                                                  : writeSome(b * kBlock, points, count, place);
        });
        return substitutes;
    }

    /// Of a block at the border of ranges: only the corners at the points of one.
    std::uint64_t writeSome(std::size_t first, const std::uint32_t* points, std::size_t count,
                            const RangeSums& place) const {
        std::uint64_t substitutes = 0;
        for (std::size_t i = 0; i < 3 * count; ++i) {
            if (!place.has(points[i])) continue;
            const Float4 normal = loadFloat4(place.at(points[i]).floats());
            storeVec3(out_[3 * first + i], normal);
            if (PointSum::isMarked(normal)) [[unlikely]] {
                out_[3 * first + i] = ownNormal(first + i / 3);
                ++substitutes;
            }
        }
        return substitutes;
    }

    /// Where few vertices share a point with another one, these get its normal: then each corner's is at its vertex.
    void copyToRepeated() {
        parallel_.forRanges(points_.size(), Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t v = begin; v < end; ++v) {
                if (points_[v] != v) sums_[v] = sums_[points_[v]];
            }
        });
    }

    /// Returns how many corners of a range of triangles got a substitute.
    std::uint64_t writeCorners(std::size_t begin, std::size_t end) {
        std::uint64_t substitutes = 0;
        std::uint32_t buffer[3 * kBlock];
        const RangeSums all{sums_.data(), {0, static_cast<std::uint32_t>(sums_.size())}, nullptr};
        for (std::size_t first = begin; first < end; first += kBlock) {
            const std::size_t count = std::min(kBlock, end - first);
            substitutes += writeBlock(first, readIndices(mesh_.indices, 3 * first, 3 * count, buffer), count, all);
        }
        return substitutes;
    }

    /// Returns how many corners got a substitute.
    std::uint64_t writeBlock(std::size_t first, const std::uint32_t* points, std::size_t count,
                             const RangeSums& place) const {
        auto* const to = reinterpret_cast<std::byte*>(&out_[3 * first]);
        const Float4 marks = out_.stride_bytes == sizeof(Vec3)
                                 ? writeNormals(points, 3 * count, to, sizeof(Vec3), place)
                                 : writeNormals(points, 3 * count, to, out_.stride_bytes, place);
        return PointSum::isMarked(marks) ? writeSubstitutes(first, points, count, place) : 0;
    }

    /// Returns a mark if any of the normals has one.
    [[gnu::always_inline]] static Float4 writeNormals(const std::uint32_t* points, std::size_t count, std::byte* to,
                                                      std::size_t stride, const RangeSums& place) {
        const auto normalAt = [&](std::size_t i) __attribute__((always_inline)) {
            return loadFloat4(place.at(points[i]).floats());
        };
        Float4 marks = splat(0.0f);
        std::size_t i = 0;
        if (stride == sizeof(Vec3)) {
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
        return marks;
    }

    [[gnu::noinline]] std::uint64_t writeSubstitutes(std::size_t first, const std::uint32_t* points, std::size_t count,
                                                     const RangeSums& place) const {
        std::uint64_t substitutes = 0;
        for (std::size_t i = 0; i < 3 * count; ++i) {
            if (!PointSum::isMarked(loadFloat4(place.at(points[i]).floats()))) continue;
            out_[3 * first + i] = ownNormal(first + i / 3);
            ++substitutes;
        }
        return substitutes;
    }

    /// What stands for a mean that vanished.
    [[nodiscard, gnu::noinline]] Vec3 ownNormal(std::size_t triangle) const {
        Block block;
        const std::uint32_t* v = readIndices(mesh_.indices, 3 * triangle, 3, block.vertices);
        kernel_.compute(faceSource(false, false), fillGroup(v, 1, kTermGroup, block.vertices), 1, block.terms);
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
    Buffer<std::uint32_t> points_;  ///< the point of each vertex; empty when each is its own
    VertexRanges ranges_;
    Buffer<PointSum> sums_;  ///< of all points, or of one range for each task
};

}  // namespace

bool canSmoothTriangles(const MeshView& mesh, const NormalOptions& options) {
    return mesh.face_sizes.empty() && mesh.face_size == 3 && mesh.vertexCount() != 0 &&
           options.crease_angle_deg >= 180 && options.smoothing_groups.empty() &&
           options.weighting != NormalWeighting::flat && options.weighting != NormalWeighting::max;
}

Result<NormalReport> smoothTriangles(const MeshView& mesh, const StridedSpan<const Vec3>& positions,
                                     const NormalOptions& options, StridedSpan<Vec3> out, Parallel& parallel) {
    return TriangleSmoother(mesh, positions, options, out, parallel).run();
}

}  // namespace tspace
