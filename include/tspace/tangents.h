// SPDX-License-Identifier: MIT
// Tangents: what tspace is for. One result per corner; `indexed_frames.h` turns them into an indexed mesh.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tspace/convention.h"
#include "tspace/execution.h"
#include "tspace/mesh.h"

namespace tspace {

/// How tangents are computed. `docs/concepts/methods/` has a page for each.
enum class Method : std::uint32_t {
    /// Bit for bit the result of the MikkTSpace reference implementation (Mikkelsen 2008), for triangles and quads.
    mikktspace = 0,
    /// Sum of the unnormalised dP/du and dP/dv of the faces at a vertex index, Gram-Schmidt against N, sign from the
    /// bitangent (Lengyel 2001). Never splits: all corners of one vertex index get one tangent.
    lengyel = 1,
    /// Weighted mean of unit face tangents in the groups of `mikktspace` with corrected pairing. The weight of a
    /// face at a corner is 1, the corner angle, or the face's area.
    uniform = 2,
    angle = 3,
    area = 4,
    /// The face's own dP/du at each of its corners, made orthogonal to that corner's N.
    flat = 5,
    /// No UVs: an orthonormal basis from N alone (Duff et al. 2017). No such basis is continuous over a closed surface.
    basis = 6,
    /// Two weighted sums of dP/du in the groups of `angle`: one that is accurate on smooth surfaces (Max 1999), one
    /// that is robust on bevels and noise, mixed by the angle between them. More accurate than all weighted means,
    /// and hardly dearer than `uniform`.
    fast = 7,
    /// A quadratic map from UVs to the tangent plane, fitted to the edges around each vertex (polynomial preserving
    /// recovery, Zhang and Naga 2005), in the groups of `angle`; where the fit is doubtful it becomes a robust mean.
    /// The error of its tangents falls with the square of the edge length, not with the length as that of all others.
    best = 8,
};

/// The name of a method as the tool and the docs spell it ("mikktspace"); "unknown" for other values.
const char* methodName(Method method);

/// How `mikktspace` finds neighbouring faces.
enum class Pairing : std::uint32_t {
    reference = 0,  ///< with the reference's defect: the last bucket of its edge list is not sorted
    corrected = 1,  ///< without it: grouping no longer depends on the order of faces
};

/// What happens to faces with more than 4 corners, which the MikkTSpace reference ignores.
enum class Ngons : std::uint32_t {
    triangulate = 0,  ///< cut as by triangulate(); results come back per corner of the n-gon
    skip = 1,         ///< as the reference: nothing is computed, outputs are 0
};

/// What one entry of the outputs belongs to.
enum class OutputDomain : std::uint32_t {
    corner = 0,
    /// One entry per vertex of the mesh: `lengyel` and `basis`, whose results are the same at all corners of a vertex.
    /// Every entry has the bits that the vertex's corners would get. Vertices that no used face names get 0.
    vertex = 1,
};

/// Which orthonormal frame stands for dP/du and dP/dv, where UVs are sheared and the two are not perpendicular.
enum class FrameShape : std::uint32_t {
    /// T is the direction of dP/du, and the shader's `sign * cross(N, T)` is off from dP/dv by the shear.
    gramSchmidt = 0,
    /// T is the bisector of dP/du and of the direction perpendicular to dP/dv (Löwdin 1950): both are off by half of
    /// the shear. Nearer to what the UVs say, but not what a baker or an engine with another tangent space expects.
    symmetric = 1,
};

/// How tangents are computed. First what all methods have, then what one of them has alone and others do not look at.
struct TangentOptions {
    Method method = Method::mikktspace;  ///< the default is what bakers and glTF expect
    /// Decides the stored sign, and has no default: conventions::gltf for glTF; conventions::opengl stores the raw sign, as
    /// the reference does. invalidOption where it is not set.
    Convention convention = {};
    Ngons ngons = Ngons::triangulate;  ///< the default leaves no corner without a tangent
    OutputDomain domain =
        OutputDomain::corner;  ///< `vertex` for `lengyel` and `basis` only: others have no one result per vertex
    /// `symmetric` is refused for `mikktspace`, whose results are the reference's, and for `basis`, which has no UVs. The
    /// default is what bakers and engines expect.
    FrameShape frame = FrameShape::gramSchmidt;
    /// true: a normal whose length is further from 1 than rounding to 8 bits explains (0.00674) is scaled to length 1 before
    /// anything is computed from it; all others, and those without a direction, keep their bits. false, the default, takes
    /// normals as they are: no method scales them, as the reference does not. A tangent is then not perpendicular to a
    /// normal that is not unit: on a sphere it is off by up to 28 degrees at length 2.
    bool normalize_normals = false;

    // `mikktspace` alone:

    /// Degrees, meant for 0..360. Faces of one group whose tangents (or bitangents) differ by this or more are not averaged.
    /// 180 is the reference's default and what every baker uses. As in the reference, any float is taken: only its cosine
    /// counts, and with NaN no two faces are averaged.
    float angular_threshold_deg = 180.0f;
    Pairing pairing = Pairing::reference;  ///< the default has the bits of every other MikkTSpace

    // `best` alone:

    /// 0, 1 or 2 steps after the fit. A step changes each frame so that, interpolated along the edges around it, it gives
    /// these edges, as far as they agree. 1: a fifth less error in what is shaded. 2: another twentieth less. 0: the fit alone.
    std::uint32_t refine = 1;
};

/// Counts of triangles, groups and defects of the input. Broken input never makes a call fail.
struct TangentReport {
    std::uint64_t triangle_count = 0;             ///< triangles computed with, after cutting quads and n-gons
    std::uint64_t degenerate_triangle_count = 0;  ///< two corners at the same position
    std::uint64_t degenerate_uv_count = 0;        ///< triangles without UV area: they take their neighbours' frame
    std::uint64_t mirrored_count = 0;             ///< triangles that show the image mirrored, in the convention
    std::uint64_t skipped_face_count = 0;         ///< faces for which nothing was computed
    std::uint64_t group_count = 0;                ///< groups: sets of corners that share one tangent
    std::uint64_t default_corner_count = 0;       ///< outputs that no face gives a tangent: the method's default
    std::uint64_t not_finite_count = 0;           ///< outputs whose tangent has a NaN or infinity
    /// `mikktspace`: the input drives the reference itself into quadratic time, so its last step was left out. Either
    /// its sort (with Pairing::reference): the corrected pairing was used for the last bucket; only crafted inputs do
    /// this. Or its angular test: a group of more than 4096 faces whose tangents spread too far was not split.
    bool reference_order_abandoned = false;
};

/// Where results go: one entry per corner (or vertex, see OutputDomain). Only `tangents` is required; empty spans are
/// not written.
struct TangentOutput {
    /// xyz: unit tangent; w: sign (+1 or -1), `B = w * cross(N, T)` in the chosen convention.
    StridedSpan<Vec4> tangents = {};
    /// Unit direction of dP/dv (times signFactor(convention)), averaged like the tangent; in general not
    /// cross(N, T). For methods that have none (`basis`): sign * cross(N, T).
    StridedSpan<Vec3> bitangents = {};
    StridedSpan<float> magnitudes_s = {};  ///< mean length of dP/du; 1 for methods without
    StridedSpan<float> magnitudes_t = {};  ///< mean length of dP/dv; 1 for methods without
    /// 1: at least one face gives the entry its tangent. 0: none does, and the method's default was written (counted in
    /// TangentReport::default_corner_count), or the entry was cleared, as corners of skipped faces and unused vertices are.
    StridedSpan<std::uint8_t> has_tangent = {};
};

/// The shape of a mesh at one moment: what changes while a mesh deforms. Counts and meaning as in the MeshView that the
/// plan was made from, index lists included.
struct Pose {
    StridedSpan<const Vec3> positions = {};
    StridedSpan<const Vec3> normals = {};
};

/// Everything about a mesh that does not change while it deforms: welding, neighbours, groups, splits, UVs.
/// Owns its memory and keeps no pointer into the mesh it was made from. Immutable, so many threads may evaluate
/// one plan at the same time. If it was made with an Allocator, that must outlive it. A plan that was moved from is that of a
/// mesh without vertices.
class TangentPlan {
  public:
    TangentPlan(TangentPlan&&) noexcept;
    TangentPlan& operator=(TangentPlan&&) noexcept;
    ~TangentPlan();

    [[nodiscard]] std::size_t vertexCount() const;
    [[nodiscard]] std::size_t cornerCount() const;
    /// Entries of every output: cornerCount(), or vertexCount() with OutputDomain::vertex.
    [[nodiscard]] std::size_t outputCount() const;
    [[nodiscard]] Method method() const;
    /// Bytes held by the plan.
    [[nodiscard]] std::size_t memoryBytes() const;

    struct State;                              ///< private
    explicit TangentPlan(State* state);        ///< private; deletes it in the end
    [[nodiscard]] const State& state() const;  ///< private

  private:
    State* state_;
};

/// Tangents for a mesh in one call.
///
/// mesh       positions; unit normals (all methods; see TangentOptions::normalize_normals); UVs (all but `basis`)
/// options    the convention must be set
/// out        spans of mesh.cornerCount() entries (mesh.vertexCount() with OutputDomain::vertex); must not overlap the
///            inputs or each other
/// execution  threads and memory; changes no bit
/// Corners of faces with fewer than 3 corners (and of n-gons with Ngons::skip) get 0 in every output. Results are per
/// corner: do not write them through the old index list, but split vertices whose corners disagree (splitVertices, or
/// makeIndexedFrames for all in one). Tangents that are not finite or not unit stay as the method gives them:
/// sanitizeTangents mends them.
/// The bits are those of planTangents and then evaluateTangents on the mesh's own pose, but most meshes take a shorter way.
/// A mesh with several index lists (MeshView::normal_indices, uv_indices) has the results of the mesh that its caller would
/// have unrolled.
/// Errors: those of validate(); missingAttribute, countMismatch (outputs), nullData, invalidOption, outOfMemory;
/// tooLarge also for more than 715,827,882 triangles (the methods that group: mikktspace, uniform, angle, area, fast,
/// best). Until the call returns, and when it fails, the outputs hold anything.
/// Linear in the number of corners whatever the input (fans, books, collapsed faces). Thread-safe. Same bits for any
/// thread count and SIMD target.
///
/// Scratch memory on a mesh of triangles: `lengyel` 16 bytes per vertex, or 8 with OutputDomain::vertex (24 where the
/// tangents' stride is not 16). `mikktspace`, `uniform`, `angle` and `area` about 36 bytes per vertex without equal
/// vertices, 46 with some, 80 when more than tangents is asked for, and 32 per triangle for unindexed corners (where the
/// tangents' stride is not 16 some more: see docs/reference/memory.md); up to about 130 bytes per triangle for meshes that need the
/// long way (thresholds, values that are not finite), and about 150 beside the first for each triangle around a vertex
/// that needs a second look (several groups, doubtful splits, degenerate triangles). `fast` and `best` take about as much,
/// and up to 2 MB per thread; `best` 32 bytes per group more for each of its steps. FrameShape::symmetric adds 12 bytes
/// per output unless bitangents are asked for, and a mesh with several index lists about 40 bytes per corner of operator
/// new.
Result<TangentReport> generateTangents(const MeshView& mesh, const TangentOptions& options, const TangentOutput& out,
                                       const Execution& execution = {});

/// One mesh of a generateTangents call for many meshes.
struct MeshJob {
    MeshView mesh = {};
    TangentOptions options = {};  ///< the convention must be set, as in a call for one mesh
    TangentOutput out = {};       ///< spans of the size that a call for this mesh alone needs
};

/// Tangents for many meshes in one call. It starts threads once, not once per mesh, and each thread reuses its scratch
/// memory. Use it for models with hundreds or thousands of small primitives.
///
/// jobs       any number of meshes, which may share inputs; outputs must not overlap inputs or each other, across all jobs
/// execution  each thread takes whole meshes, except that all threads together work on a mesh with more corners than a
///            thread's share of all corners
/// Returns one result per job, in the order of the jobs: the report or the error that generateTangents(mesh, options, out)
/// returns for this job alone. A job that fails does not affect the others. The outputs have the bits of single calls.
/// Errors of the call itself: outOfMemory (for the results and the scratch memory of the threads); the outputs of all jobs
/// hold anything then.
/// Linear in the number of all corners and jobs. Thread-safe. Same bits for any thread count and SIMD target.
///
/// Scratch memory: 128 KB per thread; where a job needs more, what a call for this mesh alone takes. An allocator of
/// `execution` is called from all threads, but never by two of them at the same time.
Result<std::vector<Result<TangentReport>>> generateTangents(std::span<const MeshJob> jobs,
                                                            const Execution& execution = {});

/// Makes the plan: welds equal vertices (position, normal and UV all equal), finds neighbours, groups and splits.
/// Inputs, errors and complexity as generateTangents. An allocator of `execution` must outlive the plan.
Result<TangentPlan> planTangents(const MeshView& mesh, const TangentOptions& options, const Execution& execution = {});

/// Computes frames for a pose with the plan's groups and splits. Each corner has the pose's position and normal of its
/// own vertex, also where vertices that were equal on the mesh come apart. On the pose the plan was made from the
/// result is bit for bit that of generateTangents. `execution` replaces the plan's. Scratch memory of the grouping
/// methods: 12 bytes per group when only tangents are asked for, else 44; with several threads also up to 12 bytes per
/// triangle where triangles are in no order, and next to nothing where they are. Errors: planMismatch when counts differ
/// from the plan's, and those of span checks. O(corners).
Result<TangentReport> evaluateTangents(const TangentPlan& plan, const Pose& pose, const TangentOutput& out,
                                       const Execution& execution = {});

// Mends what is broken in tangents and leaves every other bit alone.

struct SanitizeOptions {
    /// Also make every sound tangent unit and orthogonal to N. Off by default: the result then no longer matches a
    /// bake made with the method's own tangents (quantised normals are not unit, so the reference's tangents can be
    /// off by up to a degree there).
    bool orthogonalize_all = false;
};

/// Corners mended, by cause (the first that applies, in this order) and by cure.
struct SanitizeReport {
    std::uint64_t not_finite_count = 0;      ///< NaN or infinity in the tangent
    std::uint64_t zero_count = 0;            ///< length 0 (or too small to be normalised)
    std::uint64_t not_unit_count = 0;        ///< length off by more than 5e-4 (the glTF validator's tolerance)
    std::uint64_t parallel_count = 0;        ///< within 1 degree of +N or -N: no frame can be built
    std::uint64_t placeholder_count = 0;     ///< exactly (1, 0, 0), and not in the plane across N
    std::uint64_t bad_sign_count = 0;        ///< sign not exactly +1 or -1
    std::uint64_t mixed_sign_count = 0;      ///< sign changed because the face's corners disagreed
    std::uint64_t orthogonalized_count = 0;  ///< sound ones changed by orthogonalize_all

    std::uint64_t normalized_count = 0;     ///< cure: own direction, made unit and orthogonal to N
    std::uint64_t from_neighbor_count = 0;  ///< cure: direction taken from a sound corner of the same face or position
    std::uint64_t from_basis_count = 0;     ///< cure: basis from N alone (Duff et al. 2017)

    std::uint64_t bad_normal_count = 0;  ///< corners whose N is zero or not finite: only a unit tangent is promised

    /// All corners that were written: the sum of the causes.
    [[nodiscard]] std::uint64_t mendedCount() const {
        return not_finite_count + zero_count + not_unit_count + parallel_count + placeholder_count + bad_sign_count +
               mixed_sign_count + orthogonalized_count;
    }
};

/// Mends tangents in place. A tangent is broken when it is not finite, zero, not unit (beyond 5e-4), within 1 degree
/// of +-N, a placeholder that leans out of the surface, when its sign is not +-1, or when the signs inside its face
/// differ. What is written is unit and orthogonal to the corner's N (normalised) within 1e-6, with sign +1 or -1. Sound
/// tangents keep every bit.
///
/// Placeholder: the reference gives exactly (1, 0, 0) to corners around which no triangle has UV area, wherever N
/// points. What UVs give has been projected along N, so that with these bits it lies in the plane.
///
/// Cures, in this order: the tangent's own direction, when it has one that is not parallel to N; the tangent of the
/// first sound corner of the same face; of the first sound corner at the same position (in corner order); a basis
/// from N. Signs inside a face: the majority of the sound corners decides, of those whose N has a direction where there are
/// any; on a tie, the first of them. Where N has none, corners at one position that get a tangent from elsewhere get that of
/// the first of them with their sign.
/// The result does not depend on how vertices are indexed, so mending a split mesh again changes nothing.
///
/// mesh       positions and normals; UVs are not looked at
/// tangents   one per corner, read and written; corners of faces with fewer than 3 corners are left alone
/// execution  threads and memory; changes no bit
/// Errors: those of validate(); missingAttribute (normals), countMismatch, nullData, outOfMemory.
/// O(corners). Thread-safe; same bits for any thread count.
Result<SanitizeReport> sanitizeTangents(const MeshView& mesh, const SanitizeOptions& options,
                                        StridedSpan<Vec4> tangents, const Execution& execution = {});

}  // namespace tspace
