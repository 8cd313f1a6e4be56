// SPDX-License-Identifier: MIT
// NormalWeighting::best where every point has one normal: triangles without hard edges.
#pragma once

#include "core/memory.h"
#include "core/parallel.h"
#include "tspace/normals.h"

namespace tspace::smooth {

/// From the means by angle * area to the normals of `best`, in place.
///
/// positions  of the pose, one per vertex
/// points     the point of each vertex; empty when each is its own
/// normals    eight floats per point: the unit mean, and a fourth number whose sign bit is set where it vanished;
///            such points, and those whose mean by `max` vanishes, stay as they are
///
/// Scratch memory: 32 bytes per vertex, up to 1 MB per task, and what RangeLists takes. Linear. Throws OutOfMemory.
void refineTriangles(const MeshView& mesh, const StridedSpan<const Vec3>& positions,
                     const Buffer<std::uint32_t>& points, const NormalOptions& options, float* normals,
                     Parallel& parallel);

}  // namespace tspace::smooth
