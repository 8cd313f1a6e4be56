// SPDX-License-Identifier: MIT
// Baking: a normal map that makes a low poly look like a high poly. CMake target tspace::maps.
//
// Rays go from a cage around the low poly inwards (map_rays.h). The map is right for the frames that the low poly has, read
// as the options say; its error is measured (map_error.h).
#pragma once

#include "tspace/map_error.h"
#include "tspace/texel_lengths.h"

namespace tspace {

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
    first = 1,   ///< those of the piece whose triangles come first in the mesh
    larger = 2,  ///< those of the piece with the larger surface
};

struct BakeOptions {
    std::uint32_t width = 1024, height = 1024;  ///< 1 to 16384
    unsigned bits = 16;                         ///< of a channel: 8 or 16
    MapSpace space = MapSpace::tangent;         ///< what its vectors are told in; the default is glTF's
    MapAxes axes = {};                          ///< with MapSpace::object: unit, and at right angles
    MapReading reading = {};  ///< what the map is made for. With two channels all texels have length 1
    /// How the texture goes on outside of 0 to 1. What reaches beyond the edge of a clamped one has no say.
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
    MapFit fit = MapFit::solve;
    MapOverlap overlap = MapOverlap::mean;
    TexelLengths lengths = TexelLengths::even;  ///< with 8 bits and three channels
    std::uint32_t padding = 16;                 ///< texels around the triangles that continue them; 0 to 256
    double reach = 0;                           ///< as MapErrorOptions::reach
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

}  // namespace tspace
