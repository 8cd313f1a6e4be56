// SPDX-License-Identifier: MIT
// Rays for the texels of a map: the vector wanted at each texel's centre, and samples between centres.
#pragma once

#include "maps/bake/texel_plan.h"
#include "maps/bake/traced_texels.h"
#include "maps/error/measure_points.h"
#include "maps/layout/texel_triangles.h"
#include "maps/solve/solve_texels.h"
#include "tspace/maps.h"

namespace tspace {

/// Shoots a ray from the center of each texel inside a triangle or its padding.
void traceTexels(const MapSurfaces& surfaces, const TexelTriangles& triangles, const BakeOptions& options,
                 const MapWork& work, TracedTexels& traced);

/// Bands with samples between texel centers.
struct PointsBetween {
    const SampleBands& bands;
    std::uint32_t n;  ///< n x n points a texel
};

/// Returns the bands that have samples in the window.
std::vector<std::size_t> bandsOf(const TexelWindow& window);

/// Rays at points in the cells of the plan that are asked or rough; what they say is added to the system of the window, and what
/// the centres say that are none of these points. `steps` go on by as many as the window has bands.
void traceBetween(const MapSurfaces& surfaces, const TracedTexels& traced, const TexelPlan& plan,
                  const TexelWindow& window, const PointsBetween& points, const BakeOptions& options,
                  const MapWork& work, ToldSteps& steps, TexelSystem& system);

/// Adds what `texels` of the window, filtered, say in the smooth cells of the plan, as much as rays at `points` x `points` points
/// a texel say in others.
void addSmoothCells(const TexelPlan& plan, const TexelWindow& window, std::span<const Vec3> texels,
                    std::uint32_t points, const BakeOptions& options, Parallel& parallel, TexelSystem& system);

/// Gives texels that have an origin but no vector one, ring by ring: the first ring what the slope before it leads to, the
/// others the mean of their neighbours; flat ones where there is none.
void fillFromNeighbours(TracedTexels& traced, const TextureShape& shape);

}  // namespace tspace
