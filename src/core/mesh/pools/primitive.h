// SPDX-License-Identifier: MIT
// The middle of the pipeline: geometry in, frames for an indexed mesh out. Knows no file format. The readers fill
// PrimitiveGeometry, the writers apply PrimitiveFrames.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/mesh/pools/mends.h"
#include "core/mesh/pools/morph_targets.h"
#include "core/mesh/surface/uv_matrix.h"
#include "tspace/asset.h"
#include "tspace/span.h"
#include "tspace/split.h"

namespace tspace {

struct Surroundings;

/// One drawable piece over a pool of vertices: its corners, and per-face data.
struct PrimitiveGeometry {
    std::vector<std::uint32_t> indices = {};     ///< one per corner, into the pool; not empty for a used primitive
    std::vector<std::uint32_t> face_sizes = {};  ///< empty: triangles
    std::vector<std::uint32_t> smoothing_groups = {};  ///< one per face, or empty
    Mends mends = {};                                  ///< see VertexPool::mends_tangents
    /// Triangles of other primitives that its normals are made on too; null: none. Only for triangles.
    std::shared_ptr<const Surroundings> around = {};
};

/// Vertices shared by one or more primitives (in glTF: the same attribute accessors).
struct VertexPool {
    std::vector<Vec3> positions = {};
    std::vector<Vec3> normals = {};  ///< empty: to be generated
    std::vector<Vec2> uvs = {};      ///< the set that the tangents follow; empty: none
    UvMatrix uv_matrix = {};         ///< the tangents follow uv_matrix * uvs
    MorphTargets targets = {};
    /// Not empty: these tangents stay and no vertex is split. Only what morph targets add to them is computed; there
    /// must be normals.
    std::vector<Vec4> kept_tangents = {};
    /// These tangents stay but at the vertices that each primitive's `mends` names. There vertices are split where
    /// corners want different tangents, and morph targets get new offsets where tangents are new.
    bool mends_tangents = false;
};

/// A pool whose arrays the caller owns and keeps: a VertexPool, or a file's own bytes.
struct PoolView {
    StridedSpan<const Vec3> positions = {}, normals = {};
    StridedSpan<const Vec2> uvs = {};
    UvMatrix uv_matrix = {};
    MorphTargets targets = {};
    std::span<const Vec4> kept_tangents = {};
    /// Old values of tangents that are computed anew, one per vertex, or empty: they may tell on which faces they were
    /// made.
    std::span<const Vec4> old_tangents = {};
    bool is_blenders = false;  ///< Blender wrote the file
    bool mends_tangents = false;
    bool makes_tangents = true;  ///< false: normals alone are made

    PoolView() = default;
    PoolView(const VertexPool& pool)
        : positions(pool.positions),
          normals(pool.normals),
          uvs(pool.uvs),
          uv_matrix(pool.uv_matrix),
          targets(pool.targets),
          kept_tangents(pool.kept_tangents),
          mends_tangents(pool.mends_tangents) {}
};

/// Frames for all primitives of one pool after splitting it.
struct PoolFrames {
    bool normals_generated = false;  ///< rounded to GenerateOptions::format; tangents belong to the rounded ones
    /// New vertex -> old vertex, identity first (SplitResult::source_vertices).
    std::vector<std::uint32_t> source_vertices = {};
    std::vector<Vec3> normals = {};     ///< one per new vertex when normals_generated, else empty
    std::vector<Vec4> tangents = {};    ///< one per new vertex; empty when tangents are not wanted or not possible
    std::vector<Vec3> bitangents = {};  ///< one per new vertex where GenerateOptions::bitangents is set, else empty
    /// Per primitive: triangles after cutting n-gons, three new vertices each, in face order.
    std::vector<std::vector<std::uint32_t>> indices = {};
    /// One per morph target. With kept tangents it is empty where these are not the tangents that would be
    /// computed; with mended ones that holds for the targets that had no tangents.
    std::vector<MorphFrames> morphs = {};
    /// With kept tangents, mended or not: corners whose tangent is another than would be computed (by sign, or by over 5 degrees).
    std::uint64_t differing_count = 0;

    [[nodiscard]] bool wasSplit(std::size_t old_vertex_count) const {
        return source_vertices.size() != old_vertex_count;
    }
};

/// Runs normals (if missing), tangents per primitive, sanitize, and one split over all primitives of the pool.
/// Reports count faults of the triangles (surface_faults.h).
/// Vertices that no corner uses get a frame from their normal, so that every tangent written is unit. With sanitize
/// every bitangent is unit as well (mend_tangents.h). `reports` has one entry per primitive; its normals, tangents,
/// sanitize and count fields are filled (vertices are those of the pool). Morph targets: base + offset is the frame of
/// the moved shape, computed with the base's hard edges and groups. There is one split for the base and all targets.
/// Where faces collapse in a target the base's tangent stays. A vertex whose frame no target changes has the offset (0,
/// 0, 0). Polygons are cut before tangents are computed. Run again on its own output it gives the same bits and splits
/// nothing. Exception: `lengyel` where sanitize made corners of one vertex differ, because that method sums over vertex
/// indices.
Result<PoolFrames> computeFrames(const PoolView& pool, std::span<const PrimitiveGeometry> primitives,
                                 const GenerateOptions& options, std::span<PrimitiveReport> reports);

}  // namespace tspace
