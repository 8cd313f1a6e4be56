// SPDX-License-Identifier: MIT
// Conversion of one texel from one frame and interpretation to another.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/base/parallel.h"
#include "maps/texels/shading.h"
#include "tspace/maps.h"

namespace tspace {

/// Numeric format of the output.
struct TexelNumbers {
    unsigned bits = 16;       ///< 8, 16, or 32 (no rounding to integers)
    bool are_chosen = false;  ///< true: integers are chosen later, so changed texels stay unrounded
    [[nodiscard]] unsigned most() const { return (1U << bits) - 1; }  ///< largest integer for 8 or 16 bits
};

struct ConvertedTexel {
    Vec3 texel = {};
    double change_deg = 0;  ///< angle between the new normal and the one that the old texel would show on the new side
    bool is_below_horizon = false;
    /// True: the texel is unchanged except for green, because both sides interpret it alike and integers represent it
    /// exactly.
    bool stays = false;
};

/// Returns the nearest channel values for a vector in stored form.
Vec3 channelsOf(const DVec3& stored, const TexelNumbers& numbers);

/// Converts a texel. Returns nullopt if there is no solution: a singular or non-finite frame, or a texel without
/// direction.
std::optional<ConvertedTexel> convertTexel(const Vec3& texel, const ShadingFrame& from, const MapReading& from_reading,
                                           const ShadingFrame& to, const MapReading& to_reading,
                                           const TexelNumbers& numbers);

// The error of a map that was converted from one set of frames to another.

/// Returns the frame of one side of a conversion at a point of a triangle.
ShadingFrame sideFrame(const MapSide& side, std::size_t triangle, const std::array<double, 3>& weights);

/// Error angles at points of all triangles, one point per covered texel, filtered as renderers do.
struct CarriedError {
    /// mean angle between the new map with the new frames and the old map with the old frames
    double mean_deg = 0;
    /// mean angle between the old map with the new frames and the old map with the old frames
    double mean_unconverted_deg = 0;
    std::uint64_t count = 0;  ///< number of points; 0: no triangle contains a sampled point with frames
};

/// Measures the error of a converted map. `from` and `to` must have the same triangles in the same order, in tangent
/// space. `converted` must have as many texels as `map`. Time: linear in the covered texels. The result does not depend
/// on the number of threads.
CarriedError measureCarried(const MapImage& map, std::span<const Vec3> converted, const MapSide& from,
                            const MapSide& to, Parallel& parallel);

}  // namespace tspace
