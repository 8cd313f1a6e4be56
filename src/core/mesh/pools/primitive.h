// SPDX-License-Identifier: MIT
// The middle of the pipeline: geometry of the primitives of one vertex pool in, frames for an indexed mesh out. Beside it what
// is to be mended, morph targets, and the two things that are asked of it alone: faults of triangles, and repair of tangents.
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

// Repair: at which vertices of a primitive tangents are mended, and how much of them.

/// Parts of a vertex's frame to mend, as bits.
namespace mend {
inline constexpr std::uint8_t kValues =
    1;  ///< values that no tangent may have: not finite, not unit, along N, w not +1 or -1
inline constexpr std::uint8_t kStraighten = 2;  ///< made perpendicular to N; its direction in the surface stays
inline constexpr std::uint8_t kTurnSign = 4;    ///< w is negated
inline constexpr std::uint8_t kSides =
    8;  ///< computed anew at corners whose triangle needs the other sign, or direction
inline constexpr std::uint8_t kWhole = 16;   ///< computed anew at all its corners
inline constexpr std::uint8_t kDeltas = 32;  ///< offsets of morph targets are computed anew
}  // namespace mend

struct VertexMend {
    std::uint32_t vertex = 0;  ///< vertex of the pool
    std::uint8_t parts = 0;    ///< bits of namespace mend, not 0

    friend bool operator==(const VertexMend&, const VertexMend&) = default;
};

/// The mends of one primitive. Values are mended at every vertex of the pool, listed or not.
struct Mends {
    std::vector<VertexMend> vertices = {};  ///< ascending
    /// Its signs stay inverted, and tangents that are computed anew get such signs too.
    bool inverted_signs = false;

    friend bool operator==(const Mends&, const Mends&) = default;
};

// Morph targets on the way into and out of computeFrames.

/// Offsets that one target adds to the vertices of a pool, one entry per vertex. Empty: it does not move this
/// attribute.
struct MorphOffsets {
    std::vector<Vec3> positions = {};
    std::vector<Vec3> tangents = {};  ///< tangents of the file; read only if tangents are repaired
    std::vector<Vec3> normals = {};   ///< added, then the sum is made unit; not looked at where normals are generated
};

/// The targets of a pool. They are read one by one, because a face has hundreds.
struct MorphTargets {
    std::size_t count = 0;
    /// Returns target `i`. Called by the thread that computes the pool, up to twice for each target.
    std::function<Result<MorphOffsets>(std::size_t)> read = {};
};

/// Offsets of some vertices, ascending by vertex; all others are zero.
struct VertexOffsets {
    std::vector<std::uint32_t> vertices = {};
    std::vector<Vec3> offsets = {};  ///< finite
};

/// Offsets that one target adds to the frames of the new vertices.
struct MorphFrames {
    VertexOffsets normals = {};   ///< only where normals were generated
    VertexOffsets tangents = {};  ///< to xyz; the sign cannot be morphed
};

// The middle of the pipeline: geometry in, frames for an indexed mesh out. Knows no file format. The readers fill
// PrimitiveGeometry, the writers apply PoolFrames.

/// How frames are computed.
struct FramesOptions {
    TangentOptions tangents{.convention = conventions::gltf};
    /// For pools without normals. Its weld_distance also says which positions count as one for winding.
    NormalOptions normals{.weighting = NormalWeighting::flat, .weld_distance = NormalOptions::weld_auto};
    bool sanitize = true;                         ///< mend tangents that no viewer can use
    SanitizeOptions sanitize_options = {};        ///< how, with `sanitize`
    bool bitangents = false;                      ///< compute PoolFrames::bitangents too
    VectorFormat format = VectorFormat::float32;  ///< generated normals are rounded to it before tangents are computed
    Faces faces = Faces::triangles;               ///< the faces that `mikktspace` is computed on
    Execution execution = {};
    Progress progress = {};
};

/// What was done to one primitive of a pool.
struct FramesReport {
    std::uint64_t triangle_count = 0;
    std::uint64_t vertices_before = 0, vertices_after = 0;  ///< of the pool
    std::uint64_t mended_vertex_count = 0;                  ///< vertices whose wrong tangents were mended
    /// Corners, over all targets, at which the frame of the moved shape has the other sign, which no offset can give.
    std::uint64_t morph_sign_flip_count = 0;
    bool normals_generated = false;
    bool bitangents_generated = false;
    NormalReport normals = {};
    std::uint64_t normals_behind_count = 0;  ///< corners whose generated normal points behind their own triangle
    /// Triangles that are wound against most of those they are connected with. Counted where normals are generated, and
    /// where many vertices were split; else 0. So is two_sided_triangle_count.
    std::uint64_t turned_triangle_count = 0;
    std::uint64_t two_sided_triangle_count = 0;  ///< triangles with a twin of the opposite winding
    TangentReport tangents = {};
    std::uint64_t negative_uv_count = 0;  ///< triangles with negative UV area
    SanitizeReport sanitize = {};
    Faces faces = Faces::triangles;  ///< the faces that tangents were computed on
    std::uint64_t quad_count = 0;    ///< of those, the ones with four corners or more
};

struct Surroundings;

/// One drawable piece over a pool of vertices: its corners, and per-face data.
struct PrimitiveGeometry {
    std::vector<std::uint32_t> indices = {};     ///< one per corner, into the pool; not empty for a used primitive
    std::vector<std::uint32_t> face_sizes = {};  ///< empty: triangles
    std::vector<std::uint32_t> smoothing_groups = {};  ///< one per face, or empty
    Mends mends = {};                                  ///< see PoolView::mends_tangents
    /// Triangles of other primitives that its normals are made on too; null: none. Only for triangles.
    std::shared_ptr<const Surroundings> around = {};
};

/// Vertices shared by one or more primitives (in glTF: the same attribute accessors). The arrays are those of a mesh, or a
/// file's own bytes; the caller keeps them.
struct PoolView {
    StridedSpan<const Vec3> positions = {};
    StridedSpan<const Vec3> normals = {};  ///< empty: to be generated
    StridedSpan<const Vec2> uvs = {};      ///< the set that the tangents follow; empty: none
    UvMatrix uv_matrix = {};               ///< the tangents follow uv_matrix * uvs
    MorphTargets targets = {};
    /// Not empty: these tangents are kept and no vertex is split. Only tangent deltas of morph targets are computed; normals
    /// are required.
    std::span<const Vec4> kept_tangents = {};
    /// Old values of tangents that are computed anew, one per vertex, or empty: they may tell on which faces they were
    /// made.
    std::span<const Vec4> old_tangents = {};
    bool is_blenders = false;  ///< Blender wrote the file
    /// The kept tangents stay but at the vertices that each primitive's `mends` names. There vertices are split where
    /// corners want different tangents, and morph targets get new offsets where tangents are new.
    bool mends_tangents = false;
    bool makes_tangents = true;  ///< false: normals alone are made

    PoolView() = default;
    PoolView(const OwnedMesh& mesh) : positions(mesh.positions), normals(mesh.normals), uvs(mesh.uvs) {}
};

/// Frames for all primitives of one pool after splitting it.
struct PoolFrames {
    bool normals_generated = false;  ///< rounded to FramesOptions::format; tangents belong to the rounded ones
    /// New vertex -> old vertex, identity first (SplitResult::source_vertices).
    std::vector<std::uint32_t> source_vertices = {};
    std::vector<Vec3> normals = {};     ///< one per new vertex when normals_generated, else empty
    std::vector<Vec4> tangents = {};    ///< one per new vertex; empty when tangents are not wanted or not possible
    std::vector<Vec3> bitangents = {};  ///< one per new vertex where FramesOptions::bitangents is set, else empty
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
/// Reports count faults of the triangles (surface_faults.cpp).
/// Vertices that no corner uses get a frame from their normal, so that every tangent written is unit. With sanitize
/// every bitangent is unit as well (mendBitangents). `reports` has one entry per primitive; its normals, tangents,
/// sanitize and count fields are filled (vertices are those of the pool). Morph targets: base + offset is the frame of
/// the moved shape, computed with the base's hard edges and groups. There is one split for the base and all targets.
/// Where faces collapse in a target the base's tangent stays. A vertex whose frame no target changes has the offset (0,
/// 0, 0). Polygons are cut before tangents are computed. Run again on its own output it gives the same bits and splits
/// nothing. Exception: `lengyel` where sanitize made corners of one vertex differ, because that method sums over vertex
/// indices.
Result<PoolFrames> computeFrames(const PoolView& pool, std::span<const PrimitiveGeometry> primitives,
                                 const FramesOptions& options, std::span<FramesReport> reports);

// Faults of the triangles that frames were made on, counted for a report.

/// Fills normals_behind_count, turned_triangle_count and two_sided_triangle_count of primitives that share their vertices.
///
/// normals        those that were generated, one per vertex, or empty
/// corner_lists   one list per report, three corners per triangle
/// weld_distance  positions this near count as one (NormalOptions::weld_distance)
void countFaults(std::span<const Vec3> positions, std::span<const Vec3> normals,
                 std::span<const std::vector<std::uint32_t>> corner_lists, float weld_distance,
                 std::span<FramesReport> reports);

// Repair of tangents and bitangents: values that are wrong are mended, and all others keep their bits.

/// The kept tangent with sound values (hasSoundValues): a length that is off is made unit, w becomes +1 or -1,
/// and `instead`, which is sound, has the direction where there is none. What is sound keeps its bits.
Vec4 withSoundValues(const Vec4& kept, const Vec4& instead, const Vec3& normal);

/// Unit and perpendicular to N.
Vec4 tangentFromNormal(const Vec3& normal, float sign);

/// withSoundValues for all vertices of a mesh whose tangents stay, used by triangles or not: a tangent without
/// direction gets that of a sound corner of its triangles, or at its position, else one from N. UVs are not read; there
/// may be no normals, and no triangles. `along_normals`: a tangent along N counts as a direction too.
Result<Done> mendValues(const TangentView& mesh, bool along_normals, std::span<Vec4> tangents);

/// Puts the tangents that a pool keeps in place of those computed for a primitive, but where they are to be mended.
///
/// corners    the pool's vertex of each corner, three per triangle
/// tangents   one per corner: in, what was computed; out, what is written
///
/// Returns one entry per corner: whether what morph targets add is to be new there, too. Near-linear.
std::vector<bool> mendCorners(const PoolView& pool, std::span<const std::uint32_t> corners, const Mends& mends,
                              std::span<Vec4> tangents);

/// sign * cross(N, T), unit. Where N has no direction: a unit vector across T.
Vec3 bitangentOf(const Vec4& tangent, const Vec3& normal);

/// A bitangent stays, bit for bit, when it and its tangent are sound: it is unit, within 3 degrees of the plane across
/// N, and on the side of sign * cross(N, T), and sanitize left the tangent where it was (within 8 degrees). Others
/// become bitangentOf the mended tangent.
///
/// normals     one per vertex; `indices` has one per corner, as all the others
/// computed    the tangents before sanitize
/// mended      the same after it
void mendBitangents(StridedSpan<const Vec3> normals, std::span<const std::uint32_t> indices,
                    std::span<const Vec4> computed, std::span<const Vec4> mended, std::span<Vec3> bitangents);

}  // namespace tspace
