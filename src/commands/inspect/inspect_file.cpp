// SPDX-License-Identifier: MIT
// inspectFile: lists the contents of a glTF or OBJ file; its report as JSON.
#include <algorithm>
#include <set>
#include <vector>

#include "commands/inspect/inspect.h"
#include "commands/inspect/inspect_report.h"
#include "commands/shared/reportable_noise.h"
#include "core/mesh/surface/uvs.h"
#include "model/gltf/accessor.h"
#include "model/gltf/draco_primitives.h"
#include "model/gltf/load_document.h"
#include "model/gltf/material_needs.h"
#include "model/gltf/meshopt_views.h"
#include "model/gltf/nodes.h"
#include "model/gltf/packed_frames.h"
#include "model/gltf/primitive_reader.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/obj/obj_primitives.h"
#include "model/obj/obj_reader.h"
#include "model/read/read_scene.h"

namespace tspace {

// UV islands and their orientation.

void describeUvMap(std::span<const std::uint32_t> corners, std::span<const Vec3> positions, std::span<const Vec2> uvs,
                   bool v_runs_down, PrimitiveInfo& info) {
    const std::size_t triangle_count = corners.size() / 3;
    for (std::size_t i = 0; i < triangle_count; ++i) {
        const Vec3& a = positions[corners[3 * i]];
        const Vec3& b = positions[corners[3 * i + 1]];
        const Vec3& c = positions[corners[3 * i + 2]];
        info.degenerate_triangle_count += a == b || b == c || c == a;
    }
    if (uvs.empty()) return;

    const UvIslands islands = findUvIslands(corners, positions, uvs);
    info.uv_island_count = islands.count;
    std::vector<double> island_area(islands.count, 0.0);
    for (std::size_t i = 0; i < triangle_count; ++i) {
        const double area =
            signedUvArea(uvs[corners[3 * i]], uvs[corners[3 * i + 1]], uvs[corners[3 * i + 2]], v_runs_down);
        // NaN and infinity count as zero area, because they define no direction.
        if (!(area < 0 || area > 0) || area - area != 0) {
            ++info.degenerate_uv_count;
            continue;
        }
        info.mirrored_triangle_count += area < 0;
        island_area[islands.island_of[i]] += area;
    }
    for (const double area : island_area) info.mirrored_island_count += area < 0;
}

namespace {

// Contents of a glTF file.

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
        case ComponentType::u8: return "u8";
        case ComponentType::u16: return "u16";
        default: return "u32";
    }
}

const char* compressionName(const Document& document, const Primitive& primitive) {
    const Json& json = document.json["meshes"][primitive.mesh]["primitives"][primitive.index];
    if (findExtension(json, kDraco) != nullptr) return "draco";
    for (const auto& [name, accessor] : primitive.attributes) {
        const auto view = readAccessor(document, accessor).view;
        if (view && meshoptExtension(rootArray(document, "bufferViews")[*view]) != nullptr) return "meshopt";
    }
    return "none";
}

void describeAttributes(const Document& document, const Primitive& primitive, PrimitiveInfo& info) {
    for (const auto& [name, accessor] : primitive.attributes)
        info.attributes.push_back(name + " " + formatName(readAccessor(document, accessor)));
    for (const auto& [name, accessor] : primitive.miscounted) {
        const Accessor found = readAccessor(document, accessor);
        info.attributes.push_back(name + " " + formatName(found) + " of " + std::to_string(found.count) + " elements");
    }
    for (const UnreadableTangents& tangents : primitive.unreadable_tangents) {
        if (tangents.target >= 0) continue;
        const Accessor found = readAccessor(document, tangents.accessor);
        info.attributes.push_back("TANGENT " + formatName(found) + " of " + std::to_string(found.count) + " elements");
    }
    for (const AttributeFault& fault : primitive.attribute_faults) {
        if (fault.target >= 0) continue;
        const Accessor found = readAccessor(document, fault.accessor);
        info.attributes.push_back(fault.name + " " + formatName(found) + " of " + std::to_string(found.count) +
                                  " elements");
    }
    for (const StoredPacking& packing : findPacked(document, primitive)) {
        if (packing.fault.empty()) info.packed_frames.push_back(packing.layout->format);
    }
    info.has_normals = primitive.find("NORMAL").has_value();
    info.has_tangents = primitive.find("TANGENT").has_value();
    info.tangents_not_read = !info.has_tangents && document.may_hide_tangents;
    info.skinned = primitive.find("JOINTS_0").has_value() ||
                   std::any_of(primitive.attribute_faults.begin(), primitive.attribute_faults.end(),
                               [](const AttributeFault& fault) { return fault.name == "JOINTS_0"; });
    while (primitive.find("TEXCOORD_" + std::to_string(info.uv_set_count))) ++info.uv_set_count;
}

/// Returns false if the data uses a compression that this build cannot decode, or is not in the file.
bool hasTriangleData(const Document& document, const Primitive& primitive, const PrimitiveInfo& info) {
    if (!hasTriangles(primitive.mode) || !primitive.find("POSITION")) return false;
    std::vector<std::size_t> needed = {*primitive.find("POSITION")};
    if (primitive.indices) needed.push_back(*primitive.indices);
    if (info.uv_set >= 0) needed.push_back(*primitive.find("TEXCOORD_" + std::to_string(info.uv_set)));
    return std::all_of(needed.begin(), needed.end(),
                       [&](std::size_t accessor) { return hasData(document, readAccessor(document, accessor)); });
}

/// Fills the counts of triangles, if there is triangle data.
void describeTriangles(const Document& document, const Primitive& primitive, bool is_mirrored, PrimitiveInfo& info) {
    if (!hasTriangleData(document, primitive, info)) return;
    const std::uint64_t bytes =
        std::uint64_t{72} * primitive.triangleCount() + std::uint64_t{64} * primitive.vertex_count;
    document.memory->require(bytes, primitive.place());
    // Positions are read first, so that a file that declares more vertices than it has data for is rejected before
    // memory is allocated for them.
    const std::vector<Vec3> positions = readVec3(document, primitive, "POSITION");
    const std::vector<std::uint32_t> corners = readTriangleCorners(document, primitive);
    info.triangle_count = corners.size() / 3;
    std::vector<Vec2> uvs;
    if (info.uv_set >= 0) uvs = readUvs(document, primitive, static_cast<std::size_t>(info.uv_set));
    describeUvMap(corners, positions, uvs, !is_mirrored, info);
    MeshView triangles;
    triangles.positions = std::span(positions);
    triangles.indices = IndexView(std::span(corners));
    if (document.memory->has(bytes + reportableNoiseMemory(triangles)))
        info.position_noise = reportableNoise(triangles, stepOf(readAccessor(document, *primitive.find("POSITION"))));
}

void describeUses(const std::vector<TangentUse>& uses, PrimitiveInfo& info) {
    if (!uses.empty()) info.needed_by = uses[0].needed_by;
    for (const TangentUse& use : uses) {
        TangentUseInfo& entry = info.tangent_uses.emplace_back();
        entry.needed_by = use.needed_by;
        entry.place = use.place;
        entry.material = static_cast<std::uint32_t>(use.material);
        entry.material_name = use.material_name;
        entry.only_in_variant = use.only_in_variant;
        entry.uv_set = static_cast<std::int32_t>(use.uv_set);
        std::copy_n(use.transform.offset, 2, entry.uv_offset);
        entry.uv_rotation_rad = use.transform.rotation;
        std::copy_n(use.transform.scale, 2, entry.uv_scale);
        entry.follows_first = haveSameTangents(uses[0], use, TextureTransform::apply);
    }
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
    info.compression = compressionName(document, primitive);
    info.morph_target_count = static_cast<std::uint32_t>(primitive.targets.size());
    describeAttributes(document, primitive, info);
    const std::vector<TangentUse> uses = tangentUses(document, primitive);
    describeUses(uses, info);
    info.needs_tangents = !uses.empty() && hasTriangles(primitive.mode);
    const std::size_t uv_set = uses.empty() ? 0 : uses[0].uv_set;
    if (primitive.find("TEXCOORD_" + std::to_string(uv_set))) info.uv_set = static_cast<std::int32_t>(uv_set);
    info.variant_material_count = static_cast<std::uint32_t>(variantMaterials(document, primitive).size());
    describeTriangles(document, primitive, !uses.empty() && uses[0].transform.mirrors(), info);
    return info;
}

/// Number of nodes that draw a mesh, and number of times they draw it.
struct MeshDraws {
    std::uint32_t node_count = 0;
    std::uint64_t instance_count = 0;
};

std::vector<MeshDraws> meshDraws(const Document& document) {
    std::vector<MeshDraws> draws(rootArray(document, "meshes").size());
    const Json& nodes = rootArray(document, "nodes");
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const std::string place = join("/nodes", i);
        const auto mesh = readIndex(nodes[i], "mesh", place, draws.size(), "mesh");
        if (!mesh) continue;
        ++draws[*mesh].node_count;
        draws[*mesh].instance_count += countInstances(document, nodes[i], place).complete;
    }
    return draws;
}

std::vector<std::string> variantNames(const Document& document) {
    std::vector<std::string> names;
    const Json* extension = findExtension(document.json, "KHR_materials_variants");
    if (extension == nullptr) return names;
    const std::string place = "/extensions/KHR_materials_variants";
    const Json& variants = readArray(*extension, "variants", place);
    for (std::size_t i = 0; i < variants.size(); ++i)
        names.push_back(readString(variants[i], "name", join(place + "/variants", i)));
    return names;
}

std::uint32_t entryCount(const Document& document, const char* name) {
    return static_cast<std::uint32_t>(rootArray(document, name).size());
}

Inspection inspectGltf(const std::string& input, const FileOptions& options) {
    Document document = loadDocument(input, options);
    Inspection result;
    result.format = formatOf(document);
    result.generator = generatorOf(document);
    result.file_bytes = document.input_bytes;
    result.mesh_count = entryCount(document, "meshes");
    result.material_count = entryCount(document, "materials");
    result.node_count = entryCount(document, "nodes");
    result.animation_count = entryCount(document, "animations");
    result.image_count = entryCount(document, "images");
    result.extensions_used = readNames(document.json, "extensionsUsed");
    result.extensions_required = readNames(document.json, "extensionsRequired");
    checkRequiredExtensions(document);
    const std::vector<Primitive> primitives = readPrimitives(document);
    warnOfNormals(document, primitives);
    result.warnings = document.warnings;
    std::copy_n(document.coordinate_offset.begin(), 3, result.coordinate_offset);
    result.variants = variantNames(document);
    const std::vector<MeshDraws> draws = meshDraws(document);
    VertexLists lists;
    for (const Primitive& primitive : primitives) {
        PrimitiveInfo& info = result.primitives.emplace_back(describePrimitive(document, primitive));
        info.vertex_list = lists.numberOf(primitive);
        info.node_count = draws[primitive.mesh].node_count;
        info.instance_count = draws[primitive.mesh].instance_count;
    }
    return result;
}

// Contents of an OBJ file, described like the glTF that is made from it.

using namespace obj;

PrimitiveInfo describePrimitive(const obj::Model& model, const ObjPrimitive& primitive) {
    const OwnedMesh mesh = buildMesh(model, primitive);
    const Material& material = model.materials[primitive.material];
    PrimitiveInfo info;
    info.mesh = primitive.shape;
    info.mesh_name = model.shape_names[primitive.shape];
    info.material_name = material.name;
    info.mode = mesh.face_sizes.empty() ? "triangles" : "polygons";
    info.vertex_count = mesh.positions.size();
    info.index_type = "none";
    info.compression = "none";
    info.attributes.push_back("POSITION float3");
    info.has_normals = !mesh.normals.empty();
    if (info.has_normals) info.attributes.push_back("NORMAL float3");
    if (primitive.has_uvs) info.attributes.push_back("TEXCOORD_0 float2");
    info.uv_set_count = primitive.has_uvs ? 1 : 0;
    info.uv_set = primitive.has_uvs ? 0 : -1;
    info.needs_tangents = material.normal_texture.used();
    if (info.needs_tangents) {
        info.needed_by = "normalTexture";
        info.tangent_uses.push_back(
            {.needed_by = info.needed_by, .material = primitive.material, .material_name = material.name});
    }
    info.node_count = 1;
    info.instance_count = 1;
    const std::vector<std::uint32_t> corners = triangleCorners(mesh);
    info.triangle_count = corners.size() / 3;
    describeUvMap(corners, mesh.positions, mesh.uvs, true, info);
    MeshView cut;  // triangulated in the same way as by check
    cut.positions = std::span(mesh.positions);
    cut.indices = IndexView(std::span(corners));
    if (model.memory->has(reportableNoiseMemory(cut))) info.position_noise = reportableNoise(cut, 0);
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
        info.vertex_list = static_cast<std::uint32_t>(result.primitives.size());
        result.primitives.push_back(std::move(info));
    }
    return result;
}

}  // namespace

Result<Inspection> inspectFile(const std::string& input, const FileOptions& options) {
    return atFileBorder([&]() -> Result<Inspection> {
        const bool is_obj = lowerExtension(input) == ".obj";
        return is_obj ? inspectObj(input, options) : inspectGltf(input, options);
    });
}

}  // namespace tspace

namespace tspace::report {
namespace {

Json useJson(const TangentUseInfo& use) {
    return Json::object({
        {"neededBy", use.needed_by},
        {"place", use.place},
        {"material", use.material},
        {"materialName", use.material_name},
        {"onlyInVariant", use.only_in_variant},
        {"uvSet", use.uv_set},
        {"uvOffset", use.uv_offset},
        {"uvRotation", use.uv_rotation_rad},
        {"uvScale", use.uv_scale},
        {"followsFirst", use.follows_first},
    });
}

Json inspectedPrimitiveJson(const PrimitiveInfo& primitive) {
    return Json::object({
        {"mesh", primitive.mesh},
        {"primitive", primitive.primitive},
        {"meshName", primitive.mesh_name},
        {"materialName", primitive.material_name},
        {"mode", primitive.mode},
        {"triangles", primitive.triangle_count},
        {"vertices", primitive.vertex_count},
        {"indexType", primitive.index_type},
        {"compression", primitive.compression},
        {"attributes", primitive.attributes},
        {"uvSets", primitive.uv_set_count},
        {"morphTargets", primitive.morph_target_count},
        {"skinned", primitive.skinned},
        {"hasNormals", primitive.has_normals},
        {"hasTangents", primitive.has_tangents},
        {"tangentsNotRead", primitive.tangents_not_read},
        {"packedFrames", packedNames(primitive)},
        {"needsTangents", primitive.needs_tangents},
        {"neededBy", primitive.needed_by},
        {"tangentUses", listJson(primitive.tangent_uses, useJson)},
        {"variantMaterials", primitive.variant_material_count},
        {"nodes", primitive.node_count},
        {"instances", primitive.instance_count},
        {"uvSet", primitive.uv_set},
        {"degenerateUvTriangles", primitive.degenerate_uv_count},
        {"degenerateTriangles", primitive.degenerate_triangle_count},
        {"positionNoise", primitive.position_noise},
        {"mirroredTriangles", primitive.mirrored_triangle_count},
        {"uvIslands", primitive.uv_island_count},
        {"mirroredUvIslands", primitive.mirrored_island_count},
    });
}

Json inspectedJson(const InspectOutcome& outcome) {
    Json json = fileJson(outcome);
    if (!outcome.result) return json;
    const Inspection& file = *outcome.result;
    json["fileBytes"] = file.file_bytes;
    json["meshes"] = file.mesh_count;
    json["materials"] = file.material_count;
    json["nodes"] = file.node_count;
    json["animations"] = file.animation_count;
    json["images"] = file.image_count;
    json["extensionsUsed"] = file.extensions_used;
    json["extensionsRequired"] = file.extensions_required;
    json["variants"] = file.variants;
    json["warnings"] = file.warnings;
    json["coordinateOffset"] = file.coordinate_offset;
    json["primitives"] = listJson(file.primitives, inspectedPrimitiveJson);
    return json;
}

}  // namespace

std::vector<std::string> packedNames(const PrimitiveInfo& primitive) {
    std::vector<std::string> names;
    for (const FrameFormat format : primitive.packed_frames) names.emplace_back(frameFormatName(format));
    return names;
}

std::string inspectJson(const std::vector<InspectOutcome>& outcomes, ExitCode exit_code) {
    Json json = documentJson("tspace.inspect/1", exit_code == ExitCode::done, exit_code);
    json["files"] = listJson(outcomes, inspectedJson);
    return jsonText(json);
}

}  // namespace tspace::report
