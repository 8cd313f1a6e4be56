// SPDX-License-Identifier: MIT
// Methods as JSON.
#include "commands/identify/identify_report.h"

namespace tspace::report {
namespace {

Json explanationJson(const Explanation& entry) {
    return Json::object({{"method", methodName(entry.method)},
                         {"faces", facesName(entry.faces)},
                         {"uvSet", entry.uv_set},
                         {"isTexturesSet", entry.is_textures_set},
                         {"isTransformed", entry.is_transformed},
                         {"corners", entry.corner_count},
                         {"undecidedCorners", entry.undecided_count},
                         {"near", entry.near_count},
                         {"nearAtVertex", entry.near_any_count},
                         {"meanDeg", entry.mean_deg},
                         {"gltfSigns", entry.gltf_sign_count},
                         {"invertedSigns", entry.inverted_sign_count},
                         {"signs", signReadingName(entry.signs())}});
}

Json identityJson(const PrimitiveIdentity& primitive) {
    return Json::object({{"place", primitive.place},
                         {"mesh", primitive.mesh},
                         {"primitive", primitive.primitive},
                         {"meshName", primitive.mesh_name},
                         {"materialName", primitive.material_name},
                         {"skipped", primitive.skipped},
                         {"explanations", listJson(primitive.explanations, explanationJson)}});
}

Json identifiedJson(const IdentifyOutcome& outcome) {
    Json json = fileJson(outcome);
    if (!outcome.result) return json;
    const Identification& result = *outcome.result;
    json["format"] = result.format;
    json["generator"] = result.generator;
    json["verdict"] = result.verdict;
    json["explanations"] = listJson(result.explanations, explanationJson);
    json["primitives"] = listJson(result.primitives, identityJson);
    return json;
}

}  // namespace

std::string identifyJson(const std::vector<IdentifyOutcome>& outcomes, ExitCode exit_code) {
    Json json = documentJson("tspace.identify/1", exit_code == ExitCode::done, exit_code);
    json["files"] = listJson(outcomes, identifiedJson);
    return jsonText(json);
}

}  // namespace tspace::report
