// SPDX-License-Identifier: MIT
// How far a normal map is from the surface that it stands for, in degrees, as a renderer shades it. CMake target
// tspace::maps.
//
// The truth at a point of the low poly is the normal of the high poly where the point's ray meets it (map_rays.h). Rays are
// Embree's: without it (at build or at run time) these calls fail with unsupportedFile. It works on
// the threads of the call alone, where the process has no other devices of Embree. Limits that a host sets for TBB, which
// Embree uses, hold on, but for the microseconds in which devices are made.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tspace/callbacks.h"
#include "tspace/execution.h"
#include "tspace/map_image.h"
#include "tspace/map_rays.h"
#include "tspace/map_reading.h"
#include "tspace/result.h"
#include "tspace/span.h"
#include "tspace/vec.h"

namespace tspace {

/// A group that sees all, and is seen by all.
inline constexpr std::uint32_t kEveryGroup = 0xffffffff;

/// The mesh that a map is drawn on. All spans have three entries per triangle, one for each corner, or are empty where that
/// is said. Triangles that are not finite are left out.
struct LowPoly {
    StridedSpan<const Vec3> positions = {};
    StridedSpan<const Vec3> normals = {};   ///< as stored: used for rays and for shading
    StridedSpan<const Vec4> tangents = {};  ///< empty with MapSpace::object
    StridedSpan<const Vec2> uvs = {};       ///< v runs down
    StridedSpan<const Vec3> cage = {};      ///< where rays begin; empty: as RayOptions say
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
    MapSpace space = MapSpace::tangent;  ///< what the map is taken for; the default is glTF's
    MapReading reading = {};             ///< how it is taken to be read; the default is glTF's
    /// How far rays go from the surface, inwards and outwards; with a cage, how far beyond the surface. 0: chosen from the
    /// sizes of both meshes (chosenReach).
    double reach = 0;
    RayOptions rays = {};
    std::uint32_t point_count = 100000;  ///< spread evenly over the area of the low poly; 1 to 10,000,000
    bool heat = false;                   ///< also MapError::heat
};

/// What a point counts as whose ray meets no high poly: nothing is right there.
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
    double mean_deg = 0, p99_deg = 0, max_deg = 0;  ///< of all points; one that missed counts as kMissedDeg
    double met_mean_deg = 0;                        ///< the mean of those that met the high poly
    std::uint64_t seam_point_count = 0;             ///< those within a texel of a border of the UV map
    double seam_mean_deg = 0;                       ///< their mean
    double inside_mean_deg = 0;                     ///< that of the others
    double reach = 0, cage_offset = 0;              ///< what was used; no offset with a cage of the low poly's own
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
    /// Which rays say the truth; null: those of the options. Must stay.
    const RayOptions* rays = nullptr;
    double reach = 0;  ///< with `rays`; 0: that of the options
};

/// measureMap for each of several readings, at equal points, without `heat`. Errors as measureMap.
Result<std::vector<MapError>> measureReadings(const MapImage& map, const LowPoly& low, const HighPoly& high,
                                              std::span<const MapCandidate> candidates,
                                              const MapErrorOptions& options = {}, const Execution& execution = {},
                                              const Progress& progress = {});

}  // namespace tspace
