// SPDX-License-Identifier: MIT
// Normals of a deformed mesh: the pose provides the shape, the mesh the smooth and hard edges.
#pragma once

#include "tspace/normals.h"

namespace tspace {

/// Computes generateNormals for other positions. The mesh's own positions still determine welded vertices and hard
/// edges (by the crease angle). Corners that share a normal on the mesh therefore share it in every pose, and a normal
/// whose surroundings do not move keeps its bits.
///
/// positions   one per vertex of the mesh
/// Errors, complexity, memory and threads: those of generateNormals.
Result<NormalReport> generatePoseNormals(const MeshView& mesh, const StridedSpan<const Vec3>& positions,
                                         const NormalOptions& options, StridedSpan<Vec3> out,
                                         const Execution& execution = {});

/// Flag of a corner that does not contribute to the mean because its face visits the point twice (findSharedNormals).
inline constexpr std::uint32_t kNoSharedNormal = 0x80000000u;

/// Finds the corners that share one normal in all poses. Returns for each corner the lowest such corner, with the flag
/// kNoSharedNormal if the corner does not contribute to the mean. With weighting flat, every corner is separate.
/// Errors: those of generateNormals, and invalidOption for faces that are not triangles.
Result<std::vector<std::uint32_t>> findSharedNormals(const MeshView& mesh, const NormalOptions& options,
                                                     const Execution& execution = {});

}  // namespace tspace
