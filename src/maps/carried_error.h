// SPDX-License-Identifier: MIT
// The error of a map that was converted from one set of frames to another.
#pragma once

#include <array>
#include <span>

#include "core/base/parallel.h"
#include "maps/shading.h"
#include "tspace/map_convert.h"

namespace tspace {

/// The frame of a side of a conversion at a point of a triangle.
ShadingFrame sideFrame(const MapSide& side, std::size_t triangle, const std::array<double, 3>& weights);

/// Angles at points of all triangles, one for each texel that a triangle shows, filtered as renderers do.
struct CarriedError {
    double mean_deg = 0;              ///< between the new map on the new frames and the old one on the old
    double mean_unconverted_deg = 0;  ///< between the old map on the new frames and on the old
    std::uint64_t count = 0;          ///< 0: no triangle has such a point, or frames there
};

/// `from` and `to` have the same triangles in the same order, in tangent space. `converted`: as many texels as `map`
/// has. Time: linear in the texels that triangles show. Equal results for any number of threads.
CarriedError measureCarried(const MapImage& map, std::span<const Vec3> converted, const MapSide& from,
                            const MapSide& to, Parallel& parallel);

}  // namespace tspace
