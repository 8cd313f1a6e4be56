// SPDX-License-Identifier: MIT
// The layers of a map, traced: see tspace/maps.h.
#pragma once

#include "maps/error/measure_points.h"
#include "maps/layout/texel_triangles.h"
#include "tspace/maps.h"

namespace tspace {

/// Checks options for meshes of so many triangles, `options` being checked. An Error with code ok when all is well.
Error checkLayers(const LayerOptions& layers, const BakeOptions& options, std::size_t low_triangles,
                  std::size_t high_triangles);

/// Meshes and options must be checked. Returns one entry per requested layer.
std::vector<BakedLayer> traceLayers(const MapSurfaces& surfaces, const TexelTriangles& triangles,
                                    const BakeOptions& options, const LayerOptions& layers, const MapWork& work);

}  // namespace tspace
