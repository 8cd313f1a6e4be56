// SPDX-License-Identifier: MIT
// Applies the result of near_origin/ to Assimp's scene, whose numbers are floats.
#pragma once

#include <assimp/scene.h>

#include <vector>

#include "core/base/vec_math.h"

namespace tspace::import {

/// Meshes from whose coordinates an offset was subtracted.
struct MovedMeshes {
    DVec3 offset = {};
    std::vector<bool> is_moved = {};  ///< one per mesh; empty: none moved

    [[nodiscard]] bool isMoved(unsigned mesh) const { return mesh < is_moved.size() && is_moved[mesh]; }
};

/// Returns the first finite vertex of each mesh.
std::vector<aiVector3D> firstVertices(const aiScene& scene);

/// Returns which meshes of `scene`, which was read from NearFile::bytes, were moved. Their first vertices are compared
/// with those of the original scene, because one geometry of the file may become several meshes.
MovedMeshes movedMeshes(const aiScene& scene, const std::vector<aiVector3D>& first_vertices, const DVec3& offset);

}  // namespace tspace::import
