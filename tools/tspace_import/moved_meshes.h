// SPDX-License-Identifier: MIT
// What near_origin/ says about a file, found again in Assimp's scene, whose numbers are floats.
#pragma once

#include <assimp/scene.h>

#include <vector>

#include "core/base/vec_math.h"

namespace tspace::import {

/// Meshes whose coordinates an offset was taken out of.
struct MovedMeshes {
    DVec3 offset = {};
    std::vector<bool> is_moved = {};  ///< by mesh; empty: none

    [[nodiscard]] bool isMoved(unsigned mesh) const { return mesh < is_moved.size() && is_moved[mesh]; }
};

/// First finite vertex of each mesh.
std::vector<aiVector3D> firstVertices(const aiScene& scene);

/// Which meshes of the scene of NearFile are moved, by the first vertices of the scene of the file as it was: one geometry is
/// one or several meshes.
MovedMeshes movedMeshes(const aiScene& scene, const std::vector<aiVector3D>& first_vertices, const DVec3& offset);

}  // namespace tspace::import
