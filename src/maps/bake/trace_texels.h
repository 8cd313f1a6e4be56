// SPDX-License-Identifier: MIT
// Ray tracing for the texels of a map: the target vector at each texel center, and samples between centers.
#pragma once

#include "maps/bake/texel_plan.h"
#include "maps/bake/traced_texels.h"
#include "maps/error/measure_points.h"
#include "maps/layout/texel_triangles.h"
#include "maps/solve/solve_texels.h"
#include "tspace/maps.h"

namespace tspace {

/// Traces a ray from the center of each texel inside a triangle or in its padding.
void traceTexels(const MapSurfaces& surfaces, const TexelTriangles& triangles, const BakeOptions& options,
                 const MapWork& work, TracedTexels& traced);

/// Bands of rows with samples between texel centers.
struct PointsBetween {
    const SampleBands& bands;
    std::uint32_t n;  ///< n x n points per texel
};

/// Returns the bands that have samples in the window.
std::vector<std::size_t> bandsOf(const TexelWindow& window);

/// Traces rays at points in the `sampled` and `rough` cells of the plan, and adds the results to the system of the
/// window. Adds the vectors at texel centers as well if these are not among the points. Advances `steps` by the number
/// of bands in the window. The progress is reported as part of the stage that solves the system.
void traceBetween(const MapSurfaces& surfaces, const TracedTexels& traced, const TexelPlan& plan,
                  const TexelWindow& window, const PointsBetween& points, const BakeOptions& options,
                  const MapWork& work, ProgressSteps& steps, TexelSystem& system);

/// Adds the filtered values of `texels` in the smooth cells of the window, with the same weight as rays at `points` x
/// `points` points per texel in other cells.
void addSmoothCells(const TexelPlan& plan, const TexelWindow& window, std::span<const Vec3> texels,
                    std::uint32_t points, const BakeOptions& options, Parallel& parallel, TexelSystem& system);

/// Fills texels that have an origin but no vector, ring by ring: the first ring is extrapolated from the two nearest
/// texels in each direction, and farther rings use the mean of their neighbors. Texels without known neighbors become
/// flat.
void fillFromNeighbors(TracedTexels& traced, const TextureShape& shape);

}  // namespace tspace
