// SPDX-License-Identifier: MIT
// Tangents, one result per corner; `indexed_frames.h` converts them to an indexed mesh.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tspace/convention.h"
#include "tspace/execution.h"
#include "tspace/mesh.h"

namespace tspace {

/// Method of computing tangents. `docs/concepts/methods/` has a page for each.
enum class Method : std::uint32_t {
    /// Bit-identical to the MikkTSpace reference implementation (Mikkelsen 2008), for triangles and quads.
    mikktspace = 0,
    /// Sum of the unnormalized dP/du and dP/dv of the faces at a vertex index, Gram-Schmidt against N, sign from the
    /// bitangent (Lengyel 2001). Never splits: all corners of a vertex index get the same tangent.
    lengyel = 1,
    /// Weighted mean of unit face tangents in the groups of `mikktspace` with corrected pairing. The weight of a face
    /// at a corner is 1 (`uniform`), the corner angle (`angle`), or the face's area (`area`).
    uniform = 2,
    angle = 3,
    area = 4,
    /// The face's own dP/du at each of its corners, orthogonalized against that corner's N.
    flat = 5,
    /// Orthonormal basis from N, without UVs (Duff et al. 2017). No such basis is continuous over a closed surface.
    basis = 6,
    /// Two weighted sums of dP/du in the groups of `angle`: one that is accurate on smooth surfaces (Max 1999), and one
    /// that is robust on bevels and noise, blended by the angle between them. More accurate than all weighted means, at
    /// little more cost than `uniform`.
    fast = 7,
    /// Quadratic map from UVs to the tangent plane, fitted to the edges around each vertex (polynomial preserving
    /// recovery, Zhang and Naga 2005), in the groups of `angle`; if the fit is unreliable, a robust mean. The error of
    /// its tangents decreases with the square of the edge length; the error of all other methods decreases linearly.
    best = 8,
};

/// Returns the name of a method as in the tool and the docs ("mikktspace"); "unknown" for other values.
const char* methodName(Method method);

/// Rule by which `mikktspace` pairs neighboring faces.
enum class Pairing : std::uint32_t {
    reference = 0,  ///< with the reference's bug: the last bucket of its edge list is not sorted
    corrected = 1,  ///< without the bug: grouping does not depend on the order of faces
};

/// Treatment of faces with more than 4 corners, which the MikkTSpace reference ignores.
enum class Ngons : std::uint32_t {
    triangulate = 0,  ///< triangulated by triangulate(); results are per corner of the n-gon
    skip = 1,         ///< skipped, as in the reference: all outputs are 0
};

/// Element type of the outputs.
enum class OutputDomain : std::uint32_t {
    corner = 0,
    /// One entry per vertex of the mesh: for `lengyel` and `basis`, whose results are equal at all corners of a vertex.
    /// Each entry is bit-identical to the result at every corner of the vertex. Vertices that no used face refers to
    /// get 0.
    vertex = 1,
};

/// Orthonormal frame that replaces dP/du and dP/dv where sheared UVs make them non-perpendicular.
enum class FrameShape : std::uint32_t {
    /// T is the direction of dP/du; the shader's `sign * cross(N, T)` deviates from dP/dv by the shear.
    gramSchmidt = 0,
    /// T is the bisector of dP/du and the direction perpendicular to dP/dv (Löwdin 1950): both deviate by half of the
    /// shear. Closer to the UVs, but not what bakers and engines with another tangent space expect.
    symmetric = 1,
};

/// Options of generateTangents: first those for all methods, then those of a single method, which others ignore.
struct TangentOptions {
    Method method = Method::mikktspace;  ///< the default is what bakers and glTF expect
    /// Determines the stored sign; there is no default: conventions::gltf for glTF; conventions::opengl stores the raw
    /// sign, as the reference does. If unset: invalidOption.
    Convention convention = {};
    Ngons ngons = Ngons::triangulate;  ///< by default every corner gets a tangent
    /// `vertex` for `lengyel` and `basis` only: other methods have several results per vertex
    OutputDomain domain = OutputDomain::corner;
    /// `symmetric` is rejected for `mikktspace`, whose results are those of the reference, and for `basis`, which uses
    /// no UVs. The default is what bakers and engines expect.
    FrameShape frame = FrameShape::gramSchmidt;
    /// true: normalize normals whose length deviates from 1 by more than 8-bit rounding does (0.00674) before they are
    /// used; all others, and those without a direction, keep their bits. false, the default: use normals as given, as
    /// the reference does. A tangent is then not perpendicular to a normal that is not unit: on a sphere it deviates by
    /// up to 28 degrees at length 2.
    bool normalize_normals = false;

    // For `mikktspace` only:

    /// Angular threshold in degrees, 0 to 180: faces of a group whose tangents (or bitangents) differ by this or more
    /// are not averaged. 180 is the default of the reference and of every baker. As in the reference, any float is
    /// accepted, but only its cosine is used: 270 has the effect of 90. With NaN no two faces are averaged.
    float angular_threshold_deg = 180.0f;
    Pairing pairing = Pairing::reference;  ///< the default is bit-identical to every other MikkTSpace

    // For `best` only:

    /// Number of refinement steps after the fit: 0, 1 or 2. A step changes each frame so that, interpolated along the
    /// edges around it, it reproduces these edges, as far as they agree. 1: a fifth less shading error. 2: another
    /// twentieth less.
    std::uint32_t refine = 1;
};

/// Counts of triangles, groups and defects of the input. Invalid geometry never makes a call fail.
struct TangentReport {
    std::uint64_t triangle_count = 0;             ///< processed triangles, after triangulation of quads and n-gons
    std::uint64_t degenerate_triangle_count = 0;  ///< triangles with two corners at the same position
    std::uint64_t degenerate_uv_count = 0;        ///< triangles without UV area: they use the frames of their neighbors
    std::uint64_t mirrored_count = 0;             ///< triangles that show the image mirrored, in the chosen convention
    std::uint64_t skipped_face_count = 0;         ///< faces for which nothing was computed
    std::uint64_t group_count = 0;                ///< groups: sets of corners that share one tangent
    std::uint64_t default_corner_count = 0;       ///< outputs without a tangent from any face: default of the method
    std::uint64_t not_finite_count = 0;           ///< outputs whose tangent has a NaN or infinity
    /// `mikktspace`: the input would drive the reference into quadratic time, so one of its steps was skipped. This is
    /// either the sort (with Pairing::reference; the corrected pairing was used for the last bucket; only crafted
    /// inputs cause this), or the angular test (a group of more than 4096 faces whose tangents spread too far was not
    /// split).
    bool reference_order_abandoned = false;
};

/// Output arrays: one entry per corner (or vertex, see OutputDomain). Only `tangents` is required; empty spans are not
/// written.
struct TangentOutput {
    /// xyz: unit tangent; w: sign (+1 or -1), `B = w * cross(N, T)` in the chosen convention.
    StridedSpan<Vec4> tangents = {};
    /// Unit direction of dP/dv (times signFactor(convention)), averaged like the tangent; in general not cross(N, T).
    /// For methods without a bitangent (`basis`): sign * cross(N, T).
    StridedSpan<Vec3> bitangents = {};
    StridedSpan<float> magnitudes_s = {};  ///< mean length of dP/du; 1 for methods that compute none
    StridedSpan<float> magnitudes_t = {};  ///< mean length of dP/dv; 1 for methods that compute none
    /// 1: at least one face contributes to the tangent. 0: none does, and the method's default was written (counted in
    /// TangentReport::default_corner_count), or the entry was cleared, as for corners of skipped faces and unused
    /// vertices.
    StridedSpan<std::uint8_t> has_tangent = {};
};

/// Shape of a mesh at one moment: the data that change while it deforms. Counts, order and index lists are those of the
/// MeshView that the plan was created from.
struct Pose {
    StridedSpan<const Vec3> positions = {};
    StridedSpan<const Vec3> normals = {};
};

/// Precomputed data that do not change while a mesh deforms: welding, neighbors, groups, splits, UVs. Owns its memory
/// and keeps no pointer to the mesh. Immutable, so many threads may evaluate one plan at the same time. If it was
/// created with an Allocator, that must outlive it. A moved-from plan is equivalent to the plan of a mesh without
/// vertices.
class TangentPlan {
  public:
    TangentPlan(TangentPlan&&) noexcept;
    TangentPlan& operator=(TangentPlan&&) noexcept;
    ~TangentPlan();

    [[nodiscard]] std::size_t vertexCount() const;
    [[nodiscard]] std::size_t cornerCount() const;
    /// Returns the number of entries of every output: cornerCount(), or vertexCount() with OutputDomain::vertex.
    [[nodiscard]] std::size_t outputCount() const;
    [[nodiscard]] Method method() const;
    /// Returns the memory that the plan uses, in bytes.
    [[nodiscard]] std::size_t memoryBytes() const;

    struct State;                              ///< private
    explicit TangentPlan(State* state);        ///< private; takes ownership
    [[nodiscard]] const State& state() const;  ///< private

  private:
    State* state_;
};

/// Computes the tangents of a mesh in one call.
///
/// mesh       positions; unit normals (all methods; see TangentOptions::normalize_normals); UVs (all but `basis`)
/// options    the convention must be set
/// out        spans of mesh.cornerCount() entries (mesh.vertexCount() with OutputDomain::vertex); must not overlap the
///            inputs or each other
/// execution  threads and memory; does not affect the result
/// Corners of faces with fewer than 3 corners (and of n-gons with Ngons::skip) get 0 in every output. Results are per
/// corner: do not write them through the old index list, but split vertices whose corners differ (splitVertices, or
/// makeIndexedFrames for all steps). Tangents that are not finite or not unit are left as the method computed them:
/// sanitizeTangents repairs them.
/// The result has the same bits as planTangents followed by evaluateTangents on the mesh's own pose, but most meshes
/// take a faster path. A mesh with several index lists (MeshView::normal_indices, uv_indices) has the results of
/// the equivalent mesh with one list.
/// Errors: those of validate(); missingAttribute, countMismatch (outputs), nullData, invalidOption, outOfMemory;
/// tooLarge also for more than 715,827,882 triangles (methods with groups: mikktspace, uniform, angle, area, fast,
/// best). The contents of the outputs are undefined until the call returns, and after an error.
/// Linear in the number of corners for any input (fans, books, collapsed faces). Thread-safe. Same bits for any thread
/// count and SIMD target.
///
/// Scratch memory on a triangle mesh: `lengyel` 16 bytes per vertex, or 8 with OutputDomain::vertex (24 if the
/// tangents' stride is not 16). `mikktspace`, `uniform`, `angle` and `area` about 36 bytes per vertex if no two
/// vertices are equal, 46 otherwise, 80 if outputs other than tangents are requested, and 32 per triangle for unindexed
/// corners (more if the tangents' stride is not 16: see docs/reference/memory.md); up to about 130 bytes per triangle
/// for meshes that need the general path (thresholds, values that are not finite), and about 150 more for each triangle
/// around a vertex with special cases (several groups, uncertain splits, degenerate triangles). `fast` and `best` need
/// about as much, and up to 2 MB per thread; `best` 32 bytes more per group for each refinement step.
/// FrameShape::symmetric adds 12 bytes per output unless bitangents are requested, and a mesh with several index lists
/// adds about 40 bytes per corner, from operator new.
Result<TangentReport> generateTangents(const MeshView& mesh, const TangentOptions& options, const TangentOutput& out,
                                       const Execution& execution = {});

/// One mesh of a generateTangents call for many meshes.
struct MeshJob {
    MeshView mesh = {};
    TangentOptions options = {};  ///< the convention must be set
    TangentOutput out = {};       ///< spans of the sizes that a single call for this mesh requires
};

/// Computes the tangents of many meshes in one call. It starts threads once, not once per mesh, and each thread reuses
/// its scratch memory. Use it for models with hundreds or thousands of small primitives.
///
/// jobs       any number of meshes, which may share inputs; outputs must not overlap inputs or each other, across all
///            jobs
/// execution  each thread takes whole meshes, except that all threads cooperate on a mesh with more corners than a
///            thread's share of all corners
/// Returns one result per job, in the order of the jobs: the report or the error that generateTangents(mesh, options,
/// out) returns for this job alone. A job that fails does not affect the others. The outputs have the bits of single
/// calls.
/// Errors of the call itself: outOfMemory (for the results and the scratch memory of the threads); the contents of all
/// outputs are then undefined.
/// Linear in the number of all corners and jobs. Thread-safe. Same bits for any thread count and SIMD target.
///
/// Scratch memory: 128 KB per thread; if a job needs more, as much as a single call for this mesh. An allocator of
/// `execution` is called from all threads, but never by two of them at the same time.
Result<std::vector<Result<TangentReport>>> generateTangents(std::span<const MeshJob> jobs,
                                                            const Execution& execution = {});

/// Creates a plan: welds equal vertices (position, normal and UV all equal), finds neighbors, groups and splits.
/// Inputs, errors and complexity as generateTangents. An allocator of `execution` must outlive the plan.
Result<TangentPlan> planTangents(const MeshView& mesh, const TangentOptions& options, const Execution& execution = {});

/// Computes frames for a pose with the plan's groups and splits. Each corner uses the pose's position and normal of its
/// own vertex, also if vertices that were equal on the mesh differ in the pose. For the pose that the plan was created
/// from, the result is bit-identical to generateTangents. `execution` replaces the plan's. Scratch memory of methods
/// with groups: 12 bytes per group if only tangents are requested, otherwise 44; with several threads also up to 12
/// bytes per triangle for triangles in random order, and almost none for ordered ones. Errors: planMismatch if counts
/// differ from the plan's, and those of span checks. O(corners).
Result<TangentReport> evaluateTangents(const TangentPlan& plan, const Pose& pose, const TangentOutput& out,
                                       const Execution& execution = {});

// Repair of invalid tangents; valid tangents keep their bits.

struct SanitizeOptions {
    /// Also normalize valid tangents and make them orthogonal to N. Off by default: the result would no longer match a
    /// bake made with the method's own tangents (quantized normals are not unit, so the reference's tangents can
    /// deviate by up to a degree).
    bool orthogonalize_all = false;
};

/// Corners repaired, by cause (the first that applies, in this order) and by fix.
struct SanitizeReport {
    std::uint64_t not_finite_count = 0;      ///< NaN or infinity in the tangent
    std::uint64_t zero_count = 0;            ///< length 0 (or too small to normalize)
    std::uint64_t not_unit_count = 0;        ///< length off by more than 5e-4 (the glTF validator's tolerance)
    std::uint64_t parallel_count = 0;        ///< within 1 degree of +N or -N: no frame can be built
    std::uint64_t placeholder_count = 0;     ///< exactly (1, 0, 0), and not perpendicular to N
    std::uint64_t bad_sign_count = 0;        ///< sign not exactly +1 or -1
    std::uint64_t mixed_sign_count = 0;      ///< sign changed because the signs of the face's corners differed
    std::uint64_t orthogonalized_count = 0;  ///< valid tangents changed by orthogonalize_all

    std::uint64_t normalized_count = 0;     ///< fix: its own direction, made unit and orthogonal to N
    std::uint64_t from_neighbor_count = 0;  ///< fix: direction of a valid corner of the same face or position
    std::uint64_t from_basis_count = 0;     ///< fix: basis from N (Duff et al. 2017)

    std::uint64_t bad_normal_count = 0;  ///< corners whose N is zero or not finite: only a unit tangent is guaranteed

    /// Returns the number of corners that were written: the sum of the causes.
    [[nodiscard]] std::uint64_t mendedCount() const {
        return not_finite_count + zero_count + not_unit_count + parallel_count + placeholder_count + bad_sign_count +
               mixed_sign_count + orthogonalized_count;
    }
};

/// Repairs tangents in place. A tangent is invalid if it contains NaN or infinity, is zero, has a length that differs
/// from 1 by more than 5e-4, is within 1 degree of +-N, is a placeholder that is not perpendicular to N, has a sign
/// that is not +-1, or if the signs within its face differ. Repaired tangents are unit and orthogonal to the corner's N
/// (normalized) within 1e-6, with sign +1 or -1. Valid tangents keep every bit.
///
/// Placeholder: the reference writes exactly (1, 0, 0) to corners around which no triangle has UV area, for any N. A
/// tangent from UVs with these bits has been projected along N, so it is perpendicular to N.
///
/// Fixes, in this order: the tangent's own direction, if it has one that is not parallel to N; the tangent of the first
/// valid corner of the same face; that of the first valid corner at the same position (in corner order); a basis from
/// N. Signs inside a face: the majority of the valid corners decides (of those whose N has a direction, if there are
/// any); on a tie, the first of them. If N has no direction, corners at one position that do not use their own
/// direction, and have the same sign, share the tangent of the first of them. The result does not depend on the
/// indexing of vertices, so repairing a split mesh again changes nothing.
///
/// mesh       positions and normals; UVs are ignored
/// tangents   one per corner, read and written; corners of faces with fewer than 3 corners are not changed
/// execution  threads and memory; does not affect the result
/// Errors: those of validate(); missingAttribute (normals), countMismatch, nullData, outOfMemory.
/// O(corners). Thread-safe; same bits for any thread count.
Result<SanitizeReport> sanitizeTangents(const MeshView& mesh, const SanitizeOptions& options,
                                        StridedSpan<Vec4> tangents, const Execution& execution = {});

}  // namespace tspace
