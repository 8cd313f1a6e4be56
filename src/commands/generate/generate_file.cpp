// SPDX-License-Identifier: MIT
// generateFile and generateModel: determine the input format and call its pipeline. The report as JSON.
#include "commands/generate/generate_model.h"

#include "commands/generate/generate_report.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/read/read_scene.h"
#include "tspace/generate.h"
#include "tspace/mesh.h"
#include "tspace/pack.h"
#include "tspace/result.h"
#include "tspace/tangents.h"
#include "tspace/winding.h"

namespace tspace {
namespace {

/// Returns why maps cannot be converted with these options; empty if they can, or if conversion was not requested.
std::string whyMapsUnchanged(const std::string& input, const GenerateOptions& options) {
    if (!options.maps.convert) return {};
    if (options.normals.overwrite) return "normal maps can only be converted for new tangents, not for new normals";
    if (options.maps.flip_green != FlipGreen::none)
        return "normal maps cannot be converted and inverted in the same run";
    if (options.maps.mend) return "normal maps cannot be fixed and converted in the same run";
    if (options.selection.existing == ExistingTangents::repair)
        return "normal maps cannot be converted when tangents are repaired, because repairs are meant to change the "
               "shading";
    if (options.tangents.texture_transform == TextureTransform::ignore)
        return "converted normal maps are for viewers that use tangents unchanged, so texture transforms must be "
               "applied";
    if (options.tangents.compute.convention != conventions::gltf)
        return "normal maps can be converted for the glTF convention only";
    if (lowerExtension(input) == ".obj")
        return "the maps of an OBJ file cannot be converted, because OBJ stores no tangents; write a glTF file first, "
               "then recompute its tangents";
    return {};
}

void checkOptions(const std::string& input, const GenerateOptions& options) {
    const auto refuse = [](const std::string& why) { failFile(ErrorCode::invalidOption, why); };
    if (options.selection.all && options.selection.strip)
        refuse(
            "the options all and strip cannot be combined: one adds tangents to every primitive, the other removes "
            "tangents that are not needed");
    if (options.storage.pack && frameBytes(*options.storage.pack) == 0)
        refuse("the format of packed frames is not a value of FrameFormat");
    if (!options.storage.pack && options.storage.pack_drop != PackDrop::nothing)
        refuse("normals and tangents can only be removed if frames are packed");
    if (!options.maps.read && (options.maps.flip_green != FlipGreen::none || options.maps.mend || options.maps.convert))
        refuse("changing normal maps requires reading their pixels, which is disabled (--no-images)");
    if (const std::string why = whyMapsUnchanged(input, options); !why.empty()) refuse(why);
}

/// Returns whether an input is an OBJ file. Examines its name, because OBJ has no signature. All other files are read
/// as glTF, which rejects unsupported formats.
bool isObj(const std::string& input) { return lowerExtension(input) == ".obj"; }

Result<GenerateReport> generateAny(const std::string& input, const std::string& output, const GenerateOptions& options,
                                   const GenerateStep* step) {
    return atFileBorder([&]() -> Result<GenerateReport> {
        checkOptions(input, options);
        return isObj(input) ? generateObj(input, output, options, step)
                            : gltf::generateGltf(input, output, options, step);
    });
}

}  // namespace

Result<GenerateReport> generateFile(const std::string& input, const std::string& output,
                                    const GenerateOptions& options) {
    return generateAny(input, output, options, nullptr);
}

Result<GenerateReport> generateStep(const std::string& input, const std::string& output, const GenerateOptions& options,
                                    const GenerateStep& step) {
    return generateAny(input, output, options, &step);
}

gltf::GeneratedModel generateModel(ModelFile&& input, const std::string& path, const GenerateOptions& options,
                                   bool with_images, const GenerateStep& step) {
    checkOptions(path, options);
    if (input.isObj()) return generateObjModel(std::move(input.obj()), path, options, step);
    return gltf::generateModel(std::move(input.gltf()), options, with_images, step);
}

gltf::GeneratedModel generateModel(const std::string& input, const GenerateOptions& options, bool with_images,
                                   const GenerateStep& step) {
    checkOptions(input, options);
    return generateModel(ModelFile(input, options.file, options.execution, options.progress), input, options,
                         with_images, step);
}

}  // namespace tspace

namespace tspace::report {

bool wasComputed(PrimitiveAction action) {
    return action == PrimitiveAction::generated || action == PrimitiveAction::replaced ||
           action == PrimitiveAction::unchanged;
}

void VertexTotals::add(const PrimitiveReport& primitive) {
    if (source_lists_.insert(primitive.source_list).second) before_ += primitive.vertices_before;
    if (split_lists_.insert(primitive.split_list).second)
        split_ += primitive.vertices_after - primitive.vertices_before;
}

Totals totalsOf(const GenerateReport& report) {
    Totals totals;
    for (const PrimitiveReport& primitive : report.primitives) {
        ++totals.primitive_count;
        ++totals.actions[static_cast<std::size_t>(primitive.action)];
        totals.normals_generated += primitive.normals_generated;
        totals.normals_replaced += primitive.normals_replaced;
        totals.morph_normals_computed += primitive.morph_normals_computed;
        totals.on_quads += primitive.faces == Faces::quads ? 1 : 0;
        totals.quad_count += primitive.quad_count;
        totals.bitangents_generated += primitive.bitangents_generated;
        totals.frames_packed += primitive.frames_packed;
        totals.packed_repaired += primitive.packing.mendedCount();
        totals.tangents_dropped += primitive.tangents_dropped;
        totals.normals_dropped += primitive.normals_dropped;
        totals.morph_deltas_computed += primitive.morph_deltas_computed;
        totals.morph_sign_flip_count += primitive.morph_sign_flip_count;
        if (!wasComputed(primitive.action)) continue;
        totals.triangle_count += primitive.triangle_count;
        totals.vertices.add(primitive);
        totals.degenerate_uv_count += primitive.tangents.degenerate_uv_count;
        totals.degenerate_triangle_count += primitive.tangents.degenerate_triangle_count;
        totals.reference_order_abandoned |= primitive.tangents.reference_order_abandoned;
        for (const NamedCount& cause : kCauses) totals.sanitize.*cause.count += primitive.sanitize.*cause.count;
        for (const NamedCount& cure : kCures) totals.sanitize.*cure.count += primitive.sanitize.*cure.count;
        totals.sanitize.bad_normal_count += primitive.sanitize.bad_normal_count;
    }
    return totals;
}

namespace {

Json sanitizeJson(const SanitizeReport& report) {
    Json json = Json::object({{"mended", report.mendedCount()}});
    for (const NamedCount& cause : kCauses) json["causes"][cause.json_name] = report.*cause.count;
    for (const NamedCount& cure : kCures) json["cures"][cure.json_name] = report.*cure.count;
    json["badNormals"] = report.bad_normal_count;
    return json;
}

Json faceRangeJson(const FaceRange& range) { return Json::object({{"first", range.first}, {"count", range.count}}); }

Json generatedPrimitiveJson(const PrimitiveReport& primitive) {
    const TangentReport& tangents = primitive.tangents;
    return Json::object({
        {"mesh", primitive.mesh},
        {"primitive", primitive.primitive},
        {"meshName", primitive.mesh_name},
        {"materialName", primitive.material_name},
        {"action", actionName(primitive.action)},
        {"reason", primitive.reason},
        {"notes", primitive.notes},
        {"uvSet", primitive.uv_set},
        {"faces", facesName(primitive.faces)},
        {"quads", primitive.quad_count},
        {"triangles", primitive.triangle_count},
        {"verticesBefore", primitive.vertices_before},
        {"verticesAfter", primitive.vertices_after},
        {"mendedVertices", primitive.mended_vertex_count},
        {"normalsGenerated", primitive.normals_generated},
        {"normalsReplaced", primitive.normals_replaced},
        {"normalsJoined", primitive.normals_joined_count},
        {"normalsBehind", primitive.normals_behind_count},
        {"turnedTriangles", primitive.turned_triangle_count},
        {"twoSidedTriangles", primitive.two_sided_triangle_count},
        {"windingMended", primitive.winding_mended_count},
        {"windingMendedRanges", listJson(primitive.winding_mended, faceRangeJson)},
        {"bitangentsGenerated", primitive.bitangents_generated},
        {"packed", primitive.frames_packed},
        {"packedMended", primitive.packing.mendedCount()},
        {"normalsDropped", primitive.normals_dropped},
        {"tangentsDropped", primitive.tangents_dropped},
        {"morphTargets", primitive.morph_target_count},
        {"morphDeltas", primitive.morph_deltas_computed},
        {"morphNormals", primitive.morph_normals_computed},
        {"morphSignFlips", primitive.morph_sign_flip_count},
        {"normals", Json::object({{"faces", primitive.normals.face_count},
                                  {"degenerateFaces", primitive.normals.degenerate_face_count},
                                  {"fallbackCorners", primitive.normals.fallback_corner_count},
                                  {"noise", primitive.normals.noise},
                                  {"creaseDeg", primitive.normals.crease_angle_deg}})},
        {"tangents", Json::object({{"triangles", tangents.triangle_count},
                                   {"degenerateTriangles", tangents.degenerate_triangle_count},
                                   {"degenerateUvTriangles", tangents.degenerate_uv_count},
                                   {"negativeUvTriangles", primitive.negative_uv_count},
                                   {"skippedFaces", tangents.skipped_face_count},
                                   {"groups", tangents.group_count},
                                   {"defaultCorners", tangents.default_corner_count},
                                   {"notFiniteCorners", tangents.not_finite_count},
                                   {"referenceOrderAbandoned", tangents.reference_order_abandoned}})},
        {"sanitize", sanitizeJson(primitive.sanitize)},
    });
}

Json totalsJson(const GenerateReport& report) {
    const Totals totals = totalsOf(report);
    Json json = Json::object({{"primitives", totals.primitive_count}});
    for (const PrimitiveAction action : kActions)
        json["actions"][actionName(action)] = totals.actions[static_cast<std::size_t>(action)];
    json["triangles"] = totals.triangle_count;
    json["verticesBefore"] = totals.vertices.before();
    json["verticesAfter"] = totals.vertices.after();
    json["mended"] = totals.sanitize.mendedCount();
    json["morphDeltas"] = totals.morph_deltas_computed;
    json["packed"] = totals.frames_packed;
    return json;
}

Json mendedWindingJson(const MendedWindingReport& mended) {
    const WindingReport& winding = mended.winding;
    return Json::object({{"mesh", mended.mesh},
                         {"meshName", mended.mesh_name},
                         {"faces", winding.face_count},
                         {"turned", winding.turned_count},
                         {"conflictsBefore", winding.conflict_count_before},
                         {"conflictsAfter", winding.conflict_count_after},
                         {"components", winding.component_count},
                         {"turnedComponents", winding.turned_component_count},
                         {"byNormals", winding.by_normals_count},
                         {"byVolume", winding.by_volume_count},
                         {"byNesting", winding.by_nesting_count},
                         {"byWindingNumber", winding.by_winding_number_count},
                         {"byMajority", winding.by_majority_count},
                         {"small", winding.small_count},
                         {"oneSided", winding.one_sided_count}});
}

Json normalMapJson(const NormalMapReport& map) {
    return Json::object({{"image", map.image},
                         {"name", map.name},
                         {"flipped", map.flipped},
                         {"mended", map.mended},
                         {"reason", map.reason}});
}

Json convertedMapJson(const ConvertedMapReport& map) {
    Json json =
        Json::object({{"image", map.image}, {"name", map.name}, {"converted", map.converted}, {"reason", map.reason}});
    json["newImage"] = map.converted ? Json(map.new_image) : Json(nullptr);
    json["materials"] = map.materials;
    json["primitives"] = map.primitive_count;
    json["bits"] = map.bits;
    json["changed"] = map.changed;
    json["meanErrorDeg"] = map.mean_error_deg;
    json["meanErrorUnconvertedDeg"] = map.mean_error_unconverted_deg;
    json["notes"] = map.notes;
    return json;
}

}  // namespace

Json generatedFileJson(const GenerateOutcome& outcome) {
    Json json = Json::object({
        {"input", outcome.input},
        {"output", outcome.output},
        {"ok", outcome.result.ok()},
        {"error", errorJson(outcome.result ? nullptr : &outcome.result.error())},
        {"seconds", outcome.seconds},
    });
    json["skipped"] = outcome.was_done_before;
    if (!outcome.result || outcome.was_done_before) return json;
    const GenerateReport& report = *outcome.result;
    json["changed"] = report.changed;
    json["inputBytes"] = report.input_bytes;
    json["outputBytes"] = report.output_bytes;
    json["outputFiles"] = report.output_files;
    json["warnings"] = report.warnings;
    json["coordinateOffset"] = report.coordinate_offset;
    json["totals"] = totalsJson(report);
    json["windings"] = listJson(report.windings, mendedWindingJson);
    json["normalMaps"] = listJson(report.normal_maps, normalMapJson);
    json["convertedMaps"] = listJson(report.converted_maps, convertedMapJson);
    json["primitives"] = listJson(report.primitives, generatedPrimitiveJson);
    return json;
}

std::string generateJson(const std::vector<GenerateOutcome>& outcomes, ExitCode exit_code, double seconds) {
    Json json = documentJson("tspace.generate/1", exit_code == ExitCode::done, exit_code);
    json["seconds"] = seconds;
    json["files"] = listJson(outcomes, generatedFileJson);
    json["dryRun"] = !outcomes.empty() && outcomes.front().is_dry_run;
    return jsonText(json);
}

}  // namespace tspace::report
