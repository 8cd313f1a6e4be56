// SPDX-License-Identifier: MIT
// Methods as JSON.
#include "report/report.h"
#include "tspace/version.h"

namespace tspace::report {
namespace {

Json explanationJson(const Explanation& entry) {
    return {{"method", methodName(entry.method)},
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
            {"signs", signReadingName(entry.signs())}};
}

Json listJson(const std::vector<Explanation>& explanations) {
    Json list = Json::array();
    for (const Explanation& entry : explanations) list.push_back(explanationJson(entry));
    return list;
}

Json outcomeJson(const IdentifyOutcome& outcome) {
    Json json = {{"input", outcome.input},
                 {"ok", outcome.result.ok()},
                 {"error", errorJson(outcome.result ? nullptr : &outcome.result.error())}};
    if (!outcome.result) return json;
    const Identification& result = *outcome.result;
    json["format"] = result.format;
    json["generator"] = result.generator;
    json["verdict"] = result.verdict;
    json["explanations"] = listJson(result.explanations);
    json["primitives"] = Json::array();
    for (const PrimitiveIdentity& primitive : result.primitives) {
        json["primitives"].push_back({{"place", primitive.place},
                                      {"mesh", primitive.mesh},
                                      {"primitive", primitive.primitive},
                                      {"meshName", primitive.mesh_name},
                                      {"materialName", primitive.material_name},
                                      {"skipped", primitive.skipped},
                                      {"explanations", listJson(primitive.explanations)}});
    }
    return json;
}

}  // namespace

std::string identifyJson(const std::vector<IdentifyOutcome>& outcomes, ExitCode exit_code) {
    Json json = {{"schema", "tspace.identify/1"},
                 {"version", TSPACE_VERSION_STRING},
                 {"ok", exit_code == ExitCode::done},
                 {"exitCode", static_cast<int>(exit_code)},
                 {"files", Json::array()}};
    for (const IdentifyOutcome& outcome : outcomes) json["files"].push_back(outcomeJson(outcome));
    return jsonText(json);
}

}  // namespace tspace::report
