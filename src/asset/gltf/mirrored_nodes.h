// SPDX-License-Identifier: MIT
// Which meshes are drawn mirrored: by a node whose transform, with those above it, has a negative determinant.
#pragma once

#include <vector>

#include "asset/gltf/document.h"

namespace tspace::gltf {

/// One entry per mesh. Nodes that skins move count as not mirrored: glTF ignores their transform. Nodes in a cycle are
/// left out. Linear in the nodes and in the instances of EXT_mesh_gpu_instancing.
std::vector<bool> findMirroredMeshes(const Document& document);

}  // namespace tspace::gltf
