// SPDX-License-Identifier: MIT
// What is in files, as JSON.
#include "commands/inspect/inspect_report.h"

namespace tspace::report {
namespace {

Json useJson(const TangentUseInfo& use) {
    return Json::object({
        {"neededBy", use.needed_by},
        {"place", use.place},
        {"material", use.material},
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
    json["format"] = file.format;
    json["generator"] = file.generator;
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
