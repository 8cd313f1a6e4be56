// SPDX-License-Identifier: MIT
#include "moved_meshes.h"

#include <algorithm>
#include <cmath>

namespace tspace::import {

namespace {

bool isFinite(const aiVector3D& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
DVec3 toDouble(const aiVector3D& v) { return {v.x, v.y, v.z}; }

aiVector3D translationOf(const aiNode& node) {
    return {node.mTransformation.a4, node.mTransformation.b4, node.mTransformation.c4};
}

/// Floats of this size are 1/512 apart.
constexpr double kFar = 1 << 14;

bool isFar(const aiNode& node) {
    const aiVector3D place = translationOf(node);
    return isFinite(place) && length(toDouble(place)) >= kFar;
}

bool hasFarNode(const aiScene& scene) {
    std::vector<const aiNode*> nodes = {scene.mRootNode};
    while (!nodes.empty()) {
        const aiNode& node = *nodes.back();
        nodes.pop_back();
        if (isFar(node)) return true;
        nodes.insert(nodes.end(), node.mChildren, node.mChildren + node.mNumChildren);
    }
    return false;
}

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
        meshes.has_skin = meshes.has_skin || (meshes.is_moved.back() && scene.mMeshes[m]->HasBones());
    }
    return meshes;
}

ExactTranslations::ExactTranslations(const aiScene& scene, const std::string& path) {
    if (!hasFarNode(scene)) return;
    const auto add = [](auto& found, const auto& key, const DVec3& translation) {
        const auto [entry, is_new] = found.try_emplace(key, Found{translation});
        if (!is_new && length(entry->second.translation - translation) > 0) entry->second.is_clear = false;
    };
    for (const ExactPlace& place : exactPlaces(path)) {
        const DVec3& t = place.translation;
        if (!std::isfinite(length(t)) || length(t) < kFar / 2) continue;
        const Floats floats = {static_cast<float>(t.x), static_cast<float>(t.y), static_cast<float>(t.z)};
        add(by_floats_, floats, t);
        add(by_name_, std::pair(floats, place.id), t);
        if (place.name != place.id) add(by_name_, std::pair(floats, place.name), t);
    }
}

const DVec3* ExactTranslations::of(const aiNode& node) const {
    if (by_floats_.empty() || !isFar(node)) return nullptr;
    const aiVector3D rounded = translationOf(node);
    const Floats floats = {rounded.x, rounded.y, rounded.z};
    const auto named = by_name_.find({floats, node.mName.C_Str()});
    if (named != by_name_.end() && named->second.is_clear) return &named->second.translation;
    const auto any = by_floats_.find(floats);
    return any != by_floats_.end() && any->second.is_clear ? &any->second.translation : nullptr;
}

}  // namespace tspace::import
