// SPDX-License-Identifier: MIT
// Detects maps in object space: tests whether their vectors are the normals of the mesh.
#pragma once

#include <span>

#include "commands/check/map_texels.h"

namespace tspace {

/// Returns whether the vectors are the normals of the mesh. `may_be_tangent`: they can also be in tangent space, which
/// is assumed in doubtful cases.
bool isOfMesh(std::span<const TexelOnSurface> surface, const MapLayout& layout, bool may_be_tangent);

/// Returns whether the vectors are the normals of the mesh, like isOfMesh, but for strong relief, which hides the mesh
/// in single vectors and lowers slopes. All quarters of the mesh must correlate, because a correlation by chance does
/// not occur in each of them.
bool isOfMeshUnderRelief(std::span<const TexelOnSurface> surface, const MapLayout& layout, bool may_be_tangent);

}  // namespace tspace
