// SPDX-License-Identifier: MIT
// Traces the layers of a bake (see tspace/maps.h).
#pragma once

#include "maps/error/measure_points.h"
#include "maps/layout/texel_triangles.h"
#include "tspace/maps.h"

namespace tspace {

/// Checks the layer options for meshes with the given numbers of triangles; `options` must have been checked before.
/// Returns ErrorCode::ok if they are valid.
Error checkLayers(const LayerOptions& layers, const BakeOptions& options, std::size_t low_triangles,
                  std::size_t high_triangles);

/// Traces the layers; returns one entry per requested layer. Requires checked meshes and options.
std::vector<BakedLayer> traceLayers(const MapSurfaces& surfaces, const TexelTriangles& triangles,
                                    const BakeOptions& options, const LayerOptions& layers, const MapWork& work);

}  // namespace tspace
