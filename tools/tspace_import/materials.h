// SPDX-License-Identifier: MIT
// Converts Assimp's materials to glTF materials: colors, and the textures that matter for frames.
#pragma once

#include <assimp/scene.h>

#include "glb_builder.h"

namespace tspace::import {

/// Adds all materials, in order, with their textures and images.
void addMaterials(GlbBuilder& builder, const aiScene& scene);

}  // namespace tspace::import
