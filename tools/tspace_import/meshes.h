// SPDX-License-Identifier: MIT
// Converts Assimp's meshes to glTF primitives.
#pragma once

#include <assimp/scene.h>

#include <optional>
#include <vector>

#include "glb_builder.h"

namespace tspace::import {

/// Adds a primitive without its material; returns nullopt if the mesh has no triangles. `joints`: for each bone of the
/// mesh its index in the skin's list of joints; empty: no skin. `takes_tangents`: true if Assimp's tangents come from
/// the file, so they are written; otherwise they are dropped.
std::optional<Json> addPrimitive(GlbBuilder& builder, const aiMesh& mesh, const std::vector<std::uint16_t>& joints,
                                 bool takes_tangents);

}  // namespace tspace::import
