// SPDX-License-Identifier: MIT
// Normal maps as arrays: conversion, heights, errors, baking. CMake target tspace::maps.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "tspace/callbacks.h"
#include "tspace/convention.h"
#include "tspace/execution.h"
#include "tspace/normals.h"
#include "tspace/result.h"
#include "tspace/span.h"

namespace tspace {

/// Axes of an object-space map: directions of its x, y and z in mesh coordinates. Default: the mesh axes.
struct MapAxes {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

    friend bool operator==(const MapAxes&, const MapAxes&) = default;
};

/// Axes of maps from programs in which z points up (Blender, 3ds Max), for meshes in which y points up: x, -z, y.
inline constexpr MapAxes kMapAxesZUp{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};

/// Behavior of a texture outside the 0-1 UV range.
enum class TextureWrap : std::uint32_t { repeat = 0, mirror = 1, clamp = 2 };

/// Space of the vectors of a map.
enum class MapSpace : std::uint32_t {
    tangent = 0,
    object = 1  ///< mesh coordinates
};

/// Image of a normal map.
struct MapImage {
    std::uint32_t width = 0, height = 0;
    std::span<const Vec3> texels = {};  ///< width * height, channels from 0 to 1, row 0 is v = 0
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
};

// Interpretation of a texel of a normal map and the frames of a mesh as the shaded normal, by a renderer. A map is
// correct only for the interpretation that it was made for.

/// Stage at which B = w * cross(N, T) is computed.
enum class BitangentPlace : std::uint32_t {
    perPixel = 0,  ///< from the interpolated N and T
    perVertex = 1  ///< at the vertices; B is interpolated
};

/// Interpretation of a map. The default is green up as in glTF, and MikkTSpace's rule, since glTF specifies none:
/// unit(x T + y B + z N), (x, y, z) = 2c - 1, with T and N as interpolated.
struct MapReading {
    Green green = Green::up;
    BitangentPlace bitangent = BitangentPlace::perPixel;
    bool unit_vectors = false;  ///< N, T and B are each normalized before the texel is applied
    bool two_channels = false;  ///< z is sqrt(1 - x^2 - y^2), and blue is ignored
    float scale = 1.0f;         ///< factor of x and y (glTF's normalTexture.scale); not 0

    friend bool operator==(const MapReading&, const MapReading&) = default;
};

/// Returns the reading of a program by its name in lower case: the names of findConvention, and "three". These values
/// come from the shader sources of these programs as of 2026 (docs/reference/shaders.md). Returns null for any other
/// name. Thread-safe.
///
/// gltf, blender, opengl  the default
/// directx                green down
/// unreal                 green down, two channels
/// unity (URP and HDRP)   two channels
/// godot                  bitangent per vertex, unit vectors, two channels
/// three                  bitangent per vertex, unit vectors
const MapReading* findMapReading(const char* name);

/// Rule that selects the baked face among the front faces of the high poly that a ray hits.
enum class RayTarget : std::uint32_t {
    /// The first face from the cage inwards, which is visible from outside: bolts on a plate, not the plate below. If
    /// there is none, the nearest face beyond the cage.
    outermost = 0,
    /// The face closest to the low poly, on either side: for fingers, and parts thinner than the cage distance.
    nearest = 1,
};

/// Directions of the rays.
enum class RayDirections : std::uint32_t {
    /// Perpendicular to flat faces, averaged near edges where faces meet at over 30 degrees: nothing is slanted in the
    /// middle of a face, and nothing is cut off at its edges. Averaged if there are no such edges. Known as skew
    /// correction.
    automatic = 0,
    /// Angle-weighted mean of the triangle normals at each position: no gaps at split normals, but details on flat
    /// faces between averaged normals are slanted.
    averaged = 1,
    normals = 2,  ///< stored normals of the low poly: gaps and overlaps at hard edges
};

/// Ray options. Ignored for a low poly with a cage mesh, whose rays go from the cage through the low poly
/// (LowPoly::cage).
struct RayOptions {
    RayTarget target = RayTarget::outermost;
    RayDirections directions = RayDirections::automatic;
    /// Cage distance: distance from the low poly's faces to the start of the rays; `nearest` uses it only to choose a
    /// face. 0: the reach.
    double cage_offset = 0;
    /// Overrides `directions`: the first channel, sampled by the low poly's UVs, is 0 for averaged rays and 1 for rays
    /// perpendicular to the triangle. Without texels: unused.
    MapImage skew = {};
    /// Weld distance for ray directions and curvature. Same meaning as NormalOptions::weld_distance.
    float weld_distance = NormalOptions::weld_auto;
};

// Error of a normal map against the surface that it represents, in degrees, as a renderer shades it.
//
// The truth at a point of the low poly is the normal of the high poly where the point's ray hits it. Rays are traced by
// Embree: without it (at build or run time) these calls fail with unsupportedFile. Embree uses only the threads of the
// call, if the process has no other Embree devices. Limits that a host sets for TBB, which Embree uses, remain in
// effect, except for the microseconds in which devices are created.

/// Group number that matches every group.
inline constexpr std::uint32_t kEveryGroup = 0xffffffff;

/// Mesh that a map is drawn on. Every span has three entries per triangle, one for each corner, or is empty if its
/// comment allows it. Triangles that are not finite are ignored.
struct LowPoly {
    StridedSpan<const Vec3> positions = {};
    StridedSpan<const Vec3> normals = {};   ///< stored normals: used for rays and for shading
    StridedSpan<const Vec4> tangents = {};  ///< empty with MapSpace::object
    StridedSpan<const Vec2> uvs = {};       ///< v increases downwards
    StridedSpan<const Vec3> cage = {};      ///< start of the rays; empty: determined by RayOptions
    /// One per triangle: its rays hit only triangles of the high poly with the same number, or any if either number is
    /// kEveryGroup. Empty, in either mesh: no restriction.
    std::span<const std::uint32_t> groups = {};
    /// Part of the mesh that the map does not cover: other materials, other tiles. Three entries per triangle, in both
    /// spans or none. Ray directions near an edge depend on the triangles on both sides of it.
    StridedSpan<const Vec3> rest_positions = {}, rest_normals = {};
};

/// Normal map of a high poly, and its interpretation.
struct HighMap {
    MapImage image = {};  ///< map in tangent space
    MapReading reading = {};
};

/// Value in HighPoly::map_of for a triangle without a map.
inline constexpr std::uint32_t kNoHighMap = 0xffffffff;

/// Detailed mesh, in the coordinates of the low poly.
struct HighPoly {
    StridedSpan<const Vec3> positions = {};       ///< one per vertex
    StridedSpan<const Vec3> normals = {};         ///< one per vertex; empty: flat triangles
    std::span<const std::uint32_t> corners = {};  ///< three per triangle; counter-clockwise seen from outside
    std::span<const std::uint32_t> groups = {};   ///< one per triangle, or empty
    /// Normal maps of the high poly, or empty. For a triangle with a map, the truth is the normal from the map.
    std::span<const HighMap> maps = {};
    std::span<const std::uint32_t> map_of = {};  ///< with `maps`, one per triangle: an index into them, or kNoHighMap
    /// With `maps`, one per vertex; used only for triangles with a map, which also require `normals`.
    StridedSpan<const Vec4> tangents = {};
    StridedSpan<const Vec2> uvs = {};
};

struct MapErrorOptions {
    MapSpace space = MapSpace::tangent;  ///< space of the map; the default is that of glTF
    MapReading reading = {};             ///< interpretation of the map; the default is that of glTF
    MapAxes axes = {};                   ///< axes of the map, with MapSpace::object
    /// Maximum ray distance from the surface, inwards and outwards; with a cage mesh, the distance beyond the surface.
    /// 0: derived from the sizes of both meshes (chosenReach).
    double reach = 0;
    RayOptions rays = {};
    std::uint32_t point_count = 100000;  ///< samples, distributed evenly over the area of the low poly; 1 to 10,000,000
    bool heat = false;                   ///< also compute MapError::heat
};

/// Error of a sample whose ray hits no high poly.
inline constexpr double kMissedDeg = 90;

/// Angles between the shaded normal and the truth, in degrees.
struct MapError {
    std::uint64_t point_count = 0;   ///< samples whose rays hit the high poly
    std::uint64_t missed_count = 0;  ///< samples whose rays hit no front face of the high poly
    /// Samples whose rays hit another front face of the high poly farther out than the one that is used, within the
    /// reach.
    std::uint64_t hidden_count = 0;
    /// Samples whose rays hit a back face of the high poly before the front face that is used, or only back faces.
    std::uint64_t back_count = 0;
    std::uint64_t inward_count = 0;  ///< samples that hit a front face whose shading normal points inwards
    /// Error of all samples; a sample without a hit counts as kMissedDeg.
    double mean_deg = 0, p99_deg = 0, max_deg = 0;
    double met_mean_deg = 0;             ///< mean error of the samples that hit the high poly
    std::uint64_t seam_point_count = 0;  ///< samples within one texel of a UV border
    double seam_mean_deg = 0;            ///< mean error of the samples near UV seams
    double inside_mean_deg = 0;          ///< mean error of all other samples
    double reach = 0, cage_offset = 0;   ///< values that were used; with a cage mesh, cage_offset is 0
    /// Mean error per texel in degrees, over four points; -1 if no triangle covers one of them. Empty unless requested.
    std::vector<float> heat = {};
};

/// Returns the default reach: a twentieth of the diagonal of the larger bounding box, or 1.5 times the largest distance
/// between corresponding sides of the two boxes if that is larger, but at most a quarter of the diagonal. 0 if the
/// boxes do not intersect. Linear; thread-safe.
double chosenReach(const LowPoly& low, const HighPoly& high);

/// Compares a map with the surface. The same result for any thread count. Memory: about 100 bytes per point, 200 per
/// triangle of the high poly, 16 per texel with `heat`. Errors: nullData, countMismatch, strideTooSmall, misaligned,
/// indexOutOfRange, invalidOption, missingAttribute (no UVs, normals or tangents; meshes that are far apart),
/// unsupportedFile (no Embree), cancelled, outOfMemory. Thread-safe.
Result<MapError> measureMap(const MapImage& map, const LowPoly& low, const HighPoly& high,
                            const MapErrorOptions& options = {}, const Execution& execution = {},
                            const Progress& progress = {});

/// An interpretation of a map, and rays to compare it with.
struct MapCandidate {
    MapSpace space = MapSpace::tangent;
    MapReading reading = {};
    StridedSpan<const Vec4> tangents = {};  ///< three per triangle; empty: tangents of the low poly
    /// Rays that define the truth; null: rays of the options. Must stay valid.
    const RayOptions* rays = nullptr;
    double reach = 0;   ///< maximum ray distance, with `rays`; 0: reach of the options
    MapAxes axes = {};  ///< axes of the map, with MapSpace::object
};

/// Computes measureMap for each of several interpretations, at the same points, without `heat`. Errors: those of
/// measureMap.
Result<std::vector<MapError>> measureReadings(const MapImage& map, const LowPoly& low, const HighPoly& high,
                                              std::span<const MapCandidate> candidates,
                                              const MapErrorOptions& options = {}, const Execution& execution = {},
                                              const Progress& progress = {});

/// Allowed vector lengths in 8-bit maps. There are so few 8-bit vectors that a longer or shorter one often has a better
/// direction.
enum class TexelLengths : std::uint32_t {
    even = 0,  ///< 0.9 to 1: means of several texels, as in smaller mip levels, are nearly as accurate as with 16 bits
    /// 0.7 to 1.1: up to a third less error at the first level, but smaller levels are biased towards longer texels
    free = 1,
};

// Conversion of a normal map so that one set of frames shows what it showed on another.
//
// The surface and its UVs are the same on both sides; tangents, normals, splits, quad triangulation, the convention,
// and the space may differ. Each texel is decoded with the frames at its location on one side, and encoded with those
// of the other. Frames vary smoothly between texels, so texels can be converted independently: the result is as exact
// as its number format.

/// One side of a conversion: the data that interpret a map. Spans have three entries per triangle, one for each corner.
struct MapSide {
    MapSpace space = MapSpace::tangent;
    /// In object space only `green` is used.
    MapReading reading = {};
    StridedSpan<const Vec2> uvs = {};  ///< v increases downwards; empty: this side has no mesh
    /// Frames as stored in the mesh, required for MapSpace::tangent. They need not have unit length or be orthogonal.
    StridedSpan<const Vec3> normals = {};
    StridedSpan<const Vec4> tangents = {};
    /// Positions, which distinguish triangles with equal UVs, such as mirrored halves; may be empty.
    StridedSpan<const Vec3> positions = {};
    /// With MapSpace::object, one per triangle: the map's axes in the coordinates of the other side's frames. Need not
    /// be unit or orthogonal. Empty: the same coordinates.
    std::span<const MapAxes> axes = {};
};

struct ConvertMapOptions {
    /// 8 or 16: texels that change are rounded to n / (2^bits - 1), n an integer. 32: not rounded.
    unsigned bits = 16;
    /// With 8 bits and three channels: allowed lengths of converted vectors. Applies to vectors whose length in the
    /// input is in this range. All others, and vectors that differ from an adjacent one by over 9 degrees, keep their
    /// length to within 5 %.
    TexelLengths lengths = TexelLengths::even;
    /// Width of the padding around triangles, in texels, that is converted with the nearest triangle. 0: only texels
    /// that bilinear filtering reads.
    std::uint32_t padding = 0;
};

struct ConvertMapReport {
    std::uint64_t converted = 0;   ///< texels covered by triangles or their padding, and converted
    std::uint64_t changed = 0;     ///< converted texels whose value changed
    std::uint64_t background = 0;  ///< texels that no triangle covers: unchanged
    /// Unchanged texels without a solution: frames that are singular or not finite, texels without a direction.
    std::uint64_t without_frame = 0;
    /// Texels that would need z < 0, which two channels cannot represent; they get z = 0.
    std::uint64_t below_horizon = 0;
    std::uint64_t overlapping = 0;  ///< texels that several triangles cover; the first triangle is used
    /// From tangent to object space: overlapping texels whose triangles require directions over 2 degrees apart, as in
    /// mirrored halves. Only one direction can be stored.
    std::uint64_t conflicting = 0;
    // Numbers of ignored triangles:
    std::uint64_t degenerate_uv_count = 0;  ///< triangles without UV area
    std::uint64_t bad_uv_count = 0;         ///< triangles whose UVs are not finite, or span over 64 texture repeats
    std::uint64_t unmatched = 0;  ///< texels of the source's triangles that the other side does not cover: unchanged
    /// Texels whose triangles on the two sides do not have equal corners and are over a fiftieth of the mesh's size
    /// apart in space, if both have positions: the sides are not the same surface with the same UV map.
    std::uint64_t apart = 0;
    /// Angles between the shading after conversion and the shading of the unconverted map on the new side, over the
    /// converted texels.
    double mean_change_deg = 0, max_change_deg = 0;
    double half_step_deg = 0;  ///< half a quantization step of the output as an angle; 0 with 32 bits
    /// There are changes, but their mean is less than half a step: rounding will undo them.
    bool is_below_half_step = false;
};

/// Converts `map` from one side to the other into `out` (width * height; may be map.texels).
///
/// - Texels keep their lengths, except for those that would not fit, and with 8 bits.
/// - With 16 bits between tangent and object space, lengths change by up to 0.005 for better directions, and
///   neighboring texels compensate for rounding errors under filtering. The same holds for 8 bits and three channels,
///   with the lengths of `lengths`. Otherwise channels are rounded to the nearest integer.
/// - Sides that interpret a texel equally leave it unchanged, bit for bit; if only green differs it becomes exactly 1 -
///   G.
/// - Without a mesh on both sides, only interpretations are converted, for all texels; green, scale and channels may
///   differ.
/// - With a mesh on one side only, the other side is in object space, or has the same frames.
/// - Triangles of both sides are matched by UVs and positions, in any order; if none has equal corners, by location.
/// - No texel becomes NaN. Two-channel readings get unit vectors, and the third channel as other readers expect it.
///
/// Errors: nullData, countMismatch, strideTooSmall, misaligned, invalidOption (bits; a scale that is 0 or not finite),
/// missingAttribute (a required mesh, normals or tangents), tooLarge (more than 2^32 texels, or UVs that cover the
/// image too many times), outOfMemory, cancelled. Time: linear. Memory: about 30 bytes per texel, 55 with 16 bits
/// between tangent and object space, 45 and 20,000 per column with 8 bits. The same bits for any number of threads.
/// Thread-safe.
Result<ConvertMapReport> convertMap(const MapImage& map, const MapSide& from, const MapSide& to,
                                    const ConvertMapOptions& options, std::span<Vec3> out,
                                    const Execution& execution = {}, const Progress& progress = {});

// Conversion of heights (a bump map) to a normal map.

struct HeightMap {
    std::uint32_t width = 0, height = 0;
    std::span<const float> heights = {};  ///< width * height, row 0 is v = 0; 0 is black, 1 is white
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;  ///< wrap modes
};

struct HeightToNormalOptions {
    /// Height of white above black: in mesh units with a mesh, otherwise in texels. Negative: white is lower.
    double strength = 1;
    Green green = Green::up;  ///< direction of green in the normal map
    /// Channels are rounded to n / (2^bits - 1), n an integer. 32: not rounded.
    unsigned bits = 16;
};

struct HeightToNormalReport {
    std::uint64_t on_mesh = 0;  ///< texels whose size was derived from the triangle that covers them
    /// Mean texel width over the mesh, in the units of `strength`; used for texels that no triangle covers.
    double texel_size = 1;
    double mean_lean_deg = 0, max_lean_deg = 0;  ///< angles between the normals and the surface normals
};

/// Converts heights to a normal map in `out` (width * height).
///
/// With h from 0 to 1 (other ranges are allowed) and S the strength, in texels: n = unit(-S dh/dx, S dh/drow, 1), y up.
/// Derivatives are differences of the texels on both sides, over three rows (columns) weighted 3 : 10 : 3 (Scharr):
/// exact for planes and parabolas. At borders with TextureWrap::clamp they are one-sided: (-3 h0 + 4 h1 - h2) / 2, or
/// h1 - h0 for two texels, and 0 for one. With a mesh, n = N - S grad h, grad h = (h_u (P_v x N) + h_v (N x P_u)) / (N
/// . (P_u x P_v)) (Blinn 1978), where P_u and P_v are the edges of the texel on its triangle, and n is expressed in the
/// mesh's frames (MapSide). The strength therefore does not depend on the size of the image or the UVs. Texels that no
/// triangle covers are squares of the mean size.
///
/// `mesh`    in tangent space; empty: none
///
/// Errors: nullData, countMismatch, strideTooSmall, misaligned, invalidOption (bits; a strength that is not finite),
/// missingAttribute (positions, normals or tangents of the mesh), tooLarge, outOfMemory. Time: linear. The same bits
/// for any number of threads. Thread-safe.
Result<HeightToNormalReport> heightToNormal(const HeightMap& map, const MapSide& mesh,
                                            const HeightToNormalOptions& options, std::span<Vec3> out,
                                            const Execution& execution = {});

// Baking of a normal map that makes a low poly look like a high poly.
//
// Rays start at a cage around the low poly and go inwards. The map is correct for the frames of the low poly,
// interpreted as in the options; its error is measured as by measureMap.

/// Computation of texels.
enum class MapFit : std::uint32_t {
    /// All texels are computed jointly, so that the bilinearly filtered map is also correct between texels: least
    /// squares, measured perpendicular to the target direction; also chooses the rounding to integers. Rays are traced
    /// at each texel's center, and at 2 x 2 or 3 x 3 points per texel where values between centers cannot be
    /// interpolated.
    solve = 0,
    texel = 1,  ///< each texel is computed independently: exact at its center
};

/// Normals to use if triangles share texels but require different normals, as mirrored halves of an asymmetric surface
/// do. UV pieces are sets of triangles connected in UVs and in space, with equal UV orientation.
enum class MapOverlap : std::uint32_t {
    mean = 0,    ///< mean of all required normals: equally wrong on each surface
    first = 1,   ///< normal of the UV piece whose triangles come first in the mesh
    larger = 2,  ///< normal of the UV piece with the larger surface
};

struct BakeOptions {
    std::uint32_t width = 1024, height = 1024;  ///< 1 to 16384
    unsigned bits = 16;                         ///< bits per channel: 8 or 16
    MapSpace space = MapSpace::tangent;         ///< space of its vectors; the default is that of glTF
    MapAxes axes = {};                          ///< axes of the map, with MapSpace::object: unit and orthogonal
    MapReading reading = {};  ///< renderer that the map is made for; with two channels all texels have unit length
    /// Wrap modes of the texture. Triangles beyond the edge of a clamped texture are ignored there.
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
    MapFit fit = MapFit::solve;
    MapOverlap overlap = MapOverlap::mean;
    TexelLengths lengths = TexelLengths::even;  ///< range of vector lengths, with 8 bits and three channels
    std::uint32_t padding = 16;                 ///< padding around the triangles, in texels; 0 to 256
    double reach = 0;  ///< search distance that was used (MapErrorOptions::reach, or its default)
    RayOptions rays = {};
    bool heat = false;  ///< also compute MapError::heat
    /// Memory limit of the call: compared with bakeBytes before any work (tooLarge). 0: no limit.
    std::uint64_t memory_limit_bytes = 0;
};

/// Origin of a texel of a baked map.
enum class TexelOrigin : std::uint8_t {
    background = 0,  ///< no triangle is near the texel: flat
    padding = 1,     ///< the texel continues the nearest triangle
    hit = 2,         ///< the center of the texel is in a triangle, and its ray hit the high poly
    /// the center of the texel is in a triangle, and its ray hit nothing: filled from neighboring texels
    missed = 3,
};

struct BakedMap {
    std::uint32_t width = 0, height = 0;
    unsigned bits = 16;
    std::vector<Vec3> texels = {};          ///< channels n / (2^bits - 1), n an integer; row 0 is v = 0
    std::vector<TexelOrigin> origins = {};  ///< one per texel
    std::vector<bool> overlaps = {};        ///< one flag per texel: its center is inside several triangles
    std::uint64_t hit_count = 0, missed_count = 0, padding_count = 0;  ///< numbers of texels
    std::uint64_t overlap_count = 0;  ///< texels whose center is inside several triangles
    /// Overlapping texels whose triangles require normals over 2 degrees apart; MapOverlap selects the result.
    /// `conflict_mean_deg` and `conflict_max_deg`: with MapOverlap::mean, the angle between the normals of two
    /// triangles at a texel; otherwise the angle between the normal of the selected UV piece and the mean of the
    /// others.
    std::uint64_t conflict_count = 0;
    double conflict_mean_deg = 0, conflict_max_deg = 0;
    std::uint64_t degenerate_uv_count = 0;  ///< triangles that have no UV area or UVs that are not finite: not drawn
    /// Error against the outermost front face of the high poly, as shaded, whatever the ray target of the map: the
    /// visible error.
    MapError error = {};
    /// With RayTarget::nearest: error against the hits of the rays of the bake itself. Otherwise without samples.
    MapError own_error = {};
};

/// Estimates the peak memory of a bake, in bytes. With `solve`, assumes that all texels need rays between their
/// centers.
std::uint64_t bakeBytes(std::uint64_t low_triangles, std::uint64_t high_triangles, const BakeOptions& options);

/// Bakes one image. The same texels for any thread count. Time: about 1 microsecond per ray, with 1 ray per texel or,
/// with `solve`, 1 to 10, and with `solve` 1 to 3 microseconds more per texel. Errors: those of measureMap; tooLarge;
/// missingAttribute also if no ray hits the high poly, or the UVs cover no texel. Thread-safe.
Result<BakedMap> bakeMap(const LowPoly& low, const HighPoly& high, const BakeOptions& options = {},
                         const Execution& execution = {}, const Progress& progress = {});

// Further layers of a bake, from the same rays: ambient occlusion, bent normals, curvature, heights, positions,
// thickness, IDs, and the materials of the high poly.
//
// A texel of a layer shows the point of the high poly that the ray of its center hits. This is also the point whose
// normal the normal map shows there; colors are means over the rays of a texel. If several triangles of the low poly
// share a texel, colors are the mean over all of them, and other layers use the first.

enum class MapLayer : std::uint32_t {
    ao = 0,    ///< visible part of the sky above the point, cosine-weighted: 1 is all of it
    bent = 1,  ///< mean of the unoccluded directions, unit, encoded like normals in BakeOptions
    /// Mean curvature of the high poly, in 1 / length (1 / r for a sphere of radius r); positive where it is convex.
    curvature = 2,
    height = 3,    ///< distance from the low poly to the high poly along the ray, positive outwards
    position = 4,  ///< position on the high poly
    /// Mean depth at which rays into the solid leave it, cosine-weighted: for a slab its height, for a ball its radius.
    /// Rays that leave nothing (an open sheet) count as the depth of white.
    thickness = 5,
    id = 6,       ///< a color for each number of LayerOptions::ids (idColor)
    color = 7,    ///< ShownMaterial::color: linear light
    orm = 8,      ///< occlusion (`ao`, if baked; otherwise 1), roughness, metalness
    emission = 9  ///< ShownMaterial::emission: linear light
};
inline constexpr std::uint32_t kMapLayerCount = 10;
inline constexpr std::uint32_t kMostLayerRays = 4096;

/// Values of a material at a point.
struct ShownMaterial {
    Vec3 color{1, 1, 1};  ///< base color, linear
    float roughness = 1, metalness = 0;
    Vec3 emission{0, 0, 0};  ///< emitted color, linear
};

/// Returns the material at a point of a high-poly triangle, given as barycentric weights. Called by several threads at
/// once.
using MaterialAt = std::function<ShownMaterial(std::uint32_t triangle, const std::array<double, 3>& weights)>;

struct LayerOptions {
    std::vector<MapLayer> layers = {};  ///< each at most once; may be empty
    bool has_normal = true;             ///< also bake the normal map itself
    /// Rays per point for `ao`, `bent` and `thickness`, shared by all three: 1 to kMostLayerRays.
    std::uint32_t ray_count = 64;
    double sky_distance = 0;  ///< maximum occlusion distance; 0: unlimited
    /// Value of white, as a length (`curvature`: 1 / length); black is its negative for `height` and `curvature`. 0:
    /// the maximum that occurs; for `curvature` the 99th percentile.
    double height_range = 0, curvature_range = 0, thickness_range = 0;
    /// Box of `position`, from black to white. If `least` is not below `most`: the bounding box of the high poly.
    std::array<double, 3> position_least = {}, position_most = {};
    std::span<const std::uint32_t> ids = {};  ///< one per triangle of the high poly, for `id`
    MaterialAt material = {};                 ///< for `color`, `orm` and `emission`
};

/// A baked layer.
struct BakedLayer {
    MapLayer layer = MapLayer::ao;
    std::uint32_t channel_count = 1;  ///< 1 or 3
    std::vector<float> values = {};   ///< from 0 to 1, channel_count per texel; row 0 is v = 0
    /// Quantities that the stored values 0 and 1 represent, per channel, in mesh units.
    std::array<double, 3> least = {0, 0, 0}, most = {1, 1, 1};
};

struct BakedMaps {
    /// The normal map. Without texels and errors if no normal map was requested.
    BakedMap normal = {};
    std::vector<BakedLayer> layers = {};  ///< baked layers, in the order of LayerOptions::layers
};

/// Returns the name of a layer: "ao", "bent" and so on; empty for other values.
const char* layerName(MapLayer layer);

/// Returns a color of three channels from 0 to 1, exact in 8 bits, and never black. Any two IDs below 2^24 - 1 differ;
/// the first 8 IDs differ by at least a half in some channel, the first 64 by a quarter.
Vec3 idColor(std::uint32_t id);

/// Estimates the additional peak memory of the layers (see bakeBytes), in bytes.
std::uint64_t layerBytes(std::uint64_t high_triangles, const BakeOptions& options, const LayerOptions& layers);

/// Bakes one image with layers. The same texels for any thread count. Rays per texel: 1, plus `ray_count` for `ao` and
/// `bent` together, `ray_count` for `thickness`, and 1 to 9 for colors. Errors: those of bakeMap, invalidOption and
/// countMismatch.
Result<BakedMaps> bakeMaps(const LowPoly& low, const HighPoly& high, const BakeOptions& options,
                           const LayerOptions& layers, const Execution& execution = {}, const Progress& progress = {});

}  // namespace tspace
