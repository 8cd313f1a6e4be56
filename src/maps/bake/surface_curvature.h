// SPDX-License-Identifier: MIT
// The mean curvature of a mesh at its vertices.
#pragma once

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "tspace/maps.h"

namespace tspace {

/// One per vertex, in 1 / length; that of a sphere of radius r is 1 / r, and 0 where no triangle has an area. Normals are those of the
/// mesh, or of its triangles where it has none, all of one position as one, by the angles of the corners: across a hard edge the
/// surface bends within the triangles at both sides of it. Linear, but for the search for equal positions.
/// weld_distance: which positions are one (NormalOptions::weld_distance).
Buffer<float> vertexCurvature(const HighPoly& mesh, float weld_distance, Parallel& parallel,
                              const Allocator* allocator);

}  // namespace tspace
