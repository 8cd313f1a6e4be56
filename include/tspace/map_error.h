// SPDX-License-Identifier: MIT
// How far a normal map is from the surface that it stands for, in degrees, as a renderer shades it. CMake target
// tspace::maps.
//
// The truth at a point of the low poly is the normal of the high poly where the line along the low poly's interpolated
// normal meets it. Rays are Embree's: without it (at build or at run time) these calls fail with unsupportedFile. It works on
// the threads of the call alone, where the process has no other devices of Embree. Limits that a host sets for TBB, which
// Embree uses, hold on, but for the microseconds in which devices are made.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tspace/callbacks.h"
#include "tspace/execution.h"
#include "tspace/map_image.h"
#include "tspace/map_reading.h"
#include "tspace/result.h"
#include "tspace/span.h"
#include "tspace/vec.h"

namespace tspace {

/// The mesh that a map is drawn on. All spans have three entries per triangle, one for each corner, or are empty where that
/// is said. Triangles that are not finite are left out.
struct LowPoly {
    StridedSpan<const Vec3> positions = {};
    StridedSpan<const Vec3> normals = {};   ///< as stored: used for rays and for shading
    StridedSpan<const Vec4> tangents = {};  ///< empty with MapSpace::object
    StridedSpan<const Vec2> uvs = {};       ///< v runs down
    StridedSpan<const Vec3> cage = {};      ///< where rays begin; empty: they go both ways from the surface
    /// One per triangle: it looks only at triangles of the high poly with the same number. Empty, also there: at all.
    std::span<const std::uint32_t> groups = {};
};

/// The mesh with the detail, in the same coordinates.
struct HighPoly {
    StridedSpan<const Vec3> positions = {};       ///< one per vertex
    StridedSpan<const Vec3> normals = {};         ///< one per vertex, or empty: each triangle is flat
    std::span<const std::uint32_t> corners = {};  ///< three per triangle; counter-clockwise is outside
    std::span<const std::uint32_t> groups = {};   ///< one per triangle, or empty
};

struct MapErrorOptions {
    MapSpace space = MapSpace::tangent;  ///< what the map is taken for; the default is glTF's
    MapReading reading = {};             ///< how it is taken to be read; the default is glTF's
    /// How far rays go from the surface, both ways; with a cage, how far beyond the surface. 0: chosen from the sizes of
    /// both meshes (chosenReach).
    double reach = 0;
    std::uint32_t point_count = 100000;  ///< spread evenly over the area of the low poly; 1 to 10,000,000
    bool heat = false;                   ///< also MapError::heat
};

/// Angles between the shaded normal and the truth, in degrees.
struct MapError {
    std::uint64_t point_count = 0;   ///< points that were compared
    std::uint64_t missed_count = 0;  ///< points whose line meets no high poly: not compared
    double mean_deg = 0, p99_deg = 0, max_deg = 0;
    std::uint64_t seam_point_count = 0;  ///< those within a texel of a border of the UV map
    double seam_mean_deg = 0;            ///< their mean
    double inside_mean_deg = 0;          ///< that of the others
    double reach = 0;                    ///< what was used
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

/// Another way to read a map.
struct MapCandidate {
    MapSpace space = MapSpace::tangent;
    MapReading reading = {};
    StridedSpan<const Vec4> tangents = {};  ///< three per triangle; empty: the low poly's
};

/// measureMap for each of several readings, at equal points, without `heat`. Errors as measureMap.
Result<std::vector<MapError>> measureReadings(const MapImage& map, const LowPoly& low, const HighPoly& high,
                                              std::span<const MapCandidate> candidates,
                                              const MapErrorOptions& options = {}, const Execution& execution = {},
                                              const Progress& progress = {});

}  // namespace tspace
