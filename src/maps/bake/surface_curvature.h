// SPDX-License-Identifier: MIT
// Mean curvature at the vertices of a mesh.
#pragma once

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "tspace/maps.h"

namespace tspace {

/// Returns the mean curvature of each vertex, in 1 / length: 1 / r for a sphere of radius r, and 0 if all its triangles
/// are degenerate. Uses the normals of the mesh, or triangle normals if it has none, averaged per position with angle
/// weights, so that at a hard edge the surface bends within the triangles on both sides. Linear time, except for the
/// search for equal positions. weld_distance: distance up to which positions are welded (NormalOptions::weld_distance).
Buffer<float> vertexCurvature(const HighPoly& mesh, float weld_distance, Parallel& parallel,
                              const Allocator* allocator);

}  // namespace tspace
