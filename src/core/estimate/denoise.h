// SPDX-License-Identifier: MIT
// Measurement and removal of noise in positions, by quadratic fits over rings of vertices.
#pragma once

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/memory.h"
#include "core/base/vec_math.h"
#include "core/normals/normals_call.h"
#include "tspace/normals.h"

namespace tspace {

// A mesh that is split at its hard edges: all corners that share a normal are one vertex. Contains positions,
// neighbors, and rings around each vertex.

// Returns the cross product of the first three components; the fourth component is 0.
inline Float4 crossed(Float4 a, Float4 b) {
    const Float4 a_yzx = __builtin_shufflevector(a, a, 1, 2, 0, 3), b_yzx = __builtin_shufflevector(b, b, 1, 2, 0, 3);
    const Float4 c = a * b_yzx - a_yzx * b;
    return __builtin_shufflevector(c, c, 1, 2, 0, 3);
}
inline float dotted(Float4 a, Float4 b) {
    const Float4 c = a * b;
    return (c[0] + c[1]) + c[2];
}

/// Maps each corner to its group: to its point, or to a dense number.
class CornerGroups {
  public:
    /// `components`: the lowest corner of each corner's component; empty if all corners of a point belong together.
    CornerGroups(const NormalsCall& call, Buffer<std::uint32_t> components);

    [[nodiscard]] std::uint32_t of(std::uint32_t corner) const {
        return numbers_.empty() ? call_.items.pointOf(corner) : numbers_[corner];
    }
    [[nodiscard]] std::size_t count() const { return count_; }

  private:
    const NormalsCall& call_;
    Buffer<std::uint32_t> numbers_;
    std::size_t count_;
};

/// Graph of the groups. Triangles without area, or with a corner that is not finite, are ignored. As in `best`, a
/// polygon counts as one triangle per corner, formed with the previous and the next corner.
class NormalGroups {
  public:
    /// `length`: unit of the positions. Uses 56 bytes per group and 16 per corner, and 4 per group and thread for
    /// marks. Throws OutOfMemory.
    NormalGroups(const NormalsCall& call, const CornerGroups& corner_groups, double length);

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] Float4 position(std::size_t group) const { return loadFloat4(positions_.data() + 4 * group); }
    /// Returns the area-weighted unit mean of the face normals, or zero.
    [[nodiscard]] Float4 areaNormal(std::size_t group) const { return loadFloat4(normals_.data() + 4 * group); }
    /// Returns the variance of the direction of areaNormal (the sum for both angles, in rad^2) for noise that moves all
    /// points except this one along the normal, with a standard deviation of 1. Infinite if there is no area normal.
    [[nodiscard]] float areaVariance(std::size_t group) const { return variances_[group]; }
    [[nodiscard]] std::span<const std::uint32_t> neighbors(std::size_t group) const {
        return {neighbors_.data() + begins_[group], counts_[group]};
    }

    /// Calls body(i, group, marks) for i in [0, count), where group = groupOf(i); each group may occur once. `marks`:
    /// scratch memory with one entry per group; at the start of each task, no entry is the number of a group.
    template <class GroupOf, class Body>
    void forSome(std::size_t count, const GroupOf& groupOf, const Body& body) const {
        constexpr std::size_t kChunk = 256;
        const std::size_t chunks = (count + kChunk - 1) / kChunk;
        const std::size_t tasks = std::min<std::size_t>(chunks, marks_.size() / std::max<std::size_t>(count_, 1));
        std::atomic<std::size_t> next{0};
        call_.parallel.forTasks(tasks, [&](std::size_t task) {
            std::uint32_t* const marks = marks_.data() + task * count_;
            std::fill_n(marks, count_, ~std::uint32_t{0});
            for (std::size_t chunk; (chunk = next.fetch_add(1, std::memory_order_relaxed)) < chunks;) {
                const std::size_t end = std::min(count, (chunk + 1) * kChunk);
                for (std::size_t i = chunk * kChunk; i < end; ++i) body(i, groupOf(i), marks);
            }
        });
    }
    template <class Body>
    void forAll(const Body& body) const {
        forSome(
            count_, [](std::size_t i) { return i; },
            [&](std::size_t, std::size_t group, std::uint32_t* marks) {
                body(static_cast<std::uint32_t>(group), marks);
            });
    }

    /// Groups of the next and the previous corner on a corner's face.
    struct Ends {
        std::uint32_t next, previous;
    };
    [[nodiscard]] std::span<const Ends> corners(std::size_t group) const {
        return {corners_.data() + begins_[group] / 2, corners_.data() + begins_[group + 1] / 2};
    }

  private:
    void sortCorners(const CornerGroups& corner_groups, double length);
    void findNeighbors();
    void findNeighbors(std::uint32_t group, const Ends* begin, const Ends* end, std::uint32_t* places, float* turns);

    const NormalsCall& call_;
    std::size_t count_;
    std::size_t most_corners_ = 0;  ///< maximum number of corners in a group
    Buffer<float> positions_, normals_, variances_;
    Buffer<Ends> corners_;
    Buffer<std::uint32_t> begins_, counts_, neighbors_;  ///< lists of neighbors, with at most two per corner
    mutable Buffer<std::uint32_t> marks_;                ///< marks for each task
};

/// Walk over the groups around a group, ring by ring. Bounded, so that points with many neighbors cost no more than
/// others: at most kFan neighbors of each group are used, evenly distributed, and at most kMost groups in total.
class RingWalk {
  public:
    static constexpr std::size_t kMost = 256, kFan = 32;

    /// `marks`: the array that forSome passes to its body.
    RingWalk(const NormalGroups& groups, std::uint32_t* marks, std::uint32_t center)
        : groups_(groups), marks_(marks), center_(center) {
        add(center);
    }

    /// Adds the next ring. Returns false if there are too many groups; the last ring is then incomplete.
    bool grow();

    [[nodiscard]] std::size_t size() const { return size_; }
    /// Returns the groups ring by ring, starting with the center. Callers may write three entries after the last group.
    [[nodiscard]] std::uint32_t* list() { return list_; }

  private:
    /// Adds a group unless it is marked, without a branch, which would be unpredictable. Requires room for one entry.
    void add(std::uint32_t group) {
        list_[size_] = group;
        size_ += marks_[group] != center_ ? 1 : 0;
        marks_[group] = center_;
    }

    const NormalGroups& groups_;
    std::uint32_t* marks_;
    std::uint32_t center_;
    std::size_t size_ = 0, ring_ = 0;
    std::uint32_t list_[kMost + kFan + 1];
};

// Least-squares fit of a quadratic surface z(x, y) to the positions of the groups around a group. Its sums are extended
// ring by ring.

/// Local axes of a point: z along a unit normal.
struct RingFrame {
    Float4 x, y, z;

    explicit RingFrame(Float4 normal) : z(normal) {
        const Float4 size = abs4(normal);
        const Float4 least = size[0] <= size[1] && size[0] <= size[2] ? Float4{1, 0, 0, 0}
                             : size[1] <= size[2]                     ? Float4{0, 1, 0, 0}
                                                                      : Float4{0, 0, 1, 0};
        x = crossed(normal, least);
        x *= splat(1 / std::sqrt(dotted(x, x)));
        y = crossed(normal, x);
    }
};

/// Sums over points of products of x, y, z, for the least squares of
///     z = a xx + b xy + c yy + d x + e y + f.
class RingSums {
  public:
    /// Adds the groups of a walk, starting with entry `begin`. The origin is the center.
    void add(const NormalGroups& groups, const RingFrame& frame, RingWalk& walk, std::size_t begin) {
        std::uint32_t* const list = walk.list();
        const std::size_t end = walk.size();
        const Float4 origin = groups.position(list[0]);
        count_ += end - begin;
        // pads the list with the center, which adds zeros to the sums
        for (std::size_t i = end; i < end + 3; ++i) list[i] = list[0];
        for (std::size_t i = begin; i < end; i += 4) {
            const Float4 a = groups.position(list[i]) - origin, b = groups.position(list[i + 1]) - origin;
            const Float4 c = groups.position(list[i + 2]) - origin, d = groups.position(list[i + 3]) - origin;
            const Float4 ab = __builtin_shufflevector(a, b, 0, 1, 4, 5), cd = __builtin_shufflevector(c, d, 0, 1, 4, 5);
            const Float4 px = __builtin_shufflevector(ab, cd, 0, 2, 4, 6),
                         py = __builtin_shufflevector(ab, cd, 1, 3, 5, 7);
            const Float4 ab_z = __builtin_shufflevector(a, b, 2, 2, 6, 6),
                         cd_z = __builtin_shufflevector(c, d, 2, 2, 6, 6);
            const Float4 pz = __builtin_shufflevector(ab_z, cd_z, 0, 2, 4, 6);
            const auto along = [&](Float4 axis) {
                return splat(axis[0]) * px + splat(axis[1]) * py + splat(axis[2]) * pz;
            };
            addProducts(along(frame.x), along(frame.y), along(frame.z));
        }
    }

    /// Equations of the last unknowns that remain after elimination.
    struct Rest {
        double matrix[2][2], right[2];
        bool is_sound = false;
    };
    /// Returns the remaining equations for d and e.
    [[nodiscard]] Rest slopes() const { return eliminate<false>(); }
    /// Returns the remaining equation for f, in matrix[1][1] and right[1].
    [[nodiscard]] Rest height() const { return eliminate<true>(); }

  private:
    enum Product {
        x,
        y,
        xx,
        xy,
        yy,
        xxx,
        xxy,
        xyy,
        yyy,
        xxxx,
        xxxy,
        xxyy,
        xyyy,
        yyyy,
        z,
        zx,
        zy,
        zxx,
        zxy,
        zyy,
        kProducts
    };

    void addProducts(Float4 px, Float4 py, Float4 pz) {
        const Float4 pxx = px * px, pxy = px * py, pyy = py * py;
        sums_[x] += px, sums_[y] += py;
        sums_[xx] += pxx, sums_[xy] += pxy, sums_[yy] += pyy;
        sums_[xxx] += pxx * px, sums_[xxy] += pxx * py, sums_[xyy] += px * pyy, sums_[yyy] += pyy * py;
        sums_[xxxx] += pxx * pxx, sums_[xxxy] += pxx * pxy, sums_[xxyy] += pxx * pyy;
        sums_[xyyy] += pxy * pyy, sums_[yyyy] += pyy * pyy;
        sums_[z] += pz, sums_[zx] += pz * px, sums_[zy] += pz * py;
        sums_[zxx] += pz * pxx, sums_[zxy] += pz * pxy, sums_[zyy] += pz * pyy;
    }

    [[nodiscard]] double sum(Product p) const {
        return (double{sums_[p][0]} + sums_[p][1]) + (double{sums_[p][2]} + sums_[p][3]);
    }

    template <bool kHeightLast>
    [[nodiscard]] Rest eliminate() const;

    Float4 sums_[kProducts] = {};
    std::size_t count_ = 0;
};

/// Performs Gaussian elimination without pivoting, since the matrix is positive definite. A pivot below kLeastPivot
/// times its diagonal element means that the points do not determine the surface: sums in single precision are accurate
/// to 1e-6 of that element.
template <bool kHeightLast>
RingSums::Rest RingSums::eliminate() const {
    constexpr double kLeastPivot = 1e-4;
    constexpr std::size_t kSize = 6, kLast = 4;
    constexpr std::size_t f = kHeightLast ? 5 : 3, d = kHeightLast ? 3 : 4, e = kHeightLast ? 4 : 5;
    double m[kSize][kSize + 1];  // upper triangle, followed by the right-hand sides
    const auto set = [&](std::size_t row, std::size_t column, double value) {
        m[row < column ? row : column][row < column ? column : row] = value;
    };
    m[0][0] = sum(xxxx), m[0][1] = sum(xxxy), m[0][2] = sum(xxyy), m[1][1] = m[0][2], m[1][2] = sum(xyyy);
    m[2][2] = sum(yyyy);
    const double s_xx = sum(xx), s_xy = sum(xy), s_yy = sum(yy);
    const double s_xxx = sum(xxx), s_xxy = sum(xxy), s_xyy = sum(xyy), s_yyy = sum(yyy);
    set(0, d, s_xxx), set(0, e, s_xxy), set(0, f, s_xx);
    set(1, d, s_xxy), set(1, e, s_xyy), set(1, f, s_xy);
    set(2, d, s_xyy), set(2, e, s_yyy), set(2, f, s_yy);
    set(d, d, s_xx), set(d, e, s_xy), set(d, f, sum(x)), set(e, e, s_yy), set(e, f, sum(y));
    set(f, f, static_cast<double>(count_));
    m[0][kSize] = sum(zxx), m[1][kSize] = sum(zxy), m[2][kSize] = sum(zyy);
    m[d][kSize] = sum(zx), m[e][kSize] = sum(zy), m[f][kSize] = sum(z);

    Rest rest;
    double diagonal[kSize];
    for (std::size_t i = 0; i < kSize; ++i) diagonal[i] = m[i][i];
    constexpr std::size_t kSteps = kHeightLast ? kSize - 1 : kLast;
    for (std::size_t k = 0; k < kSteps; ++k) {
        if (!(m[k][k] > kLeastPivot * diagonal[k])) return rest;
        const double inverse = 1 / m[k][k];
        for (std::size_t i = k + 1; i < kSize; ++i) {
            const double factor = inverse * m[k][i];
            for (std::size_t j = i; j <= kSize; ++j) m[i][j] -= factor * m[k][j];
        }
    }
    rest.matrix[0][0] = m[4][4], rest.matrix[0][1] = rest.matrix[1][0] = m[4][5], rest.matrix[1][1] = m[5][5];
    rest.right[0] = m[4][kSize], rest.right[1] = m[5][kSize];
    rest.is_sound = m[5][5] > kLeastPivot * diagonal[5] && std::isfinite(rest.right[0]) && std::isfinite(rest.right[1]);
    if (!kHeightLast) {
        const double det = m[4][4] * m[5][5] - m[4][5] * m[4][5];
        rest.is_sound =
            rest.is_sound && m[4][4] > kLeastPivot * diagonal[4] && det > kLeastPivot * m[4][4] * diagonal[5];
    }
    return rest;
}

// NormalOptions::denoise: measurement of noise, and normals without noise.

/// Samples some thousand edges, using the normals of `best` at their ends (call.out). mean_edge is 0 if no edge has a
/// finite length; a call without results returns only mean_edge. Takes 64 KB.
PositionNoise sampleEdges(const NormalsCall& call);

/// Kink share from which all roughness counts as noise if positions hardly deviate from a smooth surface. Up to half of
/// this share, no roughness counts as noise.
inline constexpr double kNoisyShare = 0.15;

/// Sets sigma and noise. Returns the maximum noise that is consistent with the angles of the edges. `groups`: in units
/// of the mean edge.
double measureNoise(const NormalGroups& groups, const Allocator* allocator, PositionNoise& noise);

/// Converts lengths from units of the mean edge of the noisy mesh to units of the mean edge without noise.
PositionNoise withoutGrowth(PositionNoise noise);

/// Returns the result of measureNoise for a call without output normals. It measures the mesh that determines hard
/// edges (`call.mesh`), in units of the mean edge of the posed mesh. 0 if no edge has a finite length.
double roughnessOf(const NormalsCall& call);

/// Dihedral angles in degrees, weighted by edge length: first quartile and median.
struct Dihedrals {
    double quarter = 0, median = 0;
};
/// Roughness of a surface, whether it is noise or shape: the standard deviation of positions from fits (an upper limit
/// of PositionNoise::sigma), and the dihedral angles.
struct Roughness {
    double sigma = 0;
    Dihedrals dihedrals = {};
    bool is_known = false;
};
/// Measures a sample of 1024 to 4096 of the first `all` groups. `groups`: in units of the mean edge.
Roughness measureRoughness(const NormalGroups& groups, std::size_t all, const Allocator* allocator);

/// Returns the part of sigma that is noise rather than shape.
double noisePart(double sigma, double kink_share, const Dihedrals& dihedrals);

/// Returns the kink share of the edge between two points with unit normals m and n. On a circle e . (m + n) is 0, and
/// on surfaces that are smooth at the scale of the mesh it is nearly 0; e . (n - m) is the part of uniform bending.
/// `flat`: squared sine of an angle; an edge with a smaller angle has no kink.
double kinkShare(const DVec3& edge, const DVec3& m, const DVec3& n, double flat);

/// Returns an index in [0, all) for sample `number` of `count`: one per interval of equal length, at a position that
/// avoids any period of the mesh.
std::size_t sampledPlace(std::size_t number, std::size_t count, std::size_t all);
/// Returns the median; reorders the values.
double medianOf(float* begin, float* end);

/// Kink share up to which noise is never reported: a PositionNoise::noise of 0.03 or more requires a kink share of at
/// least 0.22, for any sigma (noisePart).
inline constexpr double kFewKinks = 0.2;

/// Returns whether a validated triangle mesh may have at least this noise (PositionNoise::noise). The result false is
/// reliable: 512 edges and their surroundings have far less noise. The result true must be confirmed by
/// measurePositionNoise. Uses no more memory than that function and 64 KB. O(corners), a tenth of the time of `best`.
/// Throws OutOfMemory.
bool mayHaveNoise(const MeshView& mesh, double noise, const Execution& execution, Parallel& parallel);

/// Returns the result of measurePositionNoise, or all zeros if mayHaveNoise(least) is false.
Result<PositionNoise> measureSureNoise(const MeshView& mesh, double least, const Execution& execution);

/// Measures a mesh without hard edges. If its share of kinks is at most `fewest_kinks`, sigma and noise stay 0.
PositionNoise noiseOf(const MeshView& mesh, const Execution& execution, Parallel& parallel, double fewest_kinks);

/// Computes averageNormals with `best`, then denoises. Uses the noise of the mesh, also for a pose, so that a normal
/// does not change if nothing near it moves. Uses NormalGroups and 76 bytes per group. Throws OutOfMemory.
NormalReport denoisedNormals(NormalsCall& call);

}  // namespace tspace
