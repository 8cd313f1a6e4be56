// SPDX-License-Identifier: MIT
// What is in an OBJ file, as it would be in a glTF made from it.
#include <set>

#include "commands/inspect/inspect.h"
#include "commands/inspect/uv_map.h"
#include "commands/shared/noted_noise.h"
#include "model/io/file_error.h"
#include "model/obj/obj_primitives.h"
#include "model/obj/obj_reader.h"
#include "tspace/triangulate.h"

namespace tspace {
namespace {

using namespace obj;

PrimitiveInfo describePrimitive(const obj::Model& model, const ObjPrimitive& primitive) {
    const ObjGeometry geometry = buildGeometry(model, primitive);
    const Material& material = model.materials[primitive.material];
    PrimitiveInfo info;
    info.mesh = primitive.shape;
    info.mesh_name = model.shape_names[primitive.shape];
    info.material_name = material.name;
    info.mode = geometry.polygons.face_sizes.empty() ? "triangles" : "polygons";
    info.vertex_count = geometry.pool.positions.size();
    info.index_type = "none";
    info.compression = "none";
    info.attributes.push_back("POSITION float3");
    info.has_normals = !geometry.pool.normals.empty();
    if (info.has_normals) info.attributes.push_back("NORMAL float3");
    if (primitive.has_uvs) info.attributes.push_back("TEXCOORD_0 float2");
    info.uv_set_count = primitive.has_uvs ? 1 : 0;
    info.uv_set = primitive.has_uvs ? 0 : -1;
    info.needs_tangents = material.normal_texture.used();
    if (info.needs_tangents) {
        info.needed_by = "normalTexture";
        info.tangent_uses.push_back({.needed_by = info.needed_by, .material = primitive.material});
    }
    info.node_count = 1;
    info.instance_count = 1;
    const Triangulation triangles = valueOrThrow(triangulate(geometry.view()));
    std::vector<std::uint32_t> corners;
    corners.reserve(triangles.corners.size());
    for (const std::uint32_t corner : triangles.corners) corners.push_back(geometry.polygons.indices[corner]);
    info.triangle_count = corners.size() / 3;
    describeUvMap(corners, geometry.pool.positions, geometry.pool.uvs, true, info);
    MeshView cut;  // as check measures it
    cut.positions = std::span(geometry.pool.positions);
    cut.indices = IndexView(std::span(corners));
    if (model.memory->has(noteMemory(cut))) info.position_noise = notedNoise(cut, 0);
    return info;
}

std::uint32_t imageCount(const obj::Model& model) {
    std::set<std::string> files;
    for (const Material& material : model.materials) {
        for (const Texture* texture : {&material.base_color_texture, &material.normal_texture}) {
            if (texture->used()) files.insert((texture->folder / texture->file).string());
        }
    }
    return static_cast<std::uint32_t>(files.size());
}

}  // namespace

Inspection inspectObj(const std::string& input, const FileOptions& options) {
    const obj::Model model = readModel(input, options);
    Inspection result;
    result.format = "obj";
    result.file_bytes = model.input_bytes;
    result.mesh_count = static_cast<std::uint32_t>(model.shape_names.size());
    for (const Material& material : model.materials) result.material_count += material.found;
    result.image_count = imageCount(model);
    result.warnings = model.warnings;
    result.coordinate_offset[0] = model.offset.x;
    result.coordinate_offset[1] = model.offset.y;
    result.coordinate_offset[2] = model.offset.z;
    std::vector<std::uint32_t> next_in_mesh(model.shape_names.size(), 0);
    for (const ObjPrimitive& primitive : collectPrimitives(model)) {
        PrimitiveInfo info = describePrimitive(model, primitive);
        info.primitive = next_in_mesh[primitive.shape]++;
        result.primitives.push_back(std::move(info));
    }
    return result;
}

}  // namespace tspace
