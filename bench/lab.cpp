// SPDX-License-Identifier: MIT
// Meshes by name, and data shared by all rows.
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "job.h"
#include "rows.h"

namespace tspace::bench {

namespace {

/// Returns the number of triangles for a size such as "20k" or "8M", and 0 for other texts.
std::size_t trianglesOf(const std::string& size) {
    const std::size_t number = std::strtoul(size.c_str(), nullptr, 10);
    return size.ends_with("k") ? 1000 * number : size.ends_with("M") ? 1000000 * number : 0;
}

/// Returns a mesh without triangles if the name is unknown.
Mesh generatedMesh(const std::string& name) {
    const std::size_t first = name.find('_'), second = name.find('_', first + 1);
    if (first == std::string::npos) return {};
    const std::string shape = name.substr(0, first);
    const std::size_t triangles = trianglesOf(name.substr(first + 1, second - first - 1));
    if (triangles == 0) return {};
    Mesh mesh;
    if (shape == "torus" || shape == "soup") mesh = torusOf(triangles);
    if (shape == "sphere") mesh = sphereOf(triangles);
    if (shape == "grid") mesh = gridOf(triangles);
    if (shape == "quads") mesh = quadsOf(triangles);
    if (shape == "folds") mesh = foldsOf(triangles);
    if (second != std::string::npos) mesh = inOrder(std::move(mesh), name.substr(second + 1));
    return shape == "soup" ? unindexed(mesh) : mesh;
}

}  // namespace

const Mesh& Lab::mesh(const std::string& name) {
    std::unique_ptr<Mesh>& mesh = meshes_[name];
    if (!mesh) {
        if (name == "small") {
            mesh = std::make_unique<Mesh>(torus(20, 5, 10));
        } else {
            mesh = std::make_unique<Mesh>(std::filesystem::exists(name) ? modelMesh(name) : generatedMesh(name));
        }
    }
    return *mesh;
}

const Mesh& Lab::plainMesh(const std::string& name) {
    if (name.starts_with("soup_")) return mesh("torus_" + name.substr(5));
    const Mesh& whole = mesh(name);
    if (whole.face_sizes.empty() && whole.face_size == 3) return whole;
    std::unique_ptr<Mesh>& plain = plain_meshes_[name];
    if (!plain) plain = std::make_unique<Mesh>(whole.triangulated());
    return *plain;
}

const std::string& Lab::error(const std::string& job, const std::string& mesh_name) {
    const auto [at, is_new] = errors_.try_emplace(job + "/" + mesh_name);
    if (is_new) at->second = findError(job, mesh(mesh_name));
    return at->second;
}

const std::vector<Mesh>& Lab::primitives() {
    if (primitives_.empty()) primitives_ = modelPrimitives(shared("models"));
    return primitives_;
}

void Lab::forgetMeshes() {
    meshes_.clear();
    plain_meshes_.clear();
}

}  // namespace tspace::bench
