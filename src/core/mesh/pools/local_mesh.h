// SPDX-License-Identifier: MIT
// One primitive as a separate mesh, alone or with the triangles around it.
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

// A primitive as a mesh of its own. A pool is often shared by many primitives that each use a small part of it, and the
// cost of per-vertex operations should be proportional to that part.

/// Mesh of one primitive, whose views refer to arrays of the pool, or to its own arrays. Moving it keeps the views
/// valid.
struct LocalMesh {
    StridedSpan<const Vec3> positions, normals;
    StridedSpan<const Vec2> uvs;
    std::span<const std::uint32_t> indices;
    std::span<const std::uint32_t> face_sizes;

    OwnedMesh own;  ///< arrays that are not borrowed from the pool
    /// Vertex of the pool that each vertex was copied from. Empty: the vertices are those of the pool.
    std::vector<std::uint32_t> sources;
    /// For quads that were formed from pairs of triangles: the face corner of each triangle corner. Empty: all faces
    /// are triangles.
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

    /// Returns the number of triangle corners, also if pairs of triangles form quads.
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

/// Replaces the faces of a triangle mesh by `faces`, which are formed from its triangles.
void replaceFaces(QuadFaces&& faces, LocalMesh& mesh);

/// Sets of_triangles[c], for each triangle corner c, to the value of its face corner.
template <class T>
void toTriangles(const LocalMesh& mesh, std::span<const T> values, std::span<T> of_triangles) {
    for (std::size_t c = 0; c < of_triangles.size(); ++c) of_triangles[c] = values[mesh.face_corners[c]];
}

/// Returns a view of the whole pool with the corners of one primitive.
MeshView viewInPool(const PoolView& pool, const PrimitiveGeometry& primitive);

/// Creates the meshes of a pool's primitives, which must be valid.
class LocalMeshes {
  public:
    /// The pool must outlive the object.
    LocalMeshes(const PoolView& pool, std::size_t primitive_count) : pool_(pool), primitive_count_(primitive_count) {}

    LocalMesh make(const PrimitiveGeometry& primitive);

  private:
    void copyUsedPart(const PrimitiveGeometry& primitive, LocalMesh& mesh);

    const PoolView& pool_;
    std::size_t primitive_count_;
    /// local vertex of each vertex of the pool; all entries are kNoSlot, except while a primitive is copied
    std::vector<std::uint32_t> local_of_vertex_;
};

inline std::span<const std::uint32_t> spanOf(const std::vector<std::uint32_t>& values) { return values; }

/// Returns values[source] for each source; empty if there are no values.
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

/// Returns one normal per vertex, from any of its corners; unused vertices get an arbitrary one.
std::vector<Vec3> gatherNormals(const std::vector<Vec3>& normals, const std::vector<std::uint32_t>& corners);

// Normals of a primitive that forms one surface with others: triangles of the others at the border also contribute.

/// Triangles of other primitives around a primitive, and their existing normals.
struct Surroundings {
    /// Vertices and triangles. Normals: those that are kept, zero at other vertices; empty if none are kept.
    OwnedMesh mesh = {};
    std::size_t triangles_before = 0;  ///< triangles of primitives that precede this one in the file
    std::uint64_t point_count = 0;     ///< positions that the primitive shares with the others
    /// Reads the offsets of a target for these vertices, like MorphTargets::read; empty if targets do not move them.
    std::function<Result<MorphOffsets>(std::size_t)> read = {};
};

/// Computes the normals of one primitive, on the base mesh and in its poses, one after the other.
class BorderedNormals {
  public:
    /// `around`: null if no triangles surround the mesh; must be null for meshes with polygons. All arguments must
    /// outlive the object.
    BorderedNormals(const LocalMesh& mesh, const Surroundings* around, const NormalOptions& options,
                    const Execution& execution);

    /// Computes generateNormals of the mesh, one per corner. A computed normal is replaced by a kept normal of a
    /// surrounding vertex at the same position, if the two differ by at most 30 degrees (and the crease angle). Sums
    /// are in file order, so that both sides of a border get the same bits.
    Result<NormalReport> base(StridedSpan<Vec3> out);
    /// Computes generatePoseNormals; call after base(). `positions` are the positions of the mesh moved by target
    /// `target`.
    Result<NormalReport> pose(const StridedSpan<const Vec3>& positions, std::size_t target, StridedSpan<Vec3> out);

  private:
    void choose(std::span<const Vec3> normals);
    NormalReport take(const NormalReport& of_whole, std::span<const Vec3> normals, StridedSpan<Vec3> out) const;

    const LocalMesh& mesh_;
    const Surroundings* around_;
    const NormalOptions& options_;
    const Execution& execution_;
    /// vertices of the mesh, followed by surrounding ones; empty: no surroundings
    OwnedMesh whole_ = {};
    std::size_t first_corner_ = 0;           ///< number of the mesh's first corner among the corners of `whole_`
    std::vector<std::uint32_t> stays_ = {};  ///< per corner of the mesh: the surrounding vertex whose normal it uses
    std::uint64_t degenerate_around_ = 0;
};

}  // namespace tspace
