// SPDX-License-Identifier: MIT
// Normals of a mesh that was deformed: the shape is the pose's, what is smooth and what is hard is the mesh's.
#pragma once

#include "tspace/normals.h"

namespace tspace {

/// As generateNormals on the mesh with these positions instead of its own, but which vertices are one point, and which
/// edges are hard by the crease angle, is decided by the mesh's own positions. So corners that share a normal on the
/// mesh for being smooth do so in every pose, and where nothing near a corner moves it gets the bits that it has on the
/// mesh.
///
/// positions   one per vertex of the mesh
/// Errors, complexity, memory and threads: as generateNormals.
Result<NormalReport> generatePoseNormals(const MeshView& mesh, const StridedSpan<const Vec3>& positions,
                                         const NormalOptions& options, StridedSpan<Vec3> out,
                                         const Execution& execution = {});

}  // namespace tspace
