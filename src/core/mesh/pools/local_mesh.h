// SPDX-License-Identifier: MIT
// One primitive as a mesh of its own, alone or with the triangles around it.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/base/owned_mesh.h"
#include "core/mesh/pools/primitive.h"
#include "core/mesh/quads/quads.h"
#include "tspace/mesh.h"
#include "tspace/normals.h"

namespace tspace {

// One primitive as a mesh of its own. A pool is often shared by many primitives that each use a small part of it, and
// what the methods do per vertex should cost in proportion to that part.

/// A view of arrays of the pool, or of its own. Moving it leaves the views valid.
struct LocalMesh {
    StridedSpan<const Vec3> positions, normals;
    StridedSpan<const Vec2> uvs;
    std::span<const std::uint32_t> indices;
    std::span<const std::uint32_t> face_sizes;

    OwnedMesh own;  ///< arrays that are not borrowed from the pool
    /// The vertex of the pool that each vertex was when the mesh was made; empty: the same.
    std::vector<std::uint32_t> sources;
    /// For quads that were paired from triangles: the face corner of each corner of the triangles. Empty: faces are the
    /// triangles.
    std::vector<std::uint32_t> face_corners;

    LocalMesh() = default;
    LocalMesh(LocalMesh&&) = default;
    LocalMesh& operator=(LocalMesh&&) = default;

    void useOwnIndices() { indices = own.indices; }
    void useOwnVertices() {
        positions = own.positions;
        normals = own.normals;
        uvs = own.uvs;
    }

    /// Corners of its triangles.
    [[nodiscard]] std::size_t triangleCornerCount() const {
        return face_corners.empty() ? indices.size() : face_corners.size();
    }

    [[nodiscard]] MeshView view() const {
        MeshView mesh;
        mesh.positions = positions;
        mesh.normals = normals;
        mesh.uvs = uvs;
        mesh.indices = IndexView(indices);
        mesh.face_sizes = face_sizes;
        return mesh;
    }
};

/// Turns a mesh of triangles into one of these faces over them.
void takeFaces(QuadFaces&& faces, LocalMesh& mesh);

/// values[face corner] for each corner of the mesh's triangles.
template <class T>
void toTriangles(const LocalMesh& mesh, std::span<const T> values, std::span<T> of_triangles) {
    for (std::size_t c = 0; c < of_triangles.size(); ++c) of_triangles[c] = values[mesh.face_corners[c]];
}

/// The whole pool with the corners of one primitive.
MeshView viewInPool(const PoolView& pool, const PrimitiveGeometry& primitive);

/// Makes the meshes of a pool's primitives, which must be valid.
class LocalMeshes {
  public:
    /// The pool must outlive this.
    LocalMeshes(const PoolView& pool, std::size_t primitive_count) : pool_(pool), primitive_count_(primitive_count) {}

    LocalMesh make(const PrimitiveGeometry& primitive);

  private:
    void takeUsedPart(const PrimitiveGeometry& primitive, LocalMesh& mesh);

    const PoolView& pool_;
    std::size_t primitive_count_;
    std::vector<std::uint32_t> local_of_vertex_;  ///< all kNoSlot between primitives
};

inline std::span<const std::uint32_t> spanOf(const std::vector<std::uint32_t>& values) { return values; }

/// values[source] for each source; nothing where there are no values.
template <class T>
std::vector<T> gather(StridedSpan<const T> values, const std::vector<std::uint32_t>& sources) {
    std::vector<T> result;
    if (values.empty()) return result;
    result.reserve(sources.size());
    for (const std::uint32_t source : sources) result.push_back(values[source]);
    return result;
}

template <class T>
std::vector<T> gather(std::span<const T> values, const std::vector<std::uint32_t>& sources) {
    return gather(StridedSpan<const T>(values), sources);
}

/// One normal per vertex, from any of its corners; unused vertices get an arbitrary one.
std::vector<Vec3> gatherNormals(const std::vector<Vec3>& normals, const std::vector<std::uint32_t>& corners);

// Normals of a primitive that is one surface with others: their triangles at the border count too.

/// Triangles of other primitives around one. They get no normals here.
struct Surroundings {
    OwnedMesh mesh = {};  ///< its normals are those that stay, zero where there is none; it may have none at all
    std::size_t triangles_before = 0;  ///< triangles of primitives that precede this one in the file
    std::uint64_t point_count = 0;     ///< positions that the primitive shares with the others
    /// Like MorphTargets::read, for these vertices; no function if targets do not move them.
    std::function<Result<MorphOffsets>(std::size_t)> read = {};
};

/// The normals of one primitive, on the base and in poses, one after the other.
class BorderedNormals {
  public:
    /// `around`: null where nothing is around the mesh, which has polygons only then. All must outlive this.
    BorderedNormals(const LocalMesh& mesh, const Surroundings* around, const NormalOptions& options,
                    const Execution& execution);

    /// generateNormals of the mesh, one per corner of it. Where a vertex around the mesh has a normal that stays, and that is
    /// within 30 degrees (and within the crease angle) of the one that would be made at the same position, it is taken.
    /// Sums are in the order of the file, so that both sides of a border get the same bits.
    Result<NormalReport> base(StridedSpan<Vec3> out);
    /// generatePoseNormals, after base(); `positions` are those of the mesh as target `target` moves it.
    Result<NormalReport> pose(const StridedSpan<const Vec3>& positions, std::size_t target, StridedSpan<Vec3> out);

  private:
    void choose(std::span<const Vec3> normals);
    NormalReport take(const NormalReport& of_whole, std::span<const Vec3> normals, StridedSpan<Vec3> out) const;

    const LocalMesh& mesh_;
    const Surroundings* around_;
    const NormalOptions& options_;
    const Execution& execution_;
    OwnedMesh whole_ = {};          ///< the vertices of the mesh, then those around it; empty: nothing is around it
    std::size_t first_corner_ = 0;  ///< number of the first corner in the mesh
    std::vector<std::uint32_t> stays_ = {};  ///< per corner of the mesh: the vertex around it whose normal it takes
    std::uint64_t degenerate_around_ = 0;
};

}  // namespace tspace
