// SPDX-License-Identifier: MIT
// Face normals averaged at vertices. Results are per corner, so that hard edges can be split afterwards.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tspace/convention.h"
#include "tspace/execution.h"
#include "tspace/mesh.h"
#include "tspace/result.h"

namespace tspace {

/// Weight of a face in the mean at one of its corners. e1 and e2 are the edges at the corner, a is the interior angle
/// between them (above 180 degrees at reflex corners of a polygon).
enum class NormalWeighting : std::uint32_t {
    flat = 0,       ///< no averaging: each corner gets its face's unit normal, as glTF requires for missing normals
    uniform = 1,    ///< 1: mean of unit face normals (Gouraud 1971)
    area = 2,       ///< area of the face (|e1 x e2| / 2 for a triangle)
    angle = 3,      ///< a: independent of the tessellation (Thuermer & Wuethrich 1998)
    angleArea = 4,  ///< a * area
    max = 5,        ///< sin(a) / (|e1| |e2|): exact on a sphere (Max 1999)
    /// Normal of a quadratic surface fitted to the edges at the point. If the edges look like noise or a bevel, the
    /// mean of `angleArea`; in between, a blend of both. The most accurate and the slowest.
    best = 6,
};

/// Options of generateNormals: first those that apply to all weightings, then those that apply to some.
struct NormalOptions {
    NormalWeighting weighting = NormalWeighting::angle;  ///< the default does not depend on how faces were triangulated
    /// Handedness and winding define the outside of faces. Default: glTF.
    Convention convention = {};

    // For all weightings except `flat`:

    static constexpr float crease_auto = -1.0f;   ///< value of `crease_angle_deg`
    static constexpr float denoise_auto = -1.0f;  ///< value of `denoise`
    static constexpr float weld_auto = -1.0f;     ///< value of `weld_distance`

    /// Maximum angle between the normals of two faces whose shared edge is smooth, in degrees, 0..180 (plus 1e-6 rad
    /// for rounding). Default: 180, because no angle suits all models: no hard edges (except from smoothing groups),
    /// and all faces at a point are smoothed together, including faces that share only this point. `crease_auto`:
    /// chosen for each mesh, as the middle of the widest gap in the histogram of edge angles, after noise of positions
    /// is filtered out. NormalReport contains the angle that was used.
    float crease_angle_deg = 180.0f;
    /// One number per face, or empty. Faces are smoothed together only if their numbers are equal and not 0 (OBJ `s`),
    /// or, with `smoothing_groups_are_masks`, if they have a bit in common (3ds Max). Smoothing is transitive: if A is
    /// smooth with B and B with C around a point, all three share one normal.
    std::span<const std::uint32_t> smoothing_groups = {};
    bool smoothing_groups_are_masks = false;
    /// true: weld vertices with equal positions (so UV seams stay smooth); false: weld by index only.
    bool weld_positions = true;
    /// With `weld_positions`: weld distance, in mesh units. Vertices whose positions differ by at most this in each
    /// coordinate are welded to the one with the lowest index. Useful for meshes that are closed only up to rounding,
    /// such as a torus whose last ring has sin(2 pi) = -2.4e-16 instead of 0. 0, the default: only equal positions.
    /// `weld_auto`: twice the spacing of floats at the largest coordinate, and only at positions with an edge of at
    /// least 32 times that length. Vertices are processed in order: each is welded to the first earlier vertex within
    /// the distance that was not welded itself, so chains of close positions are not all welded together.
    float weld_distance = 0;

    // For `best` only:

    /// Number of refinement steps after the fit: 0, 1 or 2. A step moves each normal so that, interpolated along the
    /// edges around it, it is perpendicular to these edges, as far as they agree. 1: a third less error at vertices and
    /// in the shading between them. 2: another quarter less.
    std::uint32_t refine = 2;
    /// Denoising for meshes with noisy positions: scans, marching cubes of a noisy field. Vertices are not moved; at
    /// each vertex the normals of quadratic surfaces through two and three rings are blended with the normal of `best`,
    /// weighted by their expected errors. 0, the default: off. `denoise_auto`: by the measured noise; if there is none,
    /// or it looks like shape (CAD, bevels, decimated meshes), results are bit-identical to those with 0. Above 0, up
    /// to 4: factor of the measured noise, without that check; 3 suits noise that is smooth from vertex to vertex,
    /// which cannot be distinguished from detail. Hard edges are preserved: no surface is fitted across them.
    float denoise = 0;
};

/// Counts of faces and defects of the input. Invalid geometry never makes the call fail.
struct NormalReport {
    std::uint64_t face_count = 0;             ///< faces with at least 3 corners
    std::uint64_t degenerate_face_count = 0;  ///< faces without a normal (zero area or not finite)
    std::uint64_t fallback_corner_count = 0;  ///< corners whose mean vanished and was replaced (see generateNormals)
    /// Noise that `denoise` removed: standard deviation of positions along the normal, in mean edge lengths. 0:
    /// denoising was off or found no noise, and changed no bit.
    float noise = 0;
    /// Crease angle that was used: as given, or as derived from the mesh (for noisy positions, an angle between
    /// smoothed faces). `flat`: 0.
    float crease_angle_deg = 0;
};

/// Computes one unit normal per corner of the mesh.
///
/// Face normal: Newell's sum over the polygon (for a triangle: cross(P1-P0, P2-P0)), times normalFactor(convention).
/// Vertex normal: the weighted mean of the unit face normals of all faces that are connected to the corner's face
/// around the vertex over smooth edges; weights as in NormalWeighting, summed in double precision and in face order.
/// A corner whose mean vanishes (is below 1e-10 of the weights) gets its own face normal; if that is degenerate, the
/// mean of the other faces at the vertex; if there is none, (0, 0, 1). Every result is therefore finite and unit.
/// Corners of faces with fewer than 3 corners get (0, 0, 0).
///
/// mesh       positions and indices; UVs and normals are ignored
/// out        one per corner (count == mesh.cornerCount()); must not overlap the inputs
/// execution  threads and memory; does not affect the result
/// Errors: those of validate(); countMismatch (out, smoothing_groups), invalidOption, outOfMemory.
/// Angles in triangles are accurate to 2e-7; angles in polygons (face_sizes, or a face_size other than 3) are exact.
/// O(corners). Scratch memory: about 36 bytes per vertex; with hard edges or polygons less for large meshes, up to 40
/// bytes per triangle for small ones; 28 bytes more per corner for `best`. Thread-safe; same bits for any thread count.
Result<NormalReport> generateNormals(const MeshView& mesh, const NormalOptions& options, StridedSpan<Vec3> out,
                                     const Execution& execution = {});

// Measurement of position noise.

/// Result of measurePositionNoise. Lengths are relative to `mean_edge`.
struct PositionNoise {
    /// Standard deviation of positions from a smooth surface through their neighbors, along the normal. Includes detail
    /// of the size of a triangle. 0: fewer than 200 vertices have enough neighbors for a measurement.
    float sigma = 0;
    /// How abruptly normals change along edges, from 0 to 1: the median over the sampled edges of x^2 / (x^2 + y^2),
    /// where x is the part of the change that uniform bending cannot explain (0 on a circle), and y the part that it
    /// explains. Noise: 0.3 to 0.8. CAD models, bevels and decimated meshes: less, for the same sigma.
    float kink_share = 0;
    /// Part of `sigma` that is noise, which NormalOptions::denoise removes automatically. 0: positions are not noisy,
    /// or most edges are flatter than noise would leave them.
    float noise = 0;
    /// Mean length of the sampled edges, in mesh units, without the length that noise of `sigma` adds to them.
    double mean_edge = 0;
};

/// Measures the noise in the positions of a mesh from samples: up to 4096 vertices and 16384 edges. sigma is within 15
/// % of random noise from 0.03 to 0.3 on smooth shapes; noise that is smooth from vertex to vertex cannot be
/// distinguished from detail.
///
/// mesh       positions and indices; UVs and normals are ignored. Vertices with equal positions are welded
/// execution  threads and memory; does not affect the result
/// Errors: those of validate(); outOfMemory.
/// O(corners): 1.5 times the time of NormalWeighting::best. Scratch memory: that of `best`, then 28 bytes per corner,
/// 56 per vertex, and 4 per vertex and thread. Thread-safe; same bits for any thread count.
Result<PositionNoise> measurePositionNoise(const MeshView& mesh, const Execution& execution = {});

}  // namespace tspace
