// SPDX-License-Identifier: MIT
#include "map_files/map_mesh.h"

#include <algorithm>

#include "asset/file_error.h"
#include "asset/read/read_scene.h"
#include "check/uv_reading.h"
#include "tspace/indexed_frames.h"

namespace tspace {

namespace {

/// A name of an image as a person knows it: without folders and ending.
std::string stemOf(const std::string& name) {
    const std::size_t folder = name.find_last_of("/\\");
    const std::string file = folder == std::string::npos ? name : name.substr(folder + 1);
    return file.substr(0, file.find_last_of('.'));
}

bool showsNormals(const TangentUse& use) { return use.needed_by != "anisotropy"; }

/// How a primitive shows the map, where it does.
const TangentUse* useOfImage(const Scene& scene, const ScenePrimitive& primitive, const std::string& stem) {
    for (const TangentUse& use : primitive.uses) {
        if (!use.image || !showsNormals(use)) continue;
        const SceneImage& image = scene.images[*use.image];
        if (!stem.empty() && (stemOf(image.uri) == stem || stemOf(image.name) == stem)) return &use;
    }
    return nullptr;
}

const TangentUse* firstNormalMap(const ScenePrimitive& primitive) {
    for (const TangentUse& use : primitive.uses) {
        if (showsNormals(use)) return &use;
    }
    return nullptr;
}

struct ChosenPrimitive {
    const ScenePrimitive* primitive = nullptr;
    const TangentUse* use = nullptr;  ///< null: the first UVs, as they are
};

std::vector<ChosenPrimitive> choosePrimitives(const Scene& scene, const MapMeshChoice& choice) {
    const std::string stem = stemOf(choice.image_name);
    const bool by_image = choice.material.empty() &&
                          std::any_of(scene.primitives.begin(), scene.primitives.end(), [&](const auto& primitive) {
                              return useOfImage(scene, primitive, stem) != nullptr;
                          });
    std::vector<ChosenPrimitive> chosen;
    for (const ScenePrimitive& primitive : scene.primitives) {
        if (!choice.material.empty() && primitive.material_name != choice.material) continue;
        const TangentUse* use = useOfImage(scene, primitive, stem);
        if (by_image && use == nullptr) continue;
        if (use == nullptr) use = firstNormalMap(primitive);
        const std::size_t set = use == nullptr ? 0 : use->uv_set;
        if (primitive.corners.empty() || set >= primitive.uv_sets.size() || primitive.uv_sets[set].empty()) continue;
        chosen.push_back({&primitive, use});
    }
    return chosen;
}

template <class T>
void gatherCorners(std::span<const T> from, std::span<const std::uint32_t> indices, std::vector<T>& to) {
    to.reserve(to.size() + indices.size());
    for (const std::uint32_t index : indices) to.push_back(from[index]);
}

void addFrames(const ScenePrimitive& primitive, std::span<const Vec2> uvs, const TangentOptions& options,
               MapMesh& mesh) {
    if (!primitive.normals.empty() && !primitive.tangents.empty()) {
        gatherCorners(primitive.normals.span(), primitive.corners.span(), mesh.normals);
        gatherCorners(primitive.tangents.span(), primitive.corners.span(), mesh.tangents);
        return;
    }
    const MeshView view{.positions = primitive.positions.span(),
                        .normals = primitive.normals.span(),
                        .uvs = uvs,
                        .indices = primitive.corners.span()};
    IndexedFramesOptions frames{.tangents = options, .normals = {.weighting = NormalWeighting::flat}};
    const IndexedFrames made = valueOrThrow(makeIndexedFrames(view, frames));
    gatherCorners(std::span<const Vec3>(made.normals), made.indices, mesh.normals);
    gatherCorners(std::span<const Vec4>(made.tangents), made.indices, mesh.tangents);
    mesh.report.tangents_made = true;
}

}  // namespace

MapMesh readMapMesh(const std::string& model, const MapMeshChoice& choice, const TangentOptions& tangents,
                    const FileOptions& file) {
    const Scene scene = readScene(model, file, false);
    const std::vector<ChosenPrimitive> chosen = choosePrimitives(scene, choice);
    if (chosen.empty()) {
        const std::string which =
            choice.material.empty() ? std::string() : " of the material " + inQuotes(choice.material);
        failFile(ErrorCode::invalidFile, "the model has no triangles" + which + " with the UVs of a normal map");
    }
    MapMesh mesh;
    if (chosen.front().use != nullptr) {
        mesh.wrap_u = chosen.front().use->wrap_u;
        mesh.wrap_v = chosen.front().use->wrap_v;
    }
    constexpr std::size_t kCornerBytes = sizeof(Vec2) + 2 * sizeof(Vec3) + sizeof(Vec4);
    for (const auto& [primitive, use] : chosen) {
        scene.memory->take(4 * kCornerBytes * primitive->corners.size(), primitive->place);
        const UvTransform transform = use == nullptr ? UvTransform{} : use->transform;
        const std::vector<Vec2> uvs =
            textureUvs(primitive->uv_sets[use == nullptr ? 0 : use->uv_set].span(), transform);
        addFrames(*primitive, uvs, tangents, mesh);
        gatherCorners(std::span<const Vec2>(uvs), primitive->corners.span(), mesh.uvs);
        gatherCorners(primitive->positions.span(), primitive->corners.span(), mesh.positions);
        std::vector<std::string>& materials = mesh.report.materials;
        if (std::find(materials.begin(), materials.end(), primitive->material_name) == materials.end()) {
            materials.push_back(primitive->material_name);
        }
    }
    mesh.report.primitive_count = static_cast<std::uint32_t>(chosen.size());
    mesh.report.triangle_count = mesh.uvs.size() / 3;
    return mesh;
}

}  // namespace tspace
