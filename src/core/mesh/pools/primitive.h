// SPDX-License-Identifier: MIT
// Core of the pipeline: computes frames of an indexed mesh from the geometry of the primitives of a vertex pool. Also
// the data for repair and morph targets, and two separate functions: counting faults of triangles, and repair of
// tangents.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/base/owned_mesh.h"
#include "core/mesh/surface/surface.h"
#include "core/mesh/surface/uvs.h"
#include "tspace/callbacks.h"
#include "tspace/execution.h"
#include "tspace/mesh.h"
#include "tspace/normals.h"
#include "tspace/pack.h"
#include "tspace/result.h"
#include "tspace/span.h"
#include "tspace/tangents.h"

namespace tspace {

// Selection of the vertices of a primitive whose tangents are repaired, and of the parts that are repaired.

/// Parts of a vertex's frame to repair, as bits.
namespace repair {
/// invalid values are replaced: not finite, not unit, parallel to N, or w other than +1 and -1
inline constexpr std::uint8_t kValues = 1;
/// the tangent is made perpendicular to N, and keeps its direction in the surface
inline constexpr std::uint8_t kStraighten = 2;
inline constexpr std::uint8_t kTurnSign = 4;  ///< w is negated
/// the tangent is recomputed at corners whose triangle needs the other sign or direction
inline constexpr std::uint8_t kSides = 8;
inline constexpr std::uint8_t kWhole = 16;   ///< the tangent is recomputed at all corners of the vertex
inline constexpr std::uint8_t kDeltas = 32;  ///< offsets of morph targets are recomputed
}  // namespace repair

struct VertexRepair {
    std::uint32_t vertex = 0;  ///< vertex in the pool
    std::uint8_t parts = 0;    ///< combination of the bits of namespace repair; not 0

    friend bool operator==(const VertexRepair&, const VertexRepair&) = default;
};

/// Repairs of one primitive. Invalid values are repaired at every vertex of the pool, listed or not.
struct Repairs {
    std::vector<VertexRepair> vertices = {};  ///< vertices to repair, ascending
    /// true: the signs remain inverted, and recomputed tangents get inverted signs too.
    bool inverted_signs = false;

    friend bool operator==(const Repairs&, const Repairs&) = default;
};

// Morph targets as input and output of computeFrames.

/// Offsets of one target for the vertices of a pool, one entry per vertex. Empty: the target does not change this
/// attribute.
struct MorphOffsets {
    std::vector<Vec3> positions = {};
    std::vector<Vec3> tangents = {};  ///< offsets of the tangents in the file; read only if tangents are repaired
    /// offsets of the normals, added before the sum is normalized; ignored if normals are generated
    std::vector<Vec3> normals = {};
};

/// Targets of a pool. They are read one by one, because a face model has hundreds.
struct MorphTargets {
    std::size_t count = 0;
    /// Returns target `i`. Called by the thread that computes the pool, up to twice for each target.
    std::function<Result<MorphOffsets>(std::size_t)> read = {};
};

/// Offsets of some vertices, in ascending order of vertices; all other vertices have the offset zero.
struct VertexOffsets {
    std::vector<std::uint32_t> vertices = {};
    std::vector<Vec3> offsets = {};  ///< one per entry of `vertices`, finite
};

/// Offsets of one target for the frames of the new vertices.
struct MorphFrames {
    VertexOffsets normals = {};   ///< offsets of normals; only if normals were generated
    VertexOffsets tangents = {};  ///< offsets of the tangents' x, y and z; the sign cannot be morphed
};

// Interface of the core for model files: geometry in, frames of an indexed mesh out, independent of file formats.
// Readers of files fill PrimitiveGeometry, and writers apply PoolFrames.

/// Options of computeFrames.
struct FramesOptions {
    TangentOptions tangents{.convention = conventions::gltf};
    /// Options for pools without normals. weld_distance also applies to winding.
    NormalOptions normals{.weighting = NormalWeighting::flat, .weld_distance = NormalOptions::weld_auto};
    bool sanitize = true;                   ///< true: repair tangents that no viewer can use
    SanitizeOptions sanitize_options = {};  ///< options of the repair, with `sanitize`
    bool bitangents = false;                ///< true: compute PoolFrames::bitangents too
    /// format to which generated normals are rounded before tangents are computed
    VectorFormat format = VectorFormat::float32;
    Faces faces = Faces::triangles;  ///< faces that `mikktspace` is computed on
    Execution execution = {};
    Progress progress = {};
};

/// Result for one primitive of a pool.
struct FramesReport {
    std::uint64_t triangle_count = 0;
    std::uint64_t vertices_before = 0, vertices_after = 0;  ///< vertex counts of the pool
    std::uint64_t mended_vertex_count = 0;                  ///< vertices whose wrong tangents were repaired
    /// Corners, over all targets, at which the frame of the moved shape has the opposite sign, which offsets cannot
    /// represent.
    std::uint64_t morph_sign_flip_count = 0;
    bool normals_generated = false;
    bool bitangents_generated = false;
    NormalReport normals = {};
    std::uint64_t normals_behind_count = 0;  ///< corners whose generated normal points to the back of their triangle
    /// Triangles wound opposite to the majority of their connected component. Counted, like two_sided_triangle_count,
    /// if normals are generated or many vertices were split; otherwise 0.
    std::uint64_t turned_triangle_count = 0;
    /// triangles with the positions of another triangle of the opposite winding
    std::uint64_t two_sided_triangle_count = 0;
    TangentReport tangents = {};
    std::uint64_t negative_uv_count = 0;  ///< triangles with negative UV area
    SanitizeReport sanitize = {};
    Faces faces = Faces::triangles;  ///< faces that tangents were computed on
    std::uint64_t quad_count = 0;    ///< number of these faces with four or more corners
};

struct Surroundings;

/// Drawable primitive over a pool of vertices: its corners, and per-face data.
struct PrimitiveGeometry {
    std::vector<std::uint32_t> indices = {};     ///< one per corner, into the pool; not empty for a used primitive
    std::vector<std::uint32_t> face_sizes = {};  ///< number of corners of each face; empty: triangles
    std::vector<std::uint32_t> smoothing_groups = {};  ///< group of each face, or empty
    Repairs repairs = {};                              ///< repairs of this primitive (PoolView::repairs_tangents)
    /// Triangles of other primitives that contribute to its normals; null: none. Must be null for primitives with faces
    /// of more than three corners.
    std::shared_ptr<const Surroundings> around = {};
};

/// Vertices shared by one or more primitives (in glTF: the same attribute accessors). The arrays belong to the caller:
/// a mesh or a file's bytes.
struct PoolView {
    StridedSpan<const Vec3> positions = {};
    StridedSpan<const Vec3> normals = {};  ///< one per vertex; empty: normals are generated
    StridedSpan<const Vec2> uvs = {};      ///< UV set for the tangents; empty: none
    UvMatrix uv_matrix = {};               ///< matrix that UVs are multiplied by before tangents are computed
    MorphTargets targets = {};
    /// If not empty: these tangents are kept and no vertex is split. Only tangent deltas of morph targets are computed;
    /// requires normals.
    std::span<const Vec4> kept_tangents = {};
    /// Stored values of tangents that are recomputed, one per vertex, or empty. They indicate the faces that they were
    /// computed on.
    std::span<const Vec4> old_tangents = {};
    bool is_from_blender = false;  ///< true: Blender wrote the file
    /// Tangents are kept except at the vertices in each primitive's `repairs`. There, vertices are split where corners
    /// require different tangents, and morph targets get new offsets where tangents are new.
    bool repairs_tangents = false;
    bool makes_tangents = true;  ///< false: only normals are computed

    PoolView() = default;
    PoolView(const OwnedMesh& mesh) : positions(mesh.positions), normals(mesh.normals), uvs(mesh.uvs) {}
};

/// Frames for all primitives of one pool after splitting it.
struct PoolFrames {
    /// true: `normals` were generated and rounded to FramesOptions::format, and tangents fit the rounded normals
    bool normals_generated = false;
    /// Old vertex of each new vertex; the first vertices are unchanged (SplitResult::source_vertices).
    std::vector<std::uint32_t> source_vertices = {};
    std::vector<Vec3> normals = {};     ///< one per new vertex when normals_generated, else empty
    std::vector<Vec4> tangents = {};    ///< one per new vertex; empty if tangents are not requested or not possible
    std::vector<Vec3> bitangents = {};  ///< one per new vertex where FramesOptions::bitangents is set, else empty
    /// Triangles of each primitive after triangulation: three new vertices per triangle, in face order.
    std::vector<std::vector<std::uint32_t>> indices = {};
    /// One entry per morph target. If tangents are kept, the list is empty unless they equal computed ones. If tangents
    /// are repaired, targets that had tangents keep their offsets at unrepaired corners, and the entries of targets
    /// without tangents are valid only if differing_count is 0.
    std::vector<MorphFrames> morphs = {};
    /// Number of corners whose kept tangent, repaired or not, differs from the computed one by its sign or by over 5
    /// degrees.
    std::uint64_t differing_count = 0;

    [[nodiscard]] bool wasSplit(std::size_t old_vertex_count) const {
        return source_vertices.size() != old_vertex_count;
    }
};

/// Computes normals (if missing), tangents per primitive, sanitizes, and splits once over all primitives of the pool.
/// Reports count faults of the triangles (surface_faults.cpp).
/// Unused vertices get a frame from their normal, so that every written tangent is unit. With sanitize every bitangent
/// is unit as well (repairBitangents). `reports` has one entry per primitive; its normals, tangents, sanitize and count
/// fields are filled (vertices are those of the pool). Morph targets: base + offset is the frame of the moved shape,
/// computed with the base's hard edges and groups. There is one split for the base and all targets. If faces collapse
/// in a target, the base's tangent is kept. A vertex whose frame no target changes has the offset (0, 0, 0). Polygons
/// are triangulated before tangents are computed. Idempotent: its own output gives the same bits and no splits.
/// Exception: `lengyel` if sanitizing made corners of a vertex differ, because that method sums over vertex indices.
Result<PoolFrames> computeFrames(const PoolView& pool, std::span<const PrimitiveGeometry> primitives,
                                 const FramesOptions& options, std::span<FramesReport> reports);

// Faults of the triangles that frames were computed on, for reports.

/// Fills normals_behind_count, turned_triangle_count and two_sided_triangle_count of primitives that share their
/// vertices.
///
/// normals        generated normals, one per vertex, or empty
/// corner_lists   one list per report, three corners per triangle
/// weld_distance  same meaning as NormalOptions::weld_distance
void countFaults(std::span<const Vec3> positions, std::span<const Vec3> normals,
                 std::span<const std::vector<std::uint32_t>> corner_lists, float weld_distance,
                 std::span<FramesReport> reports);

// Repair of tangents and bitangents: invalid values are repaired, and all others keep their bits.

/// Returns `kept` with valid values (hasValidValues): normalized if its length is invalid, with w = +1 or -1, and with
/// the direction of `instead` (which must be valid) if `kept` has none. Valid values keep their bits.
Vec4 withValidValues(const Vec4& kept, const Vec4& instead, const Vec3& normal);

/// Returns a unit tangent perpendicular to N, with the given sign.
Vec4 tangentFromNormal(const Vec3& normal, float sign);

/// Applies withValidValues to all vertices of a mesh whose tangents are kept, used by triangles or not: a tangent
/// without direction gets the direction of a valid corner of its triangles, or at its position, otherwise one from N.
/// UVs are not read; normals and triangles are optional. `along_normals`: a tangent parallel to N counts as a direction
/// too.
Result<Done> repairValues(const TangentView& mesh, bool along_normals, std::span<Vec4> tangents);

/// Replaces the tangents computed for a primitive by the tangents that a pool keeps, except where they are to be
/// repaired.
///
/// corners    the pool's vertex of each corner, three per triangle
/// tangents   one per corner: in, the computed ones; out, the ones to write
///
/// Returns, per corner, whether morph deltas must be recomputed there too. Near-linear.
std::vector<bool> repairCorners(const PoolView& pool, std::span<const std::uint32_t> corners, const Repairs& repairs,
                                std::span<Vec4> tangents);

/// Returns the unit vector sign * cross(N, T). If N has no direction, returns a unit vector perpendicular to T.
Vec3 bitangentOf(const Vec4& tangent, const Vec3& normal);

/// Repairs bitangents. A bitangent keeps its bits if it and its tangent are valid: it is unit, within 3 degrees of the
/// plane perpendicular to N, and on the side of sign * cross(N, T), and sanitize did not move the tangent (by more than
/// 8 degrees). Others become bitangentOf the repaired tangent.
///
/// normals     one per vertex; `indices` and all others have one per corner
/// computed    the tangents before sanitize
/// repaired    the tangents after sanitize
void repairBitangents(StridedSpan<const Vec3> normals, std::span<const std::uint32_t> indices,
                      std::span<const Vec4> computed, std::span<const Vec4> repaired, std::span<Vec3> bitangents);

}  // namespace tspace
