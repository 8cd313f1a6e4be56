// SPDX-License-Identifier: MIT
// Models as one mesh each, through the readers of the asset layer.
#include <exception>
#include <filesystem>
#include <map>
#include <tuple>

#include "asset/file_error.h"
#include "asset/gltf/primitive_reader.h"
#include "asset/obj/obj_reader.h"
#include "mesh.h"

namespace tspace::bench {

namespace {

Mesh gltfMesh(const std::string& path) {
    gltf::Document document = gltf::loadDocument(path, {});
    gltf::checkRequiredExtensions(document);
    Mesh mesh;
    for (const gltf::Primitive& primitive : gltf::readPrimitives(document)) {
        if (!gltf::hasTriangles(primitive.mode) || !primitive.find("NORMAL") || !primitive.find("TEXCOORD_0")) continue;
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
        append(mesh.positions, gltf::readVec3(document, primitive, "POSITION"));
        append(mesh.normals, gltf::readVec3(document, primitive, "NORMAL"));
        append(mesh.uvs, gltf::readUvs(document, primitive, 0));
        for (const std::uint32_t v : gltf::readTriangleCorners(document, primitive)) mesh.indices.push_back(first + v);
    }
    return mesh;
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

}  // namespace tspace::bench
