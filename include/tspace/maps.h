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

/// Axes of a map in object space: directions of its x, y and z in the coordinates of the meshes. Default: those coordinates.
struct MapAxes {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

    friend bool operator==(const MapAxes&, const MapAxes&) = default;
};

/// Maps of programs in which z points up (Blender, 3ds Max), for meshes of which y does: those have x, -z, y.
inline constexpr MapAxes kMapAxesZUp{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};

/// Behavior of a texture outside the 0-1 UV range.
enum class TextureWrap : std::uint32_t { repeat = 0, mirror = 1, clamp = 2 };

/// The space of the vectors of a map.
enum class MapSpace : std::uint32_t {
    tangent = 0,
    object = 1  ///< the coordinates of the meshes
};

/// An image of a normal map.
struct MapImage {
    std::uint32_t width = 0, height = 0;
    std::span<const Vec3> texels = {};  ///< width * height, channels from 0 to 1, row 0 is v = 0
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
};

// How a renderer turns a texel of a normal map, and the frames of the mesh, into the normal that it shades. A map is
// right only for the reading that it was made for.

/// Where B = w * cross(N, T) is computed.
enum class BitangentPlace : std::uint32_t {
    perPixel = 0,  ///< from the interpolated N and T
    perVertex = 1  ///< at the vertices, and interpolated
};

/// The default is green up as in glTF, and MikkTSpace's rule, since glTF specifies none: unit(x T + y B + z N),
/// (x, y, z) = 2c - 1, with T and N as interpolated.
struct MapReading {
    Green green = Green::up;
    BitangentPlace bitangent = BitangentPlace::perPixel;
    bool unit_vectors = false;  ///< N, T and B are made unit, each, before the texel is applied
    bool two_channels = false;  ///< z is the root of 1 - x^2 - y^2, and blue is not read
    float scale = 1.0f;         ///< x and y times this (glTF's normalTexture.scale); not 0

    friend bool operator==(const MapReading&, const MapReading&) = default;
};

/// Finds the reading of a program by its name in lower case: the names of findConvention, and "three". `gltf`, `blender`
/// and `opengl` are the default; `directx` has green down; `unreal` green down and two channels; `unity` (URP and HDRP) two
/// channels; `godot` and `three` a bitangent per vertex and unit vectors, and `godot` two channels. From the shader
/// sources of these programs as they stood in 2026 (docs/reference/shaders.md). Null for any other name. Thread-safe.
const MapReading* findMapReading(const char* name);

/// Which of the front faces of the high poly on the ray of a point of the low poly is baked.
enum class RayTarget : std::uint32_t {
    /// The first one from the cage inwards, and so what is seen from outside: bolts on a plate, and not the plate below.
    /// Where there is none, the nearest one beyond the cage.
    outermost = 0,
    /// The one nearest to the low poly, on either side: for fingers, and parts thinner than the cage is far.
    nearest = 1,
};

/// Directions of the rays.
enum class RayDirections : std::uint32_t {
    /// Straight at flat faces, and averaged near edges where faces meet at over 30 degrees: nothing leans in the middle of
    /// a face, and nothing is cut at its edges. Averaged where there are no such edges. The field calls it skew
    /// correction.
    automatic = 0,
    /// The mean of the normals at each position, by the angles of the triangles: no gaps at split normals, but what
    /// stands on flat faces between averaged normals leans.
    averaged = 1,
    normals = 2,  ///< the low poly's normals as stored: gaps and overlaps at hard edges
};

/// Not for a low poly with a cage mesh, whose rays go from the cage through the low poly (LowPoly::cage).
struct RayOptions {
    RayTarget target = RayTarget::outermost;
    RayDirections directions = RayDirections::automatic;
    /// Cage distance: how far from the low poly's faces rays start; `nearest` only uses it to choose. 0: the reach.
    double cage_offset = 0;
    /// In place of `directions`: its first channel, by the low poly's UVs, is 0 where rays are averaged and 1 where they
    /// are at right angles to the triangle. Without texels: none.
    MapImage skew = {};
    /// Weld distance for ray directions and curvature: as NormalOptions::weld_distance.
    float weld_distance = NormalOptions::weld_auto;
};

// How far a normal map is from the surface that it stands for, in degrees, as a renderer shades it.
//
// The truth at a point of the low poly is the normal of the high poly where the point's ray meets it. Rays are
// Embree's: without it (at build or at run time) these calls fail with unsupportedFile. It works on
// the threads of the call alone, where the process has no other devices of Embree. Limits that a host sets for TBB, which
// Embree uses, hold on, but for the microseconds in which devices are made.

/// A group that sees all, and is seen by all.
inline constexpr std::uint32_t kEveryGroup = 0xffffffff;

/// The mesh that a map is drawn on. All spans have three entries per triangle, one for each corner, or are empty where that
/// is said. Triangles that are not finite are left out.
struct LowPoly {
    StridedSpan<const Vec3> positions = {};
    StridedSpan<const Vec3> normals = {};   ///< normals as stored: used for rays and for shading
    StridedSpan<const Vec4> tangents = {};  ///< empty with MapSpace::object
    StridedSpan<const Vec2> uvs = {};       ///< v runs down
    StridedSpan<const Vec3> cage = {};      ///< start of the rays; empty: as in RayOptions
    /// One per triangle: it looks only at triangles of the high poly with the same number, or where either is kEveryGroup.
    /// Empty, also there: at all.
    std::span<const std::uint32_t> groups = {};
    /// What of the mesh the map does not show: other materials, other tiles. Three entries per triangle, of both or of
    /// none. Rays near an edge depend on the triangles on both sides of it.
    StridedSpan<const Vec3> rest_positions = {}, rest_normals = {};
};

/// A normal map that a high poly shows itself, and how its material reads it.
struct HighMap {
    MapImage image = {};  ///< in tangent space
    MapReading reading = {};
};

/// In HighPoly::map_of: this triangle shows no map.
inline constexpr std::uint32_t kNoHighMap = 0xffffffff;

/// The mesh with the detail, in the same coordinates.
struct HighPoly {
    StridedSpan<const Vec3> positions = {};       ///< one per vertex
    StridedSpan<const Vec3> normals = {};         ///< one per vertex, or empty: each triangle is flat
    std::span<const std::uint32_t> corners = {};  ///< three per triangle; counter-clockwise is outside
    std::span<const std::uint32_t> groups = {};   ///< one per triangle, or empty
    /// Its own normal maps. Where a triangle shows one, the normal that the map gives there is the truth. Empty: none.
    std::span<const HighMap> maps = {};
    std::span<const std::uint32_t> map_of = {};  ///< with `maps`, one per triangle: a number into them, or kNoHighMap
    /// With `maps`, one per vertex; only those of triangles that show one count. `normals` are needed then.
    StridedSpan<const Vec4> tangents = {};
    StridedSpan<const Vec2> uvs = {};
};

struct MapErrorOptions {
    MapSpace space = MapSpace::tangent;  ///< space that the map is read in; the default is that of glTF
    MapReading reading = {};             ///< how it is taken to be read; the default is glTF's
    MapAxes axes = {};                   ///< with MapSpace::object
    /// Ray distance from the surface, inwards and outwards; with a cage, the distance beyond the surface. 0: chosen from the
    /// sizes of both meshes (chosenReach).
    double reach = 0;
    RayOptions rays = {};
    std::uint32_t point_count = 100000;  ///< spread evenly over the area of the low poly; 1 to 10,000,000
    bool heat = false;                   ///< also MapError::heat
};

/// Error of a sample whose ray hits no high poly.
inline constexpr double kMissedDeg = 90;

/// Angles between the shaded normal and the truth, in degrees.
struct MapError {
    std::uint64_t point_count = 0;   ///< points that met the high poly
    std::uint64_t missed_count = 0;  ///< points whose ray meets no front of it
    /// Points whose ray meets another front of the high poly further out than the one that counts, as far as it looks.
    std::uint64_t hidden_count = 0;
    /// Points whose ray goes through a back of the high poly before the front that counts, or meets backs alone.
    std::uint64_t back_count = 0;
    std::uint64_t inward_count = 0;                 ///< points that met a front whose normal, as shaded, points inwards
    double mean_deg = 0, p99_deg = 0, max_deg = 0;  ///< over all samples; one without a hit counts as kMissedDeg
    double met_mean_deg = 0;                        ///< the mean of those that met the high poly
    std::uint64_t seam_point_count = 0;             ///< samples within one texel of a UV border
    double seam_mean_deg = 0;                       ///< their mean
    double inside_mean_deg = 0;                     ///< mean over the other samples
    double reach = 0, cage_offset = 0;              ///< the values used; no offset with a cage mesh
    /// One per texel, degrees: the mean over four points of it; -1 where no triangle has one of them. Empty unless asked for.
    std::vector<float> heat = {};
};

/// A twentieth of the diagonal of the larger box, or, where it is more, 1.5 times what the boxes of the meshes differ by; never
/// more than a quarter of the diagonal. 0 where the boxes have nothing in common. Linear; thread-safe.
double chosenReach(const LowPoly& low, const HighPoly& high);

/// Compares a map with the surface. The same figures for any thread count. Memory: about 100 bytes per point, 200 per
/// triangle of the high poly, 16 per texel with `heat`. Errors: nullData, countMismatch, strideTooSmall, misaligned,
/// indexOutOfRange, invalidOption, missingAttribute (no UVs, normals or tangents; meshes that are nowhere near each other),
/// unsupportedFile (no Embree), cancelled, outOfMemory. Thread-safe.
Result<MapError> measureMap(const MapImage& map, const LowPoly& low, const HighPoly& high,
                            const MapErrorOptions& options = {}, const Execution& execution = {},
                            const Progress& progress = {});

/// Another way to read a map, or to look for what it shows.
struct MapCandidate {
    MapSpace space = MapSpace::tangent;
    MapReading reading = {};
    StridedSpan<const Vec4> tangents = {};  ///< three per triangle; empty: the low poly's
    /// Rays that define the truth; null: those of the options. Must stay valid.
    const RayOptions* rays = nullptr;
    double reach = 0;   ///< with `rays`; 0: that of the options
    MapAxes axes = {};  ///< with MapSpace::object
};

/// measureMap for each of several readings, at equal points, without `heat`. Errors as measureMap.
Result<std::vector<MapError>> measureReadings(const MapImage& map, const LowPoly& low, const HighPoly& high,
                                              std::span<const MapCandidate> candidates,
                                              const MapErrorOptions& options = {}, const Execution& execution = {},
                                              const Progress& progress = {});

/// How long the vectors of maps of 8 bits may be, of which there are so few that a longer or shorter one often points better.
enum class TexelLengths : std::uint32_t {
    even = 0,  ///< 0.9 to 1: means of several texels, as in smaller levels, are nearly as right as those of 16 bits
    free = 1,  ///< 0.7 to 1.1: the first level errs by up to a third less, and smaller ones lean to the longer texels
};

// Conversion: a normal map that shows on one set of frames what it showed on another.
//
// The surface and its UVs are the same on both sides; tangents, normals, splits, the way quads are cut, the convention, and
// the space may differ. Each texel is read with the frames of its place on one side, and written for those of the other. Frames
// are smooth where filtering mixes texels, so one texel at a time is enough: what comes out is as exact as its numbers.

/// One side of a conversion: what a map is read with. Spans have three entries per triangle, one for each corner.
struct MapSide {
    MapSpace space = MapSpace::tangent;
    /// In object space only `green` counts.
    MapReading reading = {};
    StridedSpan<const Vec2> uvs = {};  ///< v runs down; empty: this side has no mesh
    /// With MapSpace::tangent, as stored. What is stored need not be unit, nor at right angles.
    StridedSpan<const Vec3> normals = {};
    StridedSpan<const Vec4> tangents = {};
    /// Empty, or what tells triangles apart that have the same UVs, such as mirrored halves.
    StridedSpan<const Vec3> positions = {};
    /// With MapSpace::object, one per triangle: the map's axes in the coordinates of the other side's frames. They need be
    /// neither unit nor at right angles. Empty: the same coordinates.
    std::span<const MapAxes> axes = {};
};

struct ConvertMapOptions {
    /// 8 or 16: texels that change are numbers n / (2^bits - 1), n whole. 32: as computed.
    unsigned bits = 16;
    /// With 8 bits and three channels, of vectors that had such lengths. Others keep theirs, within a twentieth, and so do those
    /// beside vectors over 9 degrees away.
    TexelLengths lengths = TexelLengths::even;
    /// Texels around the triangles that are converted with the nearest one. 0: those alone that bilinear filtering reads.
    std::uint32_t padding = 0;
};

struct ConvertMapReport {
    std::uint64_t converted = 0;   ///< texels that triangles or their padding show, and that were converted
    std::uint64_t changed = 0;     ///< texels of these whose value changed
    std::uint64_t background = 0;  ///< texels that no triangle shows: left as they are
    /// Left as they are because there is no answer: frames that are singular or not finite, texels without a direction.
    std::uint64_t without_frame = 0;
    std::uint64_t below_horizon = 0;  ///< would need z < 0, which two channels cannot say; they get z = 0
    std::uint64_t overlapping = 0;    ///< texels that several triangles show; the first decides
    /// From tangent to object space: those of them for whose triangles the map means directions over 2 degrees apart, as it does
    /// for mirrored halves. One direction alone can be stored.
    std::uint64_t conflicting = 0;
    // Triangles that are left out:
    std::uint64_t degenerate_uv_count = 0;  ///< without UV area
    std::uint64_t bad_uv_count = 0;         ///< UVs not finite, or more than 64 images large
    std::uint64_t unmatched = 0;            ///< texels of the source's triangles where the other side has none: left
    /// Texels where the triangles of both sides are no corner for corner the same, and lie over a fiftieth of the mesh's size
    /// apart in space, where both have positions: the sides are not one surface with one UV map.
    std::uint64_t apart = 0;
    /// Angles between what a texel shows after and what it would have shown unconverted on the new side, over `converted`.
    double mean_change_deg = 0, max_change_deg = 0;
    double half_step_deg = 0;  ///< half a step of the output's integers as an angle; 0 with 32 bits
    /// Something is to be changed, by less than half a step in the mean: rounding will undo it.
    bool is_below_half_step = false;
};

/// Converts `map` from one side to the other into `out` (width * height; may be where map.texels is).
///
/// - Texels keep their lengths, but for those that would not fit, and with 8 bits.
/// - With 16 bits between tangent and object space, lengths change by up to half a hundredth such that vectors point better, and
///   neighbours make good under the filter what is rounded off. So they do with 8 bits and three channels, where lengths change as
///   `lengths` says. Otherwise a channel goes to the nearest integer.
/// - Sides that read a texel alike leave it as it is, bit for bit; where only green differs it becomes 1 - G exactly.
/// - Without a mesh on both sides, readings alone are converted, of all texels; they may differ in green, scale and channels.
/// - With a mesh on one side, the other side is in object space, or has the same frames.
/// - Triangles of both sides are matched by UVs and positions, in any order; where none has the same corners, by place.
/// - No texel becomes NaN. Two-channel readings get unit vectors, and the third channel as others read it.
///
/// Errors: nullData, countMismatch, strideTooSmall, misaligned, invalidOption (bits; a scale that is 0 or not finite),
/// missingAttribute (a mesh, normals or tangents that are needed), tooLarge (more than 2^32 texels, or UVs that show the image
/// far too often), outOfMemory, cancelled. Time: linear. Memory: about 30 bytes a texel, 55 with 16 bits between
/// tangent and object space, 45 and 20,000 a column with 8 bits. The same bits for any number of threads. Thread-safe.
Result<ConvertMapReport> convertMap(const MapImage& map, const MapSide& from, const MapSide& to,
                                    const ConvertMapOptions& options, std::span<Vec3> out,
                                    const Execution& execution = {}, const Progress& progress = {});

// From heights to normals: a bump map as a normal map.

struct HeightMap {
    std::uint32_t width = 0, height = 0;
    std::span<const float> heights = {};  ///< width * height, row 0 is v = 0; 0 is black and 1 is white
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;  ///< wrap modes
};

struct HeightToNormalOptions {
    /// How high white stands above black. With a mesh in its units, else in texels. Below 0: white lies deeper.
    double strength = 1;
    Green green = Green::up;  ///< direction of green in the normal map
    /// Channels are rounded to n / (2^bits - 1), n whole. 32: as computed.
    unsigned bits = 16;
};

struct HeightToNormalReport {
    std::uint64_t on_mesh = 0;  ///< texels whose size was taken from the triangle that shows them
    double texel_size = 1;      ///< in the units of strength: the mean over the mesh, which all others get
    double mean_lean_deg = 0, max_lean_deg = 0;  ///< angles between the normals and the surface's
};

/// Makes a normal map of heights into `out` (width * height).
///
/// With h from 0 to 1 (any other range works too) and S the strength, in texels: n = unit(-S dh/dx, S dh/drow, 1), y up.
/// Derivatives are differences of the texels on both sides, of three rows (columns) weighted 3 : 10 : 3 (Scharr): exact for
/// planes, and for parabolas. At borders with TextureWrap::clamp they are one-sided: (-3 h0 + 4 h1 - h2) / 2, or h1 - h0 where
/// there are two texels, and 0 where there is one. With a mesh, n = N - S grad h, grad h = (h_u (P_v x N) + h_v (N x P_u)) / (N . (P_u x P_v)) (Blinn 1978), where
/// P_u and P_v are the edges of the texel on its triangle, and n is told in the mesh's frames, as MapSide has them. So the
/// strength does not depend on the size of the image or the UVs. Texels that no triangle shows are squares of the mean size.
///
/// `mesh`    in tangent space; empty: none
///
/// Errors: nullData, countMismatch, strideTooSmall, misaligned, invalidOption (bits; a strength that is not finite),
/// missingAttribute (positions, normals or tangents of the mesh), tooLarge, outOfMemory. Time: linear. The same bits for any
/// number of threads. Thread-safe.
Result<HeightToNormalReport> heightToNormal(const HeightMap& map, const MapSide& mesh,
                                            const HeightToNormalOptions& options, std::span<Vec3> out,
                                            const Execution& execution = {});

// Baking: a normal map that makes a low poly look like a high poly.
//
// Rays go from a cage around the low poly inwards. The map is right for the frames that the low poly has, read
// as the options say; its error is measured as measureMap does.

/// How texels are found.
enum class MapFit : std::uint32_t {
    /// All together, so that the bilinear-filtered map is right between texels too: least squares, counted across the wanted
    /// direction. Integers are chosen so too. Rays at each texel's centre, and at 2 x 2 or 3 x 3 points a texel where what lies
    /// between centres does not follow from them.
    solve = 0,
    texel = 1,  ///< each alone: right at its centre
};

/// Whose normals count where triangles share texels and want different ones, as mirrored halves of a surface that is not
/// symmetric do. Pieces of the UV map are triangles that join in UVs and in space and turn one way.
enum class MapOverlap : std::uint32_t {
    mean = 0,    ///< the mean of all: equally wrong on each
    first = 1,   ///< the piece whose triangles come first in the mesh
    larger = 2,  ///< the piece with the larger surface
};

struct BakeOptions {
    std::uint32_t width = 1024, height = 1024;  ///< 1 to 16384
    unsigned bits = 16;                         ///< bits per channel: 8 or 16
    MapSpace space = MapSpace::tangent;         ///< space of its vectors; the default is that of glTF
    MapAxes axes = {};                          ///< with MapSpace::object: unit, and at right angles
    MapReading reading = {};  ///< reader that the map is made for. With two channels all texels have length 1
    /// How the texture goes on outside of 0 to 1. What reaches beyond the edge of a clamped one has no say.
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
    MapFit fit = MapFit::solve;
    MapOverlap overlap = MapOverlap::mean;
    TexelLengths lengths = TexelLengths::even;  ///< with 8 bits and three channels
    std::uint32_t padding = 16;                 ///< texels around the triangles that continue them; 0 to 256
    double reach = 0;                           ///< like MapErrorOptions::reach
    RayOptions rays = {};
    bool heat = false;  ///< MapError::heat
    /// Most memory that the call may take: bakeBytes is compared with it before any work (tooLarge). 0: no limit.
    std::uint64_t memory_limit_bytes = 0;
};

/// The origin of a texel of a baked map.
enum class TexelOrigin : std::uint8_t {
    background = 0,  ///< no triangle is near: flat
    padding = 1,     ///< continues the nearest triangle
    hit = 2,         ///< its centre lies in a triangle, and the line through it met the high poly
    missed = 3,      ///< its centre lies in a triangle, and the line met nothing: filled from its neighbours
};

struct BakedMap {
    std::uint32_t width = 0, height = 0;
    unsigned bits = 16;
    std::vector<Vec3> texels = {};          ///< channels n / (2^bits - 1), n whole; row 0 is v = 0
    std::vector<TexelOrigin> origins = {};  ///< one per texel
    std::vector<bool> overlaps = {};        ///< one per texel: its centre lies inside of several triangles
    std::uint64_t hit_count = 0, missed_count = 0, padding_count = 0;  ///< texels
    std::uint64_t overlap_count = 0;  ///< texels whose centre lies inside of several triangles
    /// Those of them whose triangles want normals over 2 degrees apart; MapOverlap says which they get. And how far apart
    /// these are: two that share a texel, or the piece that counts and the mean of the others.
    std::uint64_t conflict_count = 0;
    double conflict_mean_deg = 0, conflict_max_deg = 0;
    std::uint64_t degenerate_uv_count = 0;  ///< triangles without UV area, or whose UVs are not finite: nothing drawn
    /// Against the outermost front of the high poly, as shaded, whatever the map's own rays look for: what is seen.
    MapError error = {};
    MapError own_error = {};  ///< with RayTarget::nearest: against what its own rays met; else without points
};

/// The peak memory of a bake, about; with `solve` that of one whose texels all need rays between them.
std::uint64_t bakeBytes(std::uint64_t low_triangles, std::uint64_t high_triangles, const BakeOptions& options);

/// Bakes one image. The same texels for any thread count. Time: rays, about 1 microsecond
/// each, 1 a texel or, with `solve`, 1 to 10; and with `solve` 1 to 3 microseconds a texel. Errors as measureMap;
/// tooLarge; missingAttribute also where no line meets the high poly, or the UVs cover no texel. Thread-safe.
Result<BakedMap> bakeMap(const LowPoly& low, const HighPoly& high, const BakeOptions& options = {},
                         const Execution& execution = {}, const Progress& progress = {});

// What a bake can make beside the normal map, from the same rays: ambient occlusion, bent normals, curvature, heights,
// positions, thickness, ids, and what the materials of the high poly show.
//
// A texel of a layer stands for the point of the high poly that the ray of its centre meets, which is the point whose normal the
// normal map shows there; colours are means over the rays of a texel. Where several triangles of the low poly share a
// texel, colours are the mean over all of them, and the other layers are those of the first.

enum class MapLayer : std::uint32_t {
    ao = 0,    ///< the part of the sky over the point that nothing hides, by the cosine: 1 is all of it
    bent = 1,  ///< the mean of the directions that nothing hides, unit, told as BakeOptions tell normals
    curvature =
        2,  ///< mean curvature of the high poly in 1 / length: that of a sphere of radius r is 1 / r; above 0 is convex
    height = 3,    ///< from the low poly to the high poly along the ray, outwards
    position = 4,  ///< of the high poly
    /// The mean depth under the point at which rays into the solid leave it, by the cosine: of a slab its height, of a ball its
    /// radius. Rays that leave nothing (an open sheet) count as deep as white is.
    thickness = 5,
    id = 6,       ///< a colour for each number of LayerOptions::ids (idColor)
    color = 7,    ///< ShownMaterial::color: linear light
    orm = 8,      ///< occlusion (`ao`, where it is made; else 1), roughness, metalness
    emission = 9  ///< ShownMaterial::emission: linear light
};
inline constexpr std::uint32_t kMapLayerCount = 10;
inline constexpr std::uint32_t kMostLayerRays = 4096;

/// What a material shows at a point.
struct ShownMaterial {
    Vec3 color{1, 1, 1};  ///< linear
    float roughness = 1, metalness = 0;
    Vec3 emission{0, 0, 0};  ///< linear
};

/// What the high poly shows at a point of a triangle, of which the weights of the corners are given. Threads call at once.
using MaterialAt = std::function<ShownMaterial(std::uint32_t triangle, const std::array<double, 3>& weights)>;

struct LayerOptions {
    std::vector<MapLayer> layers = {};  ///< each at most once; may be empty
    bool has_normal = true;             ///< also the normal map itself
    /// Rays from each point for `ao`, `bent` and `thickness`: 1 to kMostLayerRays. The same ones for all three.
    std::uint32_t ray_count = 64;
    double sky_distance = 0;  ///< what is further away hides nothing of the sky; 0: everything hides
    /// What white stands for, in lengths (`curvature`: 1 / length); black is minus that for `height` and `curvature`. 0: the
    /// largest that is met; of `curvature` what 99 % are below.
    double height_range = 0, curvature_range = 0, thickness_range = 0;
    /// The box of `position`, black to white. Where `least` is not below `most`: that of the high poly.
    std::array<double, 3> position_least = {}, position_most = {};
    std::span<const std::uint32_t> ids = {};  ///< one per triangle of the high poly, for `id`
    MaterialAt material = {};                 ///< for `color`, `orm` and `emission`
};

/// A layer of a map.
struct BakedLayer {
    MapLayer layer = MapLayer::ao;
    std::uint32_t channel_count = 1;  ///< 1 or 3
    std::vector<float> values = {};   ///< from 0 to 1, channel_count per texel; row 0 is v = 0
    /// What 0 and 1 of each channel stand for, in units of the meshes.
    std::array<double, 3> least = {0, 0, 0}, most = {1, 1, 1};
};

struct BakedMaps {
    /// Without texels and without errors where there is no normal map.
    BakedMap normal = {};
    std::vector<BakedLayer> layers = {};  ///< in the order of LayerOptions::layers
};

/// "ao", "bent" and so on; empty for what is none.
const char* layerName(MapLayer layer);

/// Three channels from 0 to 1, which eight bits hold. Of two numbers below 2^24 - 1 they differ; of the first eight by a half, of the
/// first 64 by a quarter, in a channel at least. None is black.
Vec3 idColor(std::uint32_t id);

/// The peak memory of the layers, about, beside bakeBytes.
std::uint64_t layerBytes(std::uint64_t high_triangles, const BakeOptions& options, const LayerOptions& layers);

/// bakeMap with layers. The same texels for any thread count. Time: one ray a texel, and `ray_count` more for `ao`
/// and `bent`, and as many for `thickness`; 1 to 9 a texel for colours. Errors as bakeMap; also invalidOption and countMismatch.
Result<BakedMaps> bakeMaps(const LowPoly& low, const HighPoly& high, const BakeOptions& options,
                           const LayerOptions& layers, const Execution& execution = {}, const Progress& progress = {});

}  // namespace tspace
