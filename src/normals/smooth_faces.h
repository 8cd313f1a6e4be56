// SPDX-License-Identifier: MIT
// Normals of any mesh: faces of any size, hard edges, all weightings.
#pragma once

#include "core/parallel.h"
#include "tspace/normals.h"

namespace tspace {

/// The result of generateNormals; with `posed`, the same mesh with other positions, that of generatePoseNormals. The
/// mesh has been checked. Range by range of points, with a list of the corners around each. Scratch memory: 4 bytes per
/// vertex, core/range_lists.h, faces.h where faces differ in size, and for each task 150 bytes per triangle of a range,
/// which are an eighth of a small mesh and about 8000 of a large one; for `best` also 28 bytes per corner. While
/// vertices are welded 10 to 24 bytes per vertex. Throws OutOfMemory.
NormalReport smoothFaces(const MeshView& mesh, const MeshView& posed, const NormalOptions& options,
                         StridedSpan<Vec3> out, Parallel& parallel);

}  // namespace tspace
