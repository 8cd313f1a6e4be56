// SPDX-License-Identifier: MIT
// Smoothing normals: the arguments and faces of a call, hard edges by the mesh, the two ways (smoothTriangles, smoothFaces),
// the rounds of NormalWeighting::best, with which both end, and which corners around a point share one normal.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/border.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/range_lists.h"
#include "core/base/vec_math.h"
#include "core/base/weld.h"
#include "core/normals/face_terms.h"
#include "tspace/mesh.h"
#include "tspace/normals.h"

namespace tspace {

// NormalOptions::crease_auto: which edges are hard, by the mesh.

/// Kind of the edge from a corner to the next one on its face.
enum class EdgeKind : std::uint8_t {
    byAngle,  ///< it has other than two faces
    soft,
    hard,
};

struct Creases {
    float angle_deg = 180;
    bool are_all_soft = true;     ///< no edge is hard, nor has more than two faces
    Buffer<EdgeKind> edges = {};  ///< edge kind of each corner
};

/// By the histogram of the angles of edges: in the widest gap between those that most have and those that few have. Where
/// positions are noisy, by faces whose normals were smoothed over what is no edge. Then without what is one edge long, and
/// with what one edge interrupts. The mesh and its options have been checked.
/// Takes NormalGroups (denoise.h), then 57 bytes per corner. O(n log n) for points with many edges, else linear. Throws OutOfMemory.
/// Based on: Zheng, Fu, Au & Tai, "Bilateral Normal Filtering for Mesh Denoising", 2011.
Creases findCreases(const MeshView& mesh, const NormalOptions& options, const Execution& execution, Parallel& parallel);

// The arguments and faces of a call, and the ways to smooth.

/// The faces of a mesh by their corners. Faces of one size need no table; otherwise 4 bytes per corner and face.
class MeshFaces {
  public:
    MeshFaces(const MeshView& mesh, const Allocator* allocator);

    /// The face of a corner, the first corner of a face, and the one after its last.
    [[nodiscard]] std::uint32_t of(std::uint32_t corner) const {
        return size_ == 3 ? corner / 3 : size_ != 0 ? corner / size_ : corner_faces_[corner];
    }
    [[nodiscard]] std::uint32_t first(std::uint32_t face) const {
        return size_ != 0 ? face * size_ : first_corners_[face];
    }
    [[nodiscard]] std::uint32_t past(std::uint32_t face) const { return first(face + 1); }
    struct Around {
        std::uint32_t corners[3];  ///< a corner, the one after it on the border of its face and the one before
    };
    [[nodiscard]] Around around(std::uint32_t corner) const {
        const std::uint32_t face = of(corner), begin = first(face), end = past(face);
        return {{corner, corner + 1 == end ? begin : corner + 1, (corner == begin ? end : corner) - 1}};
    }
    [[nodiscard]] std::uint32_t next(std::uint32_t corner) const { return around(corner).corners[1]; }
    [[nodiscard]] std::uint32_t previous(std::uint32_t corner) const { return around(corner).corners[2]; }
    /// Faces of fewer than 3 corners are ignored everywhere.
    [[nodiscard]] bool isUsed(std::uint32_t face) const { return past(face) - first(face) >= 3; }
    [[nodiscard]] std::uint64_t usedCount() const { return used_count_; }

  private:
    std::uint32_t size_ = 0;  ///< size of every face; 0: sizes differ
    std::uint64_t used_count_ = 0;
    Buffer<std::uint32_t> first_corners_, corner_faces_;
};

/// The items that range lists sort by points: triangles, or for other faces single corners.
class PointItems final : public TriangleGroups {
  public:
    /// `points`: of each vertex; empty when each is its own.
    PointItems(const MeshView& mesh, const MeshFaces& faces, const Buffer<std::uint32_t>& points,
               const Allocator* allocator);

    static bool areTriangles(const MeshView& mesh) { return mesh.face_sizes.empty() && mesh.face_size == 3; }

    [[nodiscard]] std::uint32_t pointOf(std::uint32_t corner) const {
        const std::uint32_t vertex = mesh_.indices[corner];
        return points_.empty() ? vertex : points_[vertex];
    }
    /// A corner comes with the next and the previous one, and its own point three times; those of faces with fewer than
    /// 3 corners have none.
    void read(std::size_t first, std::size_t size, std::uint32_t* vertices, std::uint32_t* points) const override;
    void readSome(const std::uint32_t* numbers, std::size_t size, std::uint32_t* vertices,
                  std::uint32_t* points) const override;
    [[nodiscard]] const std::uint32_t* inPlace(std::size_t first, std::size_t) const override;

  private:
    template <class NumberOf>
    void readEach(NumberOf numberOf, std::size_t size, std::uint32_t* vertices, std::uint32_t* points) const;

    enum Block : std::uint8_t { unknown, own, shared };  // own: each vertex is its own point

    const MeshView& mesh_;
    const MeshFaces& faces_;
    const Buffer<std::uint32_t>& points_;
    const std::uint32_t* in_place_;  ///< the indices; null where they are not triangles of 32-bit numbers
    /// Result of inPlace for each block. Nearly all are `own` if triangles are stored close together, and comparing once is
    /// cheaper than looking points up in each pass.
    mutable Buffer<std::uint8_t> blocks_;
};

/// The normal of a face times `size`, and `size`: zeros if it is degenerate.
struct FaceRow {
    double x, y, z, size;

    [[nodiscard]] bool isDegenerate() const { return size == 0; }
    [[nodiscard]] DVec3 unit() const { return (1 / size) * DVec3{x, y, z}; }
};

/// By Newell's sum over the corners from `first` to before `past`. size: its length, twice the area, if that is a
/// weight, else 1. `factor` is normalFactor(convention).
FaceRow faceRow(const MeshView& mesh, std::uint32_t first, std::uint32_t past, double factor, bool by_area);

/// A call whose mesh and options have been checked.
struct NormalsCall {
    NormalsCall(const MeshView& m, const MeshView& p, const Call<NormalOptions>& o, StridedSpan<Vec3> to,
                Parallel& threads)
        : mesh(m),
          posed(p),
          options(o),
          out(to),
          allocator(o.execution.allocator),
          parallel(threads),
          faces(m, allocator),
          points(o.weld_positions ? weldPositions(m, allocator, parallel) : Buffer<std::uint32_t>()),
          items(m, faces, points, allocator),
          kernel(smooth::faceKernelFor(o.execution.simd)),
          factor(normalFactor(o.convention)),
          are_triangles(PointItems::areTriangles(m)),
          is_best(o.weighting == NormalWeighting::best),
          weighting(is_best ? NormalWeighting::angleArea : o.weighting),
          by_area(weighting == NormalWeighting::area || weighting == NormalWeighting::angleArea),
          by_angle(weighting == NormalWeighting::angle || weighting == NormalWeighting::angleArea) {}

    [[nodiscard]] smooth::FaceSource source(const MeshView& of, bool angles, bool areas) const {
        const StridedSpan<const Vec3>& p = of.positions;
        return {reinterpret_cast<const std::byte*>(p.data),
                p.stride_bytes,
                static_cast<std::uint32_t>(p.count - 1),
                factor,
                angles,
                areas};
    }

    const MeshView &mesh, &posed;  ///< the mesh decides equal points and hard edges, the pose everything else
    const Call<NormalOptions>& options;
    StridedSpan<Vec3> out;
    const Allocator* allocator;
    Parallel& parallel;
    MeshFaces faces;
    Buffer<std::uint32_t> points;  ///< the point of each vertex; empty when each is its own
    PointItems items;
    smooth::FaceKernel kernel;
    double factor;
    bool are_triangles, is_best;
    NormalWeighting weighting;  ///< weighting of the means
    bool by_area, by_angle;
    /// Output of smoothFaces for `best`: the lowest corner of each corner's component. Null: not requested.
    Buffer<std::uint32_t>* components = nullptr;
    /// Where smoothFaces writes the lowest corner that shares the normal of each corner. Null: not needed.
    std::uint32_t* shared = nullptr;
    const EdgeKind* edges = nullptr;  ///< per corner; null: all by their angle
};

/// The common case by a shorter way: triangles, all weightings but max, and a point has one normal. Scratch
/// memory: 4 bytes per vertex, core/base/range_lists.h and 1 MB, or up to 4 MB for each of several threads; where triangles
/// that follow one another are far apart 36 bytes per vertex; for `best` 60, and SumRounds. While vertices are
/// welded 10 to 24. Throws OutOfMemory.
NormalReport smoothTriangles(const NormalsCall& call);

/// Any mesh: faces of any size, hard edges, all weightings. Range by range of points, with a list of the corners around
/// each. Scratch memory: 4 bytes per vertex, core/base/range_lists.h, MeshFaces where faces differ in size, and for each task
/// 150 bytes per triangle of a range, which are an eighth of a small mesh and about 8000 of a large one; for `best`
/// also 28 bytes per corner. While vertices are welded 10 to 24 bytes per vertex. Throws OutOfMemory.
NormalReport smoothFaces(const NormalsCall& call);

/// One of these two ways.
NormalReport averageNormals(const NormalsCall& call);

/// The weighting `flat`, except that corners of degenerate faces are left as they are and counted as substitutes.
/// Points are not read.
NormalReport writeFaceNormals(const NormalsCall& call);

namespace smooth {

/// Padding: kernels read up to two vectors past the last group.
inline constexpr std::size_t kBehind = 2;

/// From the means by angle * area to the normals of `best`, in place; then options.refine steps.
///
/// adding_corners  3, or 1 where only the first corner of each triangle adds something
/// normals         one per group, zero where a mean vanished; what is there afterwards means nothing
/// sharp           the means by `max`, or zero where one vanished, and kBehind more; empty: they are found by the same
///                 triangles. Where one vanished the mean by angle * area stays
///
/// Scratch memory: 24 bytes per group with `sharp`, and SumRounds. Linear. Throws OutOfMemory.
void refine(const NormalsCall& call, const TriangleGroups& triangles, std::size_t adding_corners,
            StridedSpan<Vec3> normals, Buffer<Vec3> sharp);

}  // namespace smooth

// Finds the corners around a point that share one normal.

/// A triangle at hand; or, of another face, one of its corners with its neighbours, which has one entry.
struct LocalTriangle {
    std::uint32_t points[5];  ///< points of the corners, then the first two again, named by their lowest vertices
    std::uint32_t corner;     ///< number of the first corner in the mesh
    double weights[3];        ///< weights of the face's row
};

/// The corners at a point, ascending: entries, four times a triangle plus a corner of it.
struct PointCorners {
    std::uint32_t point, count;
    const std::uint32_t* entries;
    const LocalTriangle* triangles;

    [[nodiscard]] std::uint32_t triangle(std::uint32_t slot) const { return entries[slot] >> 2; }
    [[nodiscard]] const LocalTriangle& at(std::uint32_t slot) const { return triangles[entries[slot] >> 2]; }
    [[nodiscard]] std::uint32_t corner(std::uint32_t slot) const { return at(slot).corner + (entries[slot] & 3); }
    /// The points after and before it on the border of its face.
    [[nodiscard]] std::uint32_t next(std::uint32_t slot) const { return at(slot).points[(entries[slot] & 3) + 1]; }
    [[nodiscard]] std::uint32_t previous(std::uint32_t slot) const { return at(slot).points[(entries[slot] & 3) + 2]; }
    [[nodiscard]] double weight(std::uint32_t slot) const { return at(slot).weights[entries[slot] & 3]; }
};

/// Decides which faces may be smoothed together: creases and smoothing groups.
struct SmoothingRule {
    explicit SmoothingRule(const NormalsCall& c);

    /// No crease: every pair of faces at a point may be connected.
    [[nodiscard]] bool anyAngle() const { return call.options.crease_angle_deg >= 180; }
    /// All corners at a point are one component.
    [[nodiscard]] bool connectsAll() const { return anyAngle() && groups.empty(); }

    const NormalsCall& call;
    double crease_rad, crease_cosine;  ///< with creases faces are connected over edges that turn by no more than this
    std::span<const std::uint32_t> groups;  ///< one per face, or empty
    bool groups_are_masks;
};

/// A corner around a point, by its place there, and the component that it is in.
struct Link {
    std::uint32_t key, slot;
};

/// Finds the components of the corners at a point: returns all of them, sorted by component, then by slot. `links` has
/// room for 2 * count entries, `parents` for count. O(n log n), also when all faces share one edge.
///
/// Below 180 degrees two faces are connected over a shared edge. Where more than two faces meet in an edge,
/// each is held against the next one of its smoothing group as they turn about it, which for flat faces
/// connects the same faces as holding each against each.
///
/// rows   of the triangles at hand, by the mesh, not a pose
const Link* findComponents(const SmoothingRule& rule, const FaceRow* rows, const PointCorners& at, Link* links,
                           std::uint32_t* parents);

/// All corners as one component.
const Link* oneComponent(std::uint32_t count, Link* links);

}  // namespace tspace
