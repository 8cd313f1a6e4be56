// SPDX-License-Identifier: MIT
// What lies over and below a point of a surface.
#pragma once

#include "maps/rays/map_surfaces.h"

namespace tspace {

struct OcclusionOptions {
    std::uint32_t ray_count = 64;
    double sky_distance = 0;  ///< 0: everything hides
    bool has_sky = true, has_thickness = true;
};

struct Occlusion {
    double open = 1;       ///< the part of the sky that nothing hides
    DVec3 bent = {};       ///< the mean of the open directions, unit; the normal where nothing is open
    double thickness = 0;  ///< the mean depth, along the normal, at which the rays inwards that met something did
    double solid = 0;      ///< the part of them that met something
};

/// The directions over the point lie about its normal as shaded, by the cosine. Those below the plane of its own triangle do not
/// count: so a coarse ball, smoothly shaded, hides nothing of its own sky. Triangles hide from both sides, whatever group they
/// are of. `x`, `y`: of the texel, which says which directions.
Occlusion occlusionAt(const MapSurfaces& surfaces, const SurfaceHit& hit, const OcclusionOptions& options,
                      std::uint32_t x, std::uint32_t y);

}  // namespace tspace
