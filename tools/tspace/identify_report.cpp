// SPDX-License-Identifier: MIT
// Results of tspace identify as text and JSON. The JSON is described in docs/json.md.
#include <fmt/format.h>

#include "console.h"
#include "report.h"

namespace tspace::tool {
namespace {

std::string percent(std::uint64_t count, std::uint64_t total) {
    if (total == 0) return "-";
    return fmt::format("{:.1f} %", 100 * static_cast<double>(count) / static_cast<double>(total));
}

const char* signWords(SignReading reading) {
    switch (reading) {
        case SignReading::gltf:
            return "as glTF wants";
        case SignReading::inverted:
            return "inverted";
        case SignReading::mixed:
            return "mixed";
        case SignReading::none:
            break;
    }
    return "-";
}

std::string methodWords(const Explanation& entry) {
    return std::string(methodName(entry.method)) + (entry.faces == Faces::quads ? " on quads" : "");
}

std::string methodTable(const Identification& result) {
    Table table;
    table.addRow({"method", "near", "near at vertex", "mean angle", "signs as glTF", "signs inverted"});
    for (const Explanation& entry : result.explanations) {
        table.addRow({methodWords(entry), percent(entry.near_count, entry.corner_count),
                      percent(entry.near_any_count, entry.corner_count), fmt::format("{:.2f}", entry.mean_deg),
                      percent(entry.gltf_sign_count, entry.corner_count),
                      percent(entry.inverted_sign_count, entry.corner_count)});
    }
    return table.text("  ");
}

std::string remarkOn(const PrimitiveIdentity& primitive) {
    const Explanation& best = primitive.explanations.front();
    if (!best.is_textures_set) return "not the texture's UV set";
    if (!primitive.has_two_readings) return "";
    return best.is_transformed ? "after the texture transform" : "before the texture transform";
}

std::string primitiveTable(const Identification& result) {
    Table table;
    table.addRow({"mesh", "prim", "name", "material", "best method", "UV set", "near", "at vertex", "signs", ""});
    for (const PrimitiveIdentity& primitive : result.primitives) {
        std::vector<std::string> row = {std::to_string(primitive.mesh), std::to_string(primitive.primitive),
                                        primitive.mesh_name.empty() ? "-" : printable(primitive.mesh_name),
                                        primitive.material_name.empty() ? "-" : printable(primitive.material_name)};
        if (primitive.explanations.empty()) {
            for (const char* cell : {"-", "-", "-", "-", "-"}) row.emplace_back(cell);
            row.push_back(primitive.skipped);
        } else {
            const Explanation& best = primitive.explanations.front();
            row.insert(row.end(),
                       {methodWords(best), std::to_string(best.uv_set), percent(best.near_count, best.corner_count),
                        percent(best.near_any_count, best.corner_count), signWords(best.signs()), remarkOn(primitive)});
        }
        table.addRow(std::move(row));
    }
    return table.text("  ");
}

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
    Json json = {{"input", outcome.job.input},
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

std::string identifyText(const IdentifyOutcome& outcome) {
    const Identification& result = *outcome.result;
    std::string text = fmt::format("{}: {}\n", printable(outcome.job.input), result.verdict);
    if (!result.explanations.empty()) text.append("\n").append(methodTable(result));
    if (!result.primitives.empty()) text.append("\n").append(primitiveTable(result));
    return text;
}

std::string identifyJson(const std::vector<IdentifyOutcome>& outcomes, ExitCode exit_code) {
    Json json = {{"schema", "tspace.identify/1"},
                 {"version", TSPACE_VERSION},
                 {"ok", exit_code == ExitCode::done},
                 {"exitCode", static_cast<int>(exit_code)},
                 {"files", Json::array()}};
    for (const IdentifyOutcome& outcome : outcomes) json["files"].push_back(outcomeJson(outcome));
    return jsonText(json);
}

}  // namespace tspace::tool
