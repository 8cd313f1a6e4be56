// SPDX-License-Identifier: MIT
// Assimp's materials as glTF materials: colours, and the textures that matter for frames.
#pragma once

#include <assimp/scene.h>

#include "glb_builder.h"

namespace tspace::import {

/// All materials, in their order, with their textures and images.
void addMaterials(GlbBuilder& builder, const aiScene& scene);

}  // namespace tspace::import
