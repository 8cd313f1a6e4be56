// SPDX-License-Identifier: MIT
// Conversion: a normal map that shows on one set of frames what it showed on another. CMake target tspace::maps.
//
// The surface and its UVs are the same on both sides; tangents, normals, splits, the way quads are cut, the convention, and
// the space may differ. Each texel is read with the frames of its place on one side, and written for those of the other. Frames
// are smooth where filtering mixes texels, so one texel at a time is enough: what comes out is as exact as its numbers.
#pragma once

#include "tspace/callbacks.h"
#include "tspace/execution.h"
#include "tspace/map_axes.h"
#include "tspace/map_image.h"
#include "tspace/map_reading.h"
#include "tspace/result.h"
#include "tspace/span.h"
#include "tspace/texel_lengths.h"

namespace tspace {

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
    std::uint64_t changed = 0;     ///< those of them with another value than before
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

}  // namespace tspace
