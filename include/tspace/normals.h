// SPDX-License-Identifier: MIT
// Normals of faces, averaged at vertices: one result per corner, so that hard edges can be split afterwards.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tspace/convention.h"
#include "tspace/execution.h"
#include "tspace/mesh.h"
#include "tspace/result.h"

namespace tspace {

/// How much a face counts in the mean at one of its corners. e1, e2 are the edges at the corner, a the interior
/// angle between them (above 180 degrees where a polygon is reflex).
enum class NormalWeighting : std::uint32_t {
    flat = 0,       ///< no averaging: each corner gets its face's unit normal, as glTF asks where normals are missing
    uniform = 1,    ///< 1: mean of unit face normals (Gouraud 1971)
    area = 2,       ///< the face's area (|e1 x e2| / 2 for a triangle): large faces count more
    angle = 3,      ///< a: independent of tessellation (Thuermer & Wuethrich 1998)
    angleArea = 4,  ///< a * area
    max = 5,        ///< sin(a) / (|e1| |e2|): exact on a sphere (Max 1999)
    /// No mean: the normal of a quadratic surface through the edges at the point. Where these look like noise or a
    /// bevel it is the mean of `angleArea`, and in between a blend. The most accurate, and the slowest.
    best = 6,
};

/// How normals are computed. First what all weightings have, then what some do not look at.
struct NormalOptions {
    NormalWeighting weighting = NormalWeighting::angle;  ///< the default does not depend on how faces were cut
    /// Its handedness and winding say which side is out; the default is glTF's.
    Convention convention = {};

    // All but `flat`:

    static constexpr float crease_auto = -1.0f;   ///< for `crease_angle_deg`
    static constexpr float denoise_auto = -1.0f;  ///< for `denoise`
    static constexpr float weld_auto = -1.0f;     ///< for `weld_distance`

    /// Degrees, 0..180. Two faces that share an edge are smoothed over it only when their normals differ by no more
    /// than this (and 1e-6 rad for rounding). 180, the default, because no angle fits all models: never hard (except by
    /// smoothing groups); then all faces at a point are smoothed together, also those that share no edge.
    /// `crease_auto`: by the mesh. The angle is in the widest gap between those that most edges have and those that few
    /// have, and noise of positions is filtered out before. NormalReport says which it is.
    float crease_angle_deg = 180.0f;
    /// One number per face, or empty. Faces smooth together only when their numbers are equal and not 0 (OBJ `s`),
    /// or, with `smoothing_groups_are_masks`, when they have a bit in common (3ds Max). Connections pass on: where A is
    /// smooth with B and B with C around a point, all three share one normal.
    std::span<const std::uint32_t> smoothing_groups = {};
    bool smoothing_groups_are_masks = false;
    /// true: vertices at the same position are one point (so UV seams stay smooth); false: only equal indices are.
    bool weld_positions = true;
    /// With `weld_positions`: positions that differ by no more than this in each coordinate are one position, that of the
    /// lowest vertex among them, in the unit of positions. For meshes that close by computed coordinates, as a torus does
    /// whose last ring has sin(2 pi) = -2.4e-16 where the first has 0. 0, the default: only equal positions are. `weld_auto`:
    /// twice the spacing of floats at the largest coordinate, and only at positions with an edge of 32 times that.
    /// Vertices are taken in their order: each joins the lowest earlier one within the distance that has joined no other,
    /// so that positions in a row are not all one.
    float weld_distance = 0;

    // `best` alone:

    /// 0, 1 or 2 steps after the fit. A step moves each normal so that, interpolated along the edges around it, it is
    /// across them, as far as these agree. 1: a third less error at vertices and in what is shaded between them. 2:
    /// another quarter less. 0: the fit alone.
    std::uint32_t refine = 2;
    /// For meshes whose positions are noisy: scans, marching cubes of a noisy field. Vertices stay; at each the normals of
    /// quadratic surfaces through two and three rings around it are blended with that of `best`, by how far each is likely
    /// to err. 0, the default: off. `denoise_auto`: by the noise that is measured. Where there is none, or what there is
    /// looks like shape (CAD, bevels, decimated meshes), results have the bits of 0. Above 0, up to 4: so many times the
    /// noise that is measured, whatever it looks like. 3 is for noise that is smooth from vertex to vertex, which no
    /// measure tells from detail. Hard edges hold: no surface goes through points on both sides.
    float denoise = 0;
};

/// Counts of faces and defects of the input. Broken input never makes the call fail.
struct NormalReport {
    std::uint64_t face_count = 0;             ///< faces with at least 3 corners
    std::uint64_t degenerate_face_count = 0;  ///< faces without a normal (zero area or not finite)
    std::uint64_t fallback_corner_count = 0;  ///< corners whose mean vanished: they got a substitute, see below
    /// What `denoise` removed: the standard deviation of positions along the normal, in mean edge lengths. 0: it was not
    /// asked, or found no noise, and changed no bit.
    float noise = 0;
    /// The angle that edges were held against: as given, or as found by the mesh. That holds, where positions are noisy,
    /// for faces that were smoothed. `flat`: 0.
    float crease_angle_deg = 0;
};

/// Computes one unit normal per corner of the mesh.
///
/// Face normal: Newell's sum over the polygon (for a triangle: cross(P1-P0, P2-P0)), times normalFactor(convention).
/// Vertex normal: the weighted mean of the unit face normals of all faces that are connected to the corner's face
/// around the vertex over smooth edges; weights as in NormalWeighting, summed in double precision and in face order.
/// A corner whose mean vanishes (is below 1e-10 of the weights) takes its own face normal; if that is degenerate, the
/// mean of the other faces at the vertex; if there is none, (0, 0, 1). So every result is finite and unit.
/// Corners of faces with fewer than 3 corners get (0, 0, 0).
///
/// mesh       positions and indices; UVs and normals are not looked at
/// out        one per corner (count == mesh.cornerCount()); must not overlap the inputs
/// execution  threads and memory; changes no bit
/// Errors: those of validate(); countMismatch (out, smoothing_groups), invalidOption, outOfMemory.
/// Angles in triangles are good to 2e-7, those of polygons (face_sizes, or a face_size other than 3) are exact.
/// O(corners). Scratch memory: about 36 bytes per vertex; with hard edges or polygons less for large meshes, up to 40
/// bytes per triangle for small ones; `best` 28 bytes per corner more. Thread-safe; same bits for any thread count.
Result<NormalReport> generateNormals(const MeshView& mesh, const NormalOptions& options, StridedSpan<Vec3> out,
                                     const Execution& execution = {});

// How noisy the positions of a mesh are.

/// Lengths are parts of `mean_edge`.
struct PositionNoise {
    /// How far positions lie from a smooth surface through their neighbours: the standard deviation along the normal. Detail
    /// as small as a triangle is in it too. 0: less than 200 vertices have enough neighbours to tell.
    float sigma = 0;
    /// Of how normals differ along an edge, the part that no smooth surface has: the median, 0..1. Noise gives .3 to .8; CAD,
    /// bevels and what was decimated give less for their sigma.
    float kink_share = 0;
    /// What of `sigma` is noise: so much NormalOptions::denoise removes where it goes by the mesh. 0: positions are not
    /// noisy. That is so, too, where most edges are flatter than noise would leave them.
    float noise = 0;
    double mean_edge = 0;  ///< of a sample, in the unit of positions, less what noise of sigma adds to it
};

/// Measures the noise in the positions of a mesh, by samples: up to 4096 vertices and 16384 edges. sigma is within 15 % of
/// random noise from .03 to .3 on smooth shapes; noise that is smooth from vertex to vertex cannot be told from detail.
///
/// mesh       positions and indices; UVs and normals are not looked at. Vertices at one position are one
/// execution  threads and memory; changes no bit
/// Errors: those of validate(); outOfMemory.
/// O(corners): the time of NormalWeighting::best and half as much again. Scratch memory: that of `best`, then 28 bytes per
/// corner, 56 per vertex, and 4 per vertex and thread. Thread-safe; same bits for any thread count.
Result<PositionNoise> measurePositionNoise(const MeshView& mesh, const Execution& execution = {});

}  // namespace tspace
