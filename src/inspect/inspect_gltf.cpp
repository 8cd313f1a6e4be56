// SPDX-License-Identifier: MIT
// What is in a glTF file.
#include <algorithm>

#include "asset/file_error.h"
#include "asset/gltf/accessor.h"
#include "asset/gltf/document.h"
#include "asset/gltf/material_needs.h"
#include "asset/gltf/primitive_reader.h"
#include "inspect/inspect.h"
#include "inspect/uv_map.h"

namespace tspace {
namespace {

using namespace gltf;

std::vector<std::string> readNames(const Json& root, const char* key) {
    std::vector<std::string> names;
    for (const Json& name : readArray(root, key, "", false)) {
        if (name.is_string()) names.push_back(name.get<std::string>());
    }
    return names;
}

std::string indexTypeName(const Document& document, const Primitive& primitive) {
    if (!primitive.indices) return "none";
    switch (readAccessor(document, *primitive.indices).component) {
        case ComponentType::u8:
            return "u8";
        case ComponentType::u16:
            return "u16";
        default:
            return "u32";
    }
}

void describeAttributes(const Document& document, const Primitive& primitive, PrimitiveInfo& info) {
    for (const auto& [name, accessor] : primitive.attributes) {
        info.attributes.push_back(name + " " + formatName(readAccessor(document, accessor)));
    }
    info.has_normals = primitive.find("NORMAL").has_value();
    info.has_tangents = primitive.find("TANGENT").has_value();
    info.skinned = primitive.find("JOINTS_0").has_value();
    while (primitive.find("TEXCOORD_" + std::to_string(info.uv_set_count))) ++info.uv_set_count;
}

/// False where the data lies in a compression extension or is not in the file at all.
bool hasTriangleData(const Document& document, const Primitive& primitive, const PrimitiveInfo& info) {
    if (!hasTriangles(primitive.mode) || primitive.has_draco || !primitive.find("POSITION")) return false;
    std::vector<std::size_t> needed = {*primitive.find("POSITION")};
    if (primitive.indices) needed.push_back(*primitive.indices);
    if (info.uv_set >= 0) needed.push_back(*primitive.find("TEXCOORD_" + std::to_string(info.uv_set)));
    return std::all_of(needed.begin(), needed.end(), [&](std::size_t accessor) {
        return hasData(document, readAccessor(document, accessor));
    });
}

/// Counts over the triangles; nothing where there is no data.
void describeTriangles(const Document& document, const Primitive& primitive, PrimitiveInfo& info) {
    if (!hasTriangleData(document, primitive, info)) return;
    // Positions first: they fail before a number of vertices without data costs any memory.
    const std::vector<Vec3> positions = readVec3(document, primitive, "POSITION");
    const std::vector<std::uint32_t> corners = readTriangleCorners(document, primitive);
    info.triangle_count = corners.size() / 3;
    std::vector<Vec2> uvs;
    if (info.uv_set >= 0) uvs = readUvs(document, primitive, static_cast<std::size_t>(info.uv_set));
    describeUvMap(corners, positions, uvs, true, info);
}

PrimitiveInfo describePrimitive(const Document& document, const Primitive& primitive) {
    PrimitiveInfo info;
    info.mesh = primitive.mesh;
    info.primitive = primitive.index;
    info.mesh_name = primitive.mesh_name;
    info.material_name = materialName(document, primitive);
    info.mode = modeName(primitive.mode);
    info.triangle_count = primitive.triangleCount();
    info.vertex_count = primitive.vertex_count;
    info.index_type = indexTypeName(document, primitive);
    info.morph_target_count = static_cast<std::uint32_t>(primitive.targets.size());
    describeAttributes(document, primitive, info);
    const TangentNeed need = tangentNeed(document, primitive);
    info.needs_tangents = need.needed() && hasTriangles(primitive.mode);
    info.needed_by = need.needed_by;
    if (primitive.find("TEXCOORD_" + std::to_string(need.uv_set))) {
        info.uv_set = static_cast<std::int32_t>(need.uv_set);
    }
    describeTriangles(document, primitive, info);
    return info;
}

std::uint32_t entryCount(const Document& document, const char* name) {
    return static_cast<std::uint32_t>(rootArray(document, name).size());
}

}  // namespace

Inspection inspectGltf(const std::string& input, const FileOptions& options) {
    const Document document = loadDocument(input, options);
    Inspection result;
    result.format = document.container == Container::glb ? "glb" : "gltf";
    if (const Json* asset = readObject(document.json, "asset", "")) {
        result.generator = readString(*asset, "generator", "/asset");
    }
    result.file_bytes = document.input_bytes;
    result.mesh_count = entryCount(document, "meshes");
    result.material_count = entryCount(document, "materials");
    result.node_count = entryCount(document, "nodes");
    result.animation_count = entryCount(document, "animations");
    result.image_count = entryCount(document, "images");
    result.extensions_used = readNames(document.json, "extensionsUsed");
    result.extensions_required = readNames(document.json, "extensionsRequired");
    checkRequiredExtensions(document);
    for (const Primitive& primitive : readPrimitives(document)) {
        result.primitives.push_back(describePrimitive(document, primitive));
    }
    return result;
}

}  // namespace tspace
