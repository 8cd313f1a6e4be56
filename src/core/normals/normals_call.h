// SPDX-License-Identifier: MIT
// Smoothing of normals: arguments and faces of a call, automatic hard edges, the two algorithms (smoothTriangles,
// smoothFaces), the final rounds of NormalWeighting::best, and the corners around a point that share a normal.
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

/// Kind of the edge from a corner to the next one on its face.
enum class EdgeKind : std::uint8_t {
    byAngle,  ///< decided by the dihedral angle, for edges that do not have exactly two faces
    soft,
    hard,
};

// Arguments and faces of a call, and the algorithms that smooth normals.

/// Maps corners of a mesh to faces, and faces to corners. Faces of equal size need no table; otherwise it takes 4 bytes
/// per corner and face.
class MeshFaces {
  public:
    MeshFaces(const MeshView& mesh, const Allocator* allocator);

    /// Returns the face of a corner. first(), past(): the first corner of a face, and the corner after its last.
    [[nodiscard]] std::uint32_t of(std::uint32_t corner) const {
        return size_ == 3 ? corner / 3 : size_ != 0 ? corner / size_ : corner_faces_[corner];
    }
    [[nodiscard]] std::uint32_t first(std::uint32_t face) const {
        return size_ != 0 ? face * size_ : first_corners_[face];
    }
    [[nodiscard]] std::uint32_t past(std::uint32_t face) const { return first(face + 1); }
    struct Around {
        std::uint32_t corners[3];  ///< a corner, followed by the next and the previous corner on the border of its face
    };
    [[nodiscard]] Around around(std::uint32_t corner) const {
        const std::uint32_t face = of(corner), begin = first(face), end = past(face);
        return {{corner, corner + 1 == end ? begin : corner + 1, (corner == begin ? end : corner) - 1}};
    }
    [[nodiscard]] std::uint32_t next(std::uint32_t corner) const { return around(corner).corners[1]; }
    [[nodiscard]] std::uint32_t previous(std::uint32_t corner) const { return around(corner).corners[2]; }
    /// Returns whether a face has at least 3 corners; all others are ignored everywhere.
    [[nodiscard]] bool isUsed(std::uint32_t face) const { return past(face) - first(face) >= 3; }
    [[nodiscard]] std::uint64_t usedCount() const { return used_count_; }

  private:
    std::uint32_t size_ = 0;  ///< number of corners of every face; 0: sizes differ
    std::uint64_t used_count_ = 0;
    Buffer<std::uint32_t> first_corners_, corner_faces_;
};

/// Items of a mesh that range lists sort by points: triangles, or single corners of other faces.
class PointItems final : public TriangleGroups {
  public:
    /// `points`: point of each vertex; empty if each vertex is its own point.
    PointItems(const MeshView& mesh, const MeshFaces& faces, const Buffer<std::uint32_t>& points,
               const Allocator* allocator);

    static bool areTriangles(const MeshView& mesh) { return mesh.face_sizes.empty() && mesh.face_size == 3; }

    [[nodiscard]] std::uint32_t pointOf(std::uint32_t corner) const {
        const std::uint32_t vertex = mesh_.indices[corner];
        return points_.empty() ? vertex : points_[vertex];
    }
    /// Reads items. A corner is read as a triangle with the next and the previous corner, and with its own point three
    /// times; corners of faces with fewer than 3 corners have no points.
    void read(std::size_t first, std::size_t size, std::uint32_t* vertices, std::uint32_t* points) const override;
    void readSome(const std::uint32_t* numbers, std::size_t size, std::uint32_t* vertices,
                  std::uint32_t* points) const override;
    [[nodiscard]] InPlace inPlace(std::size_t first, std::size_t) const override;

  private:
    template <class NumberOf>
    void readEach(NumberOf numberOf, std::size_t size, std::uint32_t* vertices, std::uint32_t* points) const;

    enum Block : std::uint8_t { unknown, own, shared };  // own: each vertex of the block is its own point

    const MeshView& mesh_;
    const MeshFaces& faces_;
    const Buffer<std::uint32_t>& points_;
    /// the mesh indices, if all faces are triangles and indices have 32 bits; otherwise null
    const std::uint32_t* in_place_;
    /// Cached results of inPlace, one per block: a comparison replaces looking up points in each pass. Nearly all
    /// blocks are `own` if neighboring triangles are stored close together.
    mutable Buffer<std::uint8_t> blocks_;
};

/// Normal of a face times `size`, followed by `size`; zeros for a degenerate face.
struct FaceRow {
    double x, y, z, size;

    [[nodiscard]] bool isDegenerate() const { return size == 0; }
    [[nodiscard]] DVec3 unit() const { return (1 / size) * DVec3{x, y, z}; }
};

/// Computes Newell's sum over the corners in [first, past). size: its length, twice the area, if that is a weight,
/// otherwise 1. `factor` is normalFactor(convention).
FaceRow faceRow(const MeshView& mesh, std::uint32_t first, std::uint32_t past, double factor, bool by_area);

/// Arguments of a call, with a validated mesh and options.
struct NormalsCall {
    NormalsCall(const MeshView& m, const MeshView& p, const Call<NormalOptions>& o, StridedSpan<Vec3> to,
                Parallel& threads)
        : mesh(m), posed(p), options(o), out(to), allocator(o.execution.allocator), parallel(threads),
          faces(m, allocator),
          points(o.weld_positions ? weldPositions(m, allocator, parallel) : Buffer<std::uint32_t>()),
          items(m, faces, points, allocator), kernel(smooth::faceKernelFor(o.execution.simd)),
          factor(normalFactor(o.convention)), are_triangles(PointItems::areTriangles(m)),
          is_best(o.weighting == NormalWeighting::best), weighting(is_best ? NormalWeighting::angleArea : o.weighting),
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

    /// the mesh determines equal points and hard edges, the posed mesh all other results
    const MeshView &mesh, &posed;
    const Call<NormalOptions>& options;
    StridedSpan<Vec3> out;
    const Allocator* allocator;
    Parallel& parallel;
    MeshFaces faces;
    Buffer<std::uint32_t> points;  ///< point of each vertex; empty if each vertex is its own point
    PointItems items;
    smooth::FaceKernel kernel;
    double factor;
    bool are_triangles, is_best;
    NormalWeighting weighting;  ///< weighting of the means
    bool by_area, by_angle;
    /// Output of smoothFaces for `best`: the lowest corner of each corner's component. Null: not requested.
    Buffer<std::uint32_t>* components = nullptr;
    /// Output of smoothFaces: the lowest corner that shares the normal of each corner. Null: not needed.
    std::uint32_t* shared = nullptr;
    const EdgeKind* edges = nullptr;  ///< edge kind of each corner; null: all edges are decided by their angle
};

/// Averages normals in the common case (fast path): triangles, all weightings except max, and one normal per point.
/// Scratch memory: 4 bytes per vertex, that of RangeLists, and 1 MB, or up to 4 MB for each of several threads. If
/// consecutive triangles are far apart: 36 bytes per vertex. For `best`: 60 bytes per vertex, and SumRounds. Welding
/// temporarily takes 10 to 24 bytes per vertex. Throws OutOfMemory.
NormalReport smoothTriangles(const NormalsCall& call);

/// Averages normals in the general case: faces of any size, hard edges, all weightings. Processes ranges of points,
/// with a list of the corners around each point. Scratch memory: 4 bytes per vertex, that of RangeLists, that of
/// MeshFaces if faces differ in size, and for each task 150 bytes per triangle of a range (an eighth of a small mesh,
/// about 8000 triangles of a large one); for `best`, 28 more bytes per corner. Welding temporarily takes 10 to 24 bytes
/// per vertex. Throws OutOfMemory.
NormalReport smoothFaces(const NormalsCall& call);

/// Calls smoothTriangles or smoothFaces.
NormalReport averageNormals(const NormalsCall& call);

/// Writes the normals of the weighting `flat`. Corners of degenerate faces are not written, and are counted as
/// substitutes. Does not read points.
NormalReport writeFaceNormals(const NormalsCall& call);

namespace smooth {

/// Number of vectors of padding after an array: kernels read up to two vectors past the last group.
inline constexpr std::size_t kPaddingVectors = 2;

/// Converts the means by angle * area to the normals of `best`, in place; then performs options.refine steps.
///
/// adding_corners  3, or 1 if only the first corner of each triangle contributes
/// normals         in/out, one per group; a zero input (a mean that vanished) results in an undefined output
/// sharp           means by `max`, one per group, followed by kPaddingVectors unused entries; empty: computed from
///                 `triangles`. Where a mean is zero (it vanished), the mean by angle * area is kept
///
/// Scratch memory: 24 bytes per group with `sharp`, and SumRounds. Linear. Throws OutOfMemory.
void refine(const NormalsCall& call, const TriangleGroups& triangles, std::size_t adding_corners,
            StridedSpan<Vec3> normals, Buffer<Vec3> sharp);

}  // namespace smooth

// Search for the corners around a point that share a normal.

/// A triangle, copied to local memory; for faces that are not triangles, a corner with its two neighbors, as one entry.
struct LocalTriangle {
    /// points of the corners, followed by the first two again; a point is identified by its lowest vertex
    std::uint32_t points[5];
    std::uint32_t corner;  ///< index of the first corner in the mesh
    double weights[3];     ///< weight of the face at each corner
};

/// Corners at a point, ascending: entries are 4 * triangle + corner of the triangle.
struct PointCorners {
    std::uint32_t point, count;
    const std::uint32_t* entries;
    const LocalTriangle* triangles;

    [[nodiscard]] std::uint32_t triangle(std::uint32_t slot) const { return entries[slot] >> 2; }
    [[nodiscard]] const LocalTriangle& at(std::uint32_t slot) const { return triangles[entries[slot] >> 2]; }
    [[nodiscard]] std::uint32_t corner(std::uint32_t slot) const { return at(slot).corner + (entries[slot] & 3); }
    /// next(): returns the next point on the border of the face; previous(): returns the point before it.
    [[nodiscard]] std::uint32_t next(std::uint32_t slot) const { return at(slot).points[(entries[slot] & 3) + 1]; }
    [[nodiscard]] std::uint32_t previous(std::uint32_t slot) const { return at(slot).points[(entries[slot] & 3) + 2]; }
    [[nodiscard]] double weight(std::uint32_t slot) const { return at(slot).weights[entries[slot] & 3]; }
};

/// Rule for the faces that may be smoothed together: creases and smoothing groups.
struct SmoothingRule {
    explicit SmoothingRule(const NormalsCall& c);

    /// Returns whether there are no creases: every pair of faces at a point may be connected.
    [[nodiscard]] bool anyAngle() const { return call.options.crease_angle_deg >= 180; }
    /// Returns whether all corners at a point are always smoothed together.
    [[nodiscard]] bool connectsAll() const { return anyAngle() && groups.empty(); }

    const NormalsCall& call;
    double crease_rad, crease_cosine;       ///< maximum angle between connected faces, if there are creases
    std::span<const std::uint32_t> groups;  ///< smoothing group of each face, or empty
    bool groups_are_masks;
};

/// A corner around a point, identified by its slot, with its component.
struct Link {
    std::uint32_t key, slot;
};

/// Finds the components of the corners at a point, and returns all corners, sorted by component, then by slot. `links`
/// has room for 2 * count entries, `parents` for count. O(n log n), also if all faces share one edge.
///
/// Below 180 degrees two faces are connected over a shared edge. If more than two faces meet at an edge, each is
/// compared with the next one of its smoothing group by angle around the edge; for flat faces this connects the same
/// faces as comparing all pairs.
///
/// rows   rows of the local triangles, computed from the mesh, not from a pose
const Link* findComponents(const SmoothingRule& rule, const FaceRow* rows, const PointCorners& at, Link* links,
                           std::uint32_t* parents);

/// Returns all corners as one component.
const Link* oneComponent(std::uint32_t count, Link* links);

}  // namespace tspace
