// SPDX-License-Identifier: MIT
// Occlusion above a point of a surface, and thickness below it.
#pragma once

#include "maps/rays/map_surfaces.h"

namespace tspace {

struct OcclusionOptions {
    std::uint32_t ray_count = 64;
    double sky_distance = 0;  ///< maximum ray length for occlusion; 0: unlimited
    bool has_sky = true, has_thickness = true;
};

struct Occlusion {
    double open = 1;       ///< unoccluded part of the sky, 0 to 1
    DVec3 bent = {};       ///< mean unoccluded direction (unit), or the normal if every direction is occluded
    double thickness = 0;  ///< mean depth of the hits of inward rays, along the normal
    double solid = 0;      ///< part of the inward rays that hit something
};

/// Computes occlusion with directions about the shading normal, with a density proportional to the cosine. Directions
/// below the plane of the hit triangle are ignored, so that a coarse, smoothly shaded sphere does not occlude itself.
/// Triangles occlude from both sides, in every group. `x`, `y`: texel position, which selects the sample directions.
Occlusion occlusionAt(const MapSurfaces& surfaces, const SurfaceHit& hit, const OcclusionOptions& options,
                      std::uint32_t x, std::uint32_t y);

}  // namespace tspace
