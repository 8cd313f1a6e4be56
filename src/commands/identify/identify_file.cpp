// SPDX-License-Identifier: MIT
// identifyFile: compares every primitive with every method, and sums the results over the file; its report as JSON.
#include <algorithm>

#include "commands/identify/identify_report.h"
#include "commands/identify/verdict.h"
#include "core/mesh/quads/quads.h"
#include "model/io/file_error.h"
#include "model/read/read_scene.h"
#include "tspace/inspect.h"

namespace tspace {
namespace {

std::string whyNot(const ScenePrimitive& primitive) {
    if (primitive.corners.empty()) return "it has no triangles";
    for (const SceneTangentFault& fault : primitive.tangent_faults) {
        if (fault.target < 0) return "its tangents cannot be read: " + fault.why;
    }
    if (primitive.tangents.empty()) return primitive.tangents_not_read ? kNotRead : "it has no tangents";
    if (primitive.normals.empty()) return "it has no normals";
    const bool has_uvs = std::any_of(primitive.uv_sets.begin(), primitive.uv_sets.end(),
                                     [](const SharedArray<Vec2>& set) { return !set.empty(); });
    return has_uvs ? "" : "it has no UVs";
}

void addTo(Explanation& sum, const Explanation& part) {
    const double weight = static_cast<double>(sum.corner_count), more = static_cast<double>(part.corner_count);
    if (weight + more > 0) sum.mean_deg = (sum.mean_deg * weight + part.mean_deg * more) / (weight + more);
    sum.corner_count += part.corner_count;
    sum.near_count += part.near_count;
    sum.near_any_count += part.near_any_count;
    sum.gltf_sign_count += part.gltf_sign_count;
    sum.inverted_sign_count += part.inverted_sign_count;
    sum.undecided_count += part.undecided_count;
}

bool hasTwoReadings(const PrimitiveIdentity& primitive) {
    const Explanation *with_transform = bestReading(primitive, true), *plain = bestReading(primitive, false);
    return with_transform != nullptr && plain != nullptr &&
           (with_transform->near_count != plain->near_count ||
            with_transform->gltf_sign_count != plain->gltf_sign_count);
}

/// Returns the explanation by a method with the UV set of the texture, transformed or as stored as followsTransform()
/// decides. For Faces::quads, returns the explanation on triangles if there is none on quads.
const Explanation* partOf(const PrimitiveIdentity& primitive, Method method, Faces faces) {
    const Explanation* part = nullptr;
    for (const Explanation& entry : primitive.explanations) {
        const bool is_texture_reading = entry.is_textures_set && entry.is_transformed == followsTransform(primitive);
        if (entry.method != method || !is_texture_reading) continue;
        if (entry.faces == faces) return &entry;
        if (entry.faces == Faces::triangles) part = &entry;
    }
    return part;
}

/// Sums explanations over all primitives. In the sum on quads, primitives for which quads do not explain more are
/// counted on triangles. The sum is omitted if quads do not explain clearly more in total (quadsWin).
std::vector<Explanation> overAllPrimitives(const std::vector<PrimitiveIdentity>& primitives) {
    std::vector<Explanation> sums;
    const auto add = [&](Method method, Faces faces) {
        Explanation sum{.method = method, .faces = faces};
        for (const PrimitiveIdentity& primitive : primitives) {
            if (const Explanation* part = partOf(primitive, method, faces)) addTo(sum, *part);
        }
        if (sum.corner_count != 0) sums.push_back(sum);
    };
    add(Method::mikktspace, Faces::triangles);
    add(Method::mikktspace, Faces::quads);
    if (sums.size() == 2 && !quadsWin(sums[0].corner_count, sums[0].near_count, sums[1].near_count)) sums.pop_back();
    for (const Method method : knownMethods()) {
        if (method != Method::mikktspace) add(method, Faces::triangles);
    }
    sortExplanations(sums);
    return sums;
}

PrimitiveIdentity identify(const ScenePrimitive& primitive, const IdentifyOptions& options) {
    PrimitiveIdentity identity{.place = primitive.place,
                               .mesh = primitive.mesh,
                               .primitive = primitive.primitive,
                               .mesh_name = primitive.mesh_name,
                               .material_name = primitive.material_name,
                               .skipped = whyNot(primitive)};
    if (!identity.skipped.empty()) return identity;
    identity.explanations = valueOrThrow(explainTangents(primitive, options));
    if (identity.explanations.empty()) identity.skipped = "its UVs have no area";
    sortExplanations(identity.explanations);
    identity.has_two_readings = hasTwoReadings(identity);
    // If two interpretations have equally many near corners, the one whose signs fit is first.
    const auto follows =
        std::find_if(identity.explanations.begin(), identity.explanations.end(), [&](const Explanation& entry) {
            return entry.is_textures_set && entry.is_transformed == followsTransform(identity);
        });
    if (follows != identity.explanations.end() && follows->near_count == identity.explanations.front().near_count)
        std::rotate(identity.explanations.begin(), follows, follows + 1);
    return identity;
}

}  // namespace

const char* signReadingName(SignReading reading) {
    switch (reading) {
        case SignReading::none: return "none";
        case SignReading::gltf: return "gltf";
        case SignReading::inverted: return "inverted";
        case SignReading::mixed: return "mixed";
    }
    return "none";
}

SignReading Explanation::signs() const {
    constexpr double kNearlyAll = 0.95;
    const double most = kNearlyAll * static_cast<double>(corner_count);
    if (gltf_sign_count + inverted_sign_count == 0) return SignReading::none;
    if (static_cast<double>(gltf_sign_count) >= most) return SignReading::gltf;
    if (static_cast<double>(inverted_sign_count) >= most) return SignReading::inverted;
    return SignReading::mixed;
}

Result<Identification> identifyFile(const std::string& input, const IdentifyOptions& options) {
    return atFileBorder([&]() -> Result<Identification> {
        const Scene scene = readScene(input, options.file, false);
        Identification result{.format = scene.format, .generator = scene.generator, .warnings = scene.warnings};
        for (const ScenePrimitive& primitive : scene.primitives)
            result.primitives.push_back(identify(primitive, options));
        result.explanations = overAllPrimitives(result.primitives);
        result.verdict = verdictOf(result);
        return result;
    });
}

}  // namespace tspace

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
    json["warnings"] = result.warnings;
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
