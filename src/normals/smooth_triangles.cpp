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
#include <iterator>
#include <numeric>

#include "core/angle.h"
#include "core/float4.h"
#include "core/sum_ranges.h"
#include "core/vec_math.h"
#include "core/vertex_ranges.h"
#include "normals/weld.h"

namespace tspace {

namespace {

constexpr std::size_t kBlock = VertexRanges::kBlock;
constexpr std::size_t kGrain = 16384;
// In triangles. An estimate, from some 50 us for a thread to start; not yet measured on idle cores.
constexpr std::size_t kWorthThreads = 16384;

// Below the first fraction of the weights a sum is what rounding left of normals that cancel. Below the
// second it shows how single-precision angles were rounded: it is then taken again, with angles in double.
constexpr double kVanished = 1e-10, kDoubtful = 1e-2;

using Double2InMemory = double __attribute__((vector_size(16), aligned(8), may_alias));

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

/// The angle whose cotangent is c, in [0, pi], to 2e-7 of itself. The polynomial is
/// (atan(t) - t) / t^3 in t^2, interpolated at the Chebyshev points of [0, 1]; it is good to 2e-9.
inline Float4 angleOfCotangent(Float4 c) {
    constexpr float kPolynomial[] = {-2.386997316e-03f, 1.350777142e-02f,  -3.587153898e-02f,
                                     6.250169444e-02f,  -8.656880430e-02f, 1.103376412e-01f,
                                     -1.427856875e-01f, 1.999973933e-01f,  -3.333333173e-01f};
    constexpr float kHalfPi = 1.57079632679489662f, kPi = 3.14159265358979324f;
    const Float4 one = splat(1.0f), size = abs4(c);
    const Float4 t = min4(size, one) / max4(size, one);
    const Float4 q = t * t;
    Float4 p = splat(kPolynomial[0]);
    for (std::size_t i = 1; i < std::size(kPolynomial); ++i) p = p * q + splat(kPolynomial[i]);
    const Float4 atan = t + t * (q * p);
    const Float4 angle = select4(size > one, atan, splat(kHalfPi) - atan);
    return select4(c < splat(0.0f), splat(kPi) - angle, angle);
}

/// The triangles of a block that a task adds, and what it computes of them: one array per component.
struct BlockFaces {
    std::uint32_t vertices[3 * kBlock];
    std::uint32_t points[3 * kBlock];
    alignas(64) float position[9][kBlock];
    alignas(64) double normal[3][kBlock];  ///< unit, times the area if that is a weight; zero if degenerate
    alignas(64) double size[kBlock];       ///< what `normal` was multiplied with; 0 if degenerate
    alignas(64) float angle[3][kBlock];    ///< of each corner, or 1 if that is no weight
};

void gather(const StridedSpan<const Vec3>& positions, const std::uint32_t* v, std::size_t count,
            BlockFaces& block) {
    for (std::size_t i = 0; i < count; i += 4) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto p = [&](std::size_t lane) -> const Vec3& {
                return positions[v[3 * std::min(i + lane, count - 1) + k]];  // the last ones repeat
            };
            const Vec3x4 four = gatherVec3(p(0), p(1), p(2), p(3));
            storeFloat4(block.position[3 * k] + i, four.x);
            storeFloat4(block.position[3 * k + 1] + i, four.y);
            storeFloat4(block.position[3 * k + 2] + i, four.z);
        }
    }
}

/// In double: differences of floats are exact or nearly so, and nothing overflows or vanishes. Leaves the
/// cotangents in the place of the angles.
template <bool kByArea>
void computeNormals(double factor, std::size_t count, BlockFaces& block) {
    const auto& p = block.position;
    for (std::size_t i = 0; i < count; ++i) {
        const double ox = p[0][i], oy = p[1][i], oz = p[2][i];
        const double ax = p[3][i] - ox, ay = p[4][i] - oy, az = p[5][i] - oz;
        const double bx = p[6][i] - ox, by = p[7][i] - oy, bz = p[8][i] - oz;
        const double nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
        const double length = std::sqrt(nx * nx + ny * ny + nz * nz);
        const bool sound = length > 0.0 && length <= 1e300;
        const double inverse = sound ? 1.0 / length : 0.0;
        const double scale = kByArea ? factor : factor * inverse;
        block.normal[0][i] = sound ? nx * scale : 0.0;
        block.normal[1][i] = sound ? ny * scale : 0.0;
        block.normal[2][i] = sound ? nz * scale : 0.0;
        block.size[i] = sound ? (kByArea ? length : 1.0) : 0.0;
        const double aa = ax * ax + ay * ay + az * az;
        const double bb = bx * bx + by * by + bz * bz;
        const double ab = ax * bx + ay * by + az * bz;
        block.angle[0][i] = sound ? static_cast<float>(ab * inverse) : 0.0f;
        block.angle[1][i] = sound ? static_cast<float>((aa - ab) * inverse) : 0.0f;
        block.angle[2][i] = sound ? static_cast<float>((bb - ab) * inverse) : 0.0f;
    }
}

/// The same value for a corner of a face and of its reverse, so that the two cancel.
void computeAngles(bool by_angle, std::size_t count, BlockFaces& block) {
    for (float(&angle)[kBlock] : block.angle) {
        if (!by_angle) {
            std::fill_n(angle, count, 1.0f);
            continue;
        }
        for (std::size_t i = 0; i < count; i += 4) {
            storeFloat4(angle + i, angleOfCotangent(loadFloat4(angle + i)));
        }
    }
}

class TriangleSmoother {
  public:
    TriangleSmoother(const MeshView& mesh, const NormalOptions& options, StridedSpan<Vec3> out,
                     Parallel& parallel)
        : mesh_(mesh),
          by_angle_(options.weighting == NormalWeighting::angle ||
                    options.weighting == NormalWeighting::angleArea),
          by_area_(options.weighting == NormalWeighting::area ||
                   options.weighting == NormalWeighting::angleArea),
          factor_(normalFactor(options.convention)),
          out_(out),
          allocator_(options.execution.allocator),
          parallel_(parallel),
          triangle_count_(mesh.faceCount()),
          ranges_(mesh.vertexCount()) {
        if (options.weld_positions) points_ = weldPositions(mesh.positions, allocator_, parallel_);
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
        BlockFaces block;
        std::uint64_t degenerate = 0;
        for (std::size_t first = 0, b = 0; first < triangle_count_; first += kBlock, ++b) {
            if (!ranges_.names(b, index)) continue;
            std::size_t count = std::min(kBlock, triangle_count_ - first);
            const std::uint32_t* v = blockVertices(mesh_.indices, first, count, block.vertices);
            const std::uint32_t* points = pointsOf(v, count, block.points);
            if (ranges_.namesOnly(b, index)) {
                compute(v, count, block);
                degenerate += add<true>(points, count, range, block);
            } else {
                count = select(v, points, count, range, block);
                compute(block.vertices, count, block);
                degenerate += add<false>(block.points, count, range, block);
            }
        }
        return degenerate;
    }

    /// Takes the triangles that have a point in the range, and returns how many.
    static std::size_t select(const std::uint32_t* v, const std::uint32_t* points, std::size_t count,
                              VertexRange range, BlockFaces& block) {
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

    void compute(const std::uint32_t* v, std::size_t count, BlockFaces& block) const {
        gather(mesh_.positions, v, count, block);
        if (by_area_)
            computeNormals<true>(factor_, count, block);
        else
            computeNormals<false>(factor_, count, block);
        computeAngles(by_angle_, count, block);
    }

    /// Returns how many of the triangles are degenerate, but only those whose first point is in the range.
    template <bool kWhole>
    std::uint64_t add(const std::uint32_t* points, std::size_t count, VertexRange range,
                      const BlockFaces& block) {
        const auto isInRange = [&](std::uint32_t point) {
            return kWhole || point - range.begin < range.end - range.begin;
        };
        PointSum* const sums = sums_.data();
        std::uint64_t degenerate = 0;
        for (std::size_t i = 0; i < count; ++i, points += 3) {
            const Double2 xy{block.normal[0][i], block.normal[1][i]};
            const Double2 z_size{block.normal[2][i], block.size[i]};
            for (std::size_t k = 0; k < 3; ++k) {
                if (!isInRange(points[k])) continue;
                const double angle = block.angle[k][i];
                PointSum& place = sums[points[k]];
                addPair(&place.x, Double2{angle, angle} * xy);
                addPair(&place.z, Double2{angle, angle} * z_size);
            }
            if (block.size[i] == 0.0 && isInRange(points[0])) ++degenerate;
        }
        return degenerate;
    }

    static void addPair(double* sum, Double2 term) { *reinterpret_cast<Double2InMemory*>(sum) += term; }

    /// Turns sums into unit normals and returns how many are doubtful. Sums of products of floats neither
    /// overflow nor vanish when squared.
    std::uint64_t finish(VertexRange range) {
        std::uint64_t doubtful = 0;
        PointSum* const end = sums_.data() + range.end;
        for (PointSum* place = sums_.data() + range.begin; place != end; ++place) {
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
            const DVec3 here = toDouble(mesh_.positions[v[k]]);
            const DVec3 e1 = toDouble(mesh_.positions[v[(k + 1) % 3]]) - here;
            const DVec3 e2 = toDouble(mesh_.positions[v[(k + 2) % 3]]) - here;
            const DVec3 turn = cross(e1, e2);
            const double size = length(turn);
            if (!(size > 0) || !std::isfinite(size)) return;
            const double weight = (by_angle_ ? polarAngle(dot(e1, e2), size) : 1) * (by_area_ ? size : 1);
            PointSum& sum = exact[sums_[points[k]].number()];
            const DVec3 term = (weight * factor_ / size) * turn;
            sum = {sum.x + term.x, sum.y + term.y, sum.z + term.z, sum.weights + weight};
        }
    }

    /// Returns how many corners of a range of triangles got a substitute.
    std::uint64_t writeCorners(std::size_t begin, std::size_t end) {
        std::uint64_t substitutes = 0;
        std::uint32_t buffer[3 * kBlock];
        for (std::size_t first = begin; first < end; first += kBlock) {
            const std::size_t count = std::min(kBlock, end - first);
            const std::uint32_t* v = blockVertices(mesh_.indices, first, count, buffer);
            if (points_.empty())
                substitutes += writeBlock<false>(first, v, count);
            else
                substitutes += writeBlock<true>(first, v, count);
        }
        return substitutes;
    }

    template <bool kMapped>
    std::uint64_t writeBlock(std::size_t first, const std::uint32_t* v, std::size_t count) {
        const PointSum* const sums = sums_.data();
        const std::uint32_t* const points = points_.data();
        const std::size_t stride = out_.stride_bytes;
        auto* to = reinterpret_cast<std::byte*>(&out_[3 * first]);
        std::uint64_t substitutes = 0;
        for (std::size_t i = 0; i < 3 * count; ++i, to += stride) {
            const Float4 normal = loadFloat4(sums[kMapped ? points[v[i]] : v[i]].floats());
            storeVec3(*reinterpret_cast<Vec3*>(to), normal);
            if (PointSum::isMarked(normal)) [[unlikely]] {
                *reinterpret_cast<Vec3*>(to) = ownNormal(first + i / 3);
                ++substitutes;
            }
        }
        return substitutes;
    }

    /// What stands for a mean that vanished.
    [[nodiscard, gnu::noinline]] Vec3 ownNormal(std::size_t triangle) const {
        BlockFaces block;
        gather(mesh_.positions, blockVertices(mesh_.indices, triangle, 1, block.vertices), 1, block);
        computeNormals<false>(factor_, 1, block);
        if (block.size[0] == 0.0) return {0, 0, 1};
        return toFloat({block.normal[0][0], block.normal[1][0], block.normal[2][0]});
    }

    const MeshView& mesh_;
    bool by_angle_, by_area_;
    double factor_;
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

NormalReport smoothTriangles(const MeshView& mesh, const NormalOptions& options, StridedSpan<Vec3> out,
                             Parallel& parallel) {
    return TriangleSmoother(mesh, options, out, parallel).run();
}

}  // namespace tspace
