// SPDX-License-Identifier: MIT
// The middle of the pipeline: geometry in, frames for an indexed mesh out. Knows no file format. The readers fill
// PrimitiveGeometry, the writers apply PrimitiveFrames.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tspace/asset.h"
#include "tspace/split.h"

namespace tspace {

/// One drawable piece over a pool of vertices: its corners, and per-face data.
struct PrimitiveGeometry {
    std::vector<std::uint32_t> indices = {};           ///< one per corner, into the pool; never empty for a used primitive
    std::vector<std::uint32_t> face_sizes = {};        ///< empty: triangles
    std::vector<std::uint32_t> smoothing_groups = {};  ///< one per face, or empty
};

/// Vertices shared by one or more primitives (in glTF: the same attribute accessors).
struct VertexPool {
    std::vector<Vec3> positions = {};
    std::vector<Vec3> normals = {};  ///< empty: to be generated
    std::vector<Vec2> uvs = {};      ///< the set that the tangents follow; empty: none
};

/// Frames for all primitives of one pool after splitting it.
struct PoolFrames {
    bool normals_generated = false;
    /// New vertex -> old vertex, identity first (SplitResult::source_vertices).
    std::vector<std::uint32_t> source_vertices = {};
    std::vector<Vec3> normals = {};   ///< one per new vertex when normals_generated, else empty
    std::vector<Vec4> tangents = {};  ///< one per new vertex; empty when no tangents were asked for or possible
    /// Per primitive: triangles after cutting n-gons, three new vertices each, in face order.
    std::vector<std::vector<std::uint32_t>> indices = {};

    [[nodiscard]] bool wasSplit(std::size_t old_vertex_count) const { return source_vertices.size() != old_vertex_count; }
};

/// Runs normals (if missing), tangents per primitive, sanitize, and one split over all primitives of the pool.
/// Vertices that no corner uses get a frame from their normal, so that every tangent written is unit.
/// `reports` has one entry per primitive; its normals, tangents, sanitize and count fields are filled (vertices are
/// those of the pool).
/// Polygons are cut before tangents are computed. Run again on its own output it gives the same bits and splits nothing.
/// Exception: `lengyel` where sanitize made corners of one vertex differ, because that method sums over vertex indices.
Result<PoolFrames> computeFrames(const VertexPool& pool, std::span<const PrimitiveGeometry> primitives,
                                 const GenerateOptions& options, std::span<PrimitiveReport> reports);

}  // namespace tspace
