// SPDX-License-Identifier: MIT
// Assimp's meshes as glTF primitives.
#pragma once

#include <assimp/scene.h>

#include <optional>
#include <vector>

#include "glb_builder.h"

namespace tspace::import {

/// A primitive without its material; nothing where the mesh has no triangles.
/// `joints`: for each bone of the mesh its place in the skin's list of joints; empty: no skin. `takes_tangents`: those
/// that the mesh has are those of the file.
std::optional<Json> addPrimitive(GlbBuilder& builder, const aiMesh& mesh, const std::vector<std::uint16_t>& joints,
                                 bool takes_tangents);

}  // namespace tspace::import
