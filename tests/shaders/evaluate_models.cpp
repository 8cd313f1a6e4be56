// SPDX-License-Identifier: MIT
#include "evaluate_models.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "core/mesh/surface/affine.h"
#include "model/read/read_scene.h"
#include "support/shared_data.h"

namespace tspace::shaders {

namespace {

/// Returns the positions of the primitive, deformed by the weights and bones of `pose`.
std::vector<Vec3> deformed(const ScenePrimitive& primitive, const ScenePose& pose) {
    std::vector<Vec3> result(primitive.positions.begin(), primitive.positions.end());
    for (std::size_t v = 0; v < result.size(); ++v) {
        if (!pose.positions.empty()) result[v] = result[v] + pose.positions[v];
        if (!pose.bones.empty()) result[v] = toFloat(pose.bones[v].point(toDouble(result[v])));
    }
    return result;
}

/// Returns the primitive as a triangle mesh with normals and UVs, or a mesh without vertices if it lacks one of these.
test::SimpleMesh meshOf(const ScenePrimitive& primitive) {
    test::SimpleMesh mesh;
    const std::size_t set = primitive.uses.empty() ? 0 : primitive.uses[0].uv_set;
    if (primitive.corners.empty() || primitive.normals.empty() || set >= primitive.uv_sets.size() ||
        primitive.uv_sets[set].empty())
        return mesh;
    mesh.positions.assign(primitive.positions.begin(), primitive.positions.end());
    mesh.normals.assign(primitive.normals.begin(), primitive.normals.end());
    mesh.uvs.assign(primitive.uv_sets[set].begin(), primitive.uv_sets[set].end());
    mesh.indices.assign(primitive.corners.begin(), primitive.corners.end());
    return mesh;
}

std::size_t triangleLimit() {
    const char* const limit = std::getenv("TSPACE_MODEL_TRIANGLES");
    return limit == nullptr ? 1'000 : std::strtoull(limit, nullptr, 10);
}

}  // namespace

std::vector<std::string> sharedModels() {
    std::vector<std::string> paths;
    const std::filesystem::path folder = test::shared("models");
    if (!std::filesystem::exists(folder)) return paths;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension().string();
        if (extension == ".glb" || extension == ".gltf") paths.push_back(entry.path().string());
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

std::vector<PosedMesh> meshesOfModel(const std::string& path) {
    const PosedScene scene = readPosedScene(path, {}, false);
    std::vector<PosedMesh> meshes;
    for (std::size_t p = 0; p < scene.drawn.scene.primitives.size(); ++p) {
        const ScenePrimitive& primitive = scene.drawn.scene.primitives[p];
        test::SimpleMesh mesh = meshOf(primitive);
        if (mesh.positions.empty() || mesh.indices.size() / 3 > triangleLimit()) continue;
        PosedMesh posed =
            withBentPose(std::filesystem::path(path).filename().string() + primitive.place, std::move(mesh));
        for (const SceneMorphTarget& target : primitive.morph_targets) {
            if (!target.positions.empty())
                posed.poses.push_back(
                    deformed(primitive, {.positions = {target.positions.begin(), target.positions.end()}}));
        }
        for (std::size_t i = 0; i < scene.poses.size(); ++i) {
            if (scene.drawn.placements[i].primitive == p && !scene.poses[i].empty())
                posed.poses.push_back(deformed(primitive, scene.poses[i]));
        }
        meshes.push_back(std::move(posed));
    }
    return meshes;
}

}  // namespace tspace::shaders
