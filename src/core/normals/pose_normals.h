// SPDX-License-Identifier: MIT
// Normals of a mesh that was deformed: the shape is the pose's, what is smooth and what is hard is the mesh's.
#pragma once

#include "tspace/normals.h"

namespace tspace {

/// generateNormals with other positions. The mesh's own positions still decide which vertices are one point and which
/// edges are hard by the crease angle. So corners that share a normal on the mesh share it in every pose, and a normal
/// near which nothing moves has the bits that it has on the mesh.
///
/// positions   one per vertex of the mesh
/// Errors, complexity, memory and threads: as generateNormals.
Result<NormalReport> generatePoseNormals(const MeshView& mesh, const StridedSpan<const Vec3>& positions,
                                         const NormalOptions& options, StridedSpan<Vec3> out,
                                         const Execution& execution = {});

/// Finds which corners share one normal, in all poses: per corner the lowest such corner, or kNoSharedNormal where the corner
/// adds nothing to the mean because its face visits the point twice. Weighting flat: each corner has its own.
/// Errors: as generateNormals, and invalidOption for faces that are not triangles.
inline constexpr std::uint32_t kNoSharedNormal = 0x80000000u;  ///< a flag beside the corner
Result<std::vector<std::uint32_t>> findSharedNormals(const MeshView& mesh, const NormalOptions& options,
                                                     const Execution& execution = {});

}  // namespace tspace
