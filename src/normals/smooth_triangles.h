// SPDX-License-Identifier: MIT
// The common case by a shorter way: triangles without hard edges, where a point has one normal.
#pragma once

#include <cstdint>

#include "core/memory.h"
#include "core/parallel.h"
#include "tspace/normals.h"

namespace tspace {

/// Whether smoothTriangles does this: a mesh of triangles, all weightings but flat and max, no crease, no groups.
bool canSmoothTriangles(const MeshView& mesh, const NormalOptions& options);

/// The result of generateNormals, or with other positions than the mesh's that of generatePoseNormals. The mesh has
/// been checked. Scratch memory: 4 bytes per vertex, core/range_lists.h and 512 KB, or up to 2 MB for each of several
/// threads; where triangles that follow one another are far apart 36 bytes per vertex; for `best` 68, and
/// core/sum_rounds.h. While vertices are welded 10 to 24. Throws OutOfMemory.
NormalReport smoothTriangles(const MeshView& mesh, const StridedSpan<const Vec3>& positions,
                             const NormalOptions& options, StridedSpan<Vec3> out, Parallel& parallel);

}  // namespace tspace
