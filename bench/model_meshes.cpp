// SPDX-License-Identifier: MIT
// Models as one mesh each, loaded by the readers of the asset layer.
#include <algorithm>
#include <exception>
#include <filesystem>
#include <iterator>
#include <map>
#include <tuple>

#include "mesh.h"
#include "model/gltf/load_document.h"
#include "model/gltf/primitive_reader.h"
#include "model/io/file_error.h"
#include "model/obj/obj_reader.h"
#include "model/read/read_scene.h"

namespace tspace::bench {

namespace {

std::vector<Mesh> gltfPrimitives(const std::string& path) {
    gltf::Document document = gltf::loadDocument(path, {});
    gltf::checkRequiredExtensions(document);
    std::vector<Mesh> meshes;
    for (const gltf::Primitive& primitive : gltf::readPrimitives(document)) {
        if (!gltf::hasTriangles(primitive.mode) || !primitive.find("NORMAL") || !primitive.find("TEXCOORD_0")) continue;
        meshes.push_back({.positions = gltf::readVec3(document, primitive, "POSITION"),
                          .normals = gltf::readVec3(document, primitive, "NORMAL"),
                          .uvs = gltf::readUvs(document, primitive, 0),
                          .indices = gltf::readTriangleCorners(document, primitive)});
    }
    return meshes;
}

Mesh gltfMesh(const std::string& path) {
    Mesh whole;
    for (const Mesh& mesh : gltfPrimitives(path)) {
        const auto first = static_cast<std::uint32_t>(whole.positions.size());
        const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
        append(whole.positions, mesh.positions);
        append(whole.normals, mesh.normals);
        append(whole.uvs, mesh.uvs);
        for (const std::uint32_t v : mesh.indices) whole.indices.push_back(first + v);
    }
    return whole;
}

Mesh objMesh(const std::string& path) {
    const obj::Model model = obj::readModel(path, {});
    Mesh mesh;
    std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> vertices;
    for (const obj::Corner& corner : model.corners) {
        const auto [at, is_new] = vertices.try_emplace({corner.position, corner.uv, corner.normal}, 0);
        if (is_new) {
            at->second = mesh.vertex(model.positions[corner.position],
                                     corner.normal == obj::kNone ? Vec3{} : model.normals[corner.normal],
                                     corner.uv == obj::kNone ? Vec2{} : model.uvs[corner.uv]);
        }
        mesh.indices.push_back(at->second);
    }
    for (const obj::Face& face : model.faces) mesh.face_sizes.push_back(face.corner_count);
    return mesh;
}

}  // namespace

Mesh modelMesh(const std::string& path) {
    try {
        return std::filesystem::path(path).extension() == ".obj" ? objMesh(path) : gltfMesh(path);
    } catch (const FileError&) {
        return {};
    }
}

std::vector<Mesh> modelPrimitives(const std::string& folder) {
    std::vector<std::string> paths;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const auto extension = entry.path().extension();
        if (extension == ".glb" || extension == ".gltf") paths.push_back(entry.path().string());
    }
    std::ranges::sort(paths);
    std::vector<Mesh> meshes;
    for (const std::string& path : paths) {
        try {
            std::ranges::move(gltfPrimitives(path), std::back_inserter(meshes));
        } catch (const FileError&) {
            // Some files are invalid by design: they are skipped.
        }
    }
    std::erase_if(meshes, [](const Mesh& mesh) { return mesh.triangleCount() == 0; });
    return meshes;
}

}  // namespace tspace::bench
