// SPDX-License-Identifier: MIT
// What near_origin/ says about a file, found again in Assimp's scene, whose numbers are floats.
#pragma once

#include <assimp/scene.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "near_origin/near_origin.h"

namespace tspace::import {

/// Meshes whose coordinates an offset was taken out of.
struct MovedMeshes {
    DVec3 offset = {};
    std::vector<bool> is_moved = {};  ///< by mesh; empty: none
    bool has_skin = false;            ///< of a mesh that is moved: its joints' matrices would have the offset in floats

    [[nodiscard]] bool isMoved(unsigned mesh) const { return mesh < is_moved.size() && is_moved[mesh]; }
};

/// Of each mesh, the first vertex that is finite.
std::vector<aiVector3D> firstVertices(const aiScene& scene);

/// Which meshes of the scene of NearFile are moved, by the first vertices of the scene of the file as it was: one geometry is
/// one or several meshes.
MovedMeshes movedMeshes(const aiScene& scene, const std::vector<aiVector3D>& first_vertices, const DVec3& offset);

/// Translations of nodes in double, of FBX and COLLADA: those in the file whose floats are the node's.
class ExactTranslations {
  public:
    /// Looks into the file only where the scene has a far node: its translation is so large that floats are further apart
    /// than a thousandth of a unit.
    ExactTranslations(const aiScene& scene, const std::string& path);

    /// Null where the node is not far, where the file has none, and where it has several with the same floats which differ,
    /// and not one of them is that of this name.
    [[nodiscard]] const DVec3* of(const aiNode& node) const;

  private:
    using Floats = std::array<float, 3>;

    struct Found {
        DVec3 translation = {};
        bool is_clear = true;  ///< all that were found are the same
    };

    std::map<Floats, Found> by_floats_ = {};
    std::map<std::pair<Floats, std::string>, Found> by_name_ = {};
};

}  // namespace tspace::import
