// SPDX-License-Identifier: MIT
#include "moved_meshes.h"

#include <algorithm>
#include <cmath>

namespace tspace::import {
namespace {

bool isFinite(const aiVector3D& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
DVec3 toDouble(const aiVector3D& v) { return {v.x, v.y, v.z}; }

}  // namespace

std::vector<aiVector3D> firstVertices(const aiScene& scene) {
    std::vector<aiVector3D> first(scene.mNumMeshes);
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        const aiMesh& mesh = *scene.mMeshes[m];
        const aiVector3D* const begin = mesh.mVertices;
        const aiVector3D* const end = begin + mesh.mNumVertices;
        const aiVector3D* const found = std::find_if(begin, end, [](const aiVector3D& v) { return isFinite(v); });
        if (found != end) first[m] = *found;
    }
    return first;
}

MovedMeshes movedMeshes(const aiScene& scene, const std::vector<aiVector3D>& first_vertices, const DVec3& offset) {
    const std::vector<aiVector3D> moved = firstVertices(scene);
    MovedMeshes meshes{.offset = offset};
    for (std::size_t m = 0; m < std::min(moved.size(), first_vertices.size()); ++m) {
        const DVec3 move = toDouble(first_vertices[m]) - toDouble(moved[m]);
        meshes.is_moved.push_back(dot(move, offset) > dot(offset, offset) / 2);
    }
    return meshes;
}

}  // namespace tspace::import
