// SPDX-License-Identifier: MIT
// Baked maps, as JSON.
#include "commands/bake/bake_report.h"

namespace tspace::report {

Json errorOfMapJson(const MapError& error) {
    return {{"points", error.point_count},
            {"missed", error.missed_count},
            {"hidden", error.hidden_count},
            {"backs", error.back_count},
            {"inward", error.inward_count},
            {"meanDeg", error.mean_deg},
            {"metMeanDeg", error.met_mean_deg},
            {"p99Deg", error.p99_deg},
            {"maxDeg", error.max_deg},
            {"seamPoints", error.seam_point_count},
            {"seamMeanDeg", error.seam_mean_deg},
            {"insideMeanDeg", error.inside_mean_deg}};
}

const char* raysWord(const UsedRays& rays) {
    if (rays.has_cage) return "cage";
    return rays.target == RayTarget::nearest ? "nearest" : "outermost";
}

const char* directionsWord(const UsedRays& rays) {
    if (rays.has_cage) return "cage";
    if (rays.has_skew) return "skew";
    switch (rays.directions) {
        case RayDirections::automatic:
            return "auto";
        case RayDirections::averaged:
            return "averaged";
        case RayDirections::normals:
            break;
    }
    return "normals";
}

namespace {

Json bakedFileJson(const BakedFile& file) {
    const BakedMap& map = file.map;
    return {{"path", file.path},
            {"material", file.material},
            {"tile", file.tile},
            {"width", map.width},
            {"height", map.height},
            {"bits", map.bits},
            {"triangles", file.triangle_count},
            {"texels",
             {{"baked", map.hit_count},
              {"missed", map.missed_count},
              {"padding", map.padding_count},
              {"overlapping", map.overlap_count},
              {"conflicting", map.conflict_count}}},
            {"degenerateUvs", map.degenerate_uv_count},
            {"rays", raysWord(file.rays)},
            {"directions", directionsWord(file.rays)},
            {"reach", map.error.reach},
            {"cageOffset", map.error.cage_offset},
            {"error", errorOfMapJson(map.error)},
            {"ownError", map.own_error.point_count > 0 ? errorOfMapJson(map.own_error) : Json()},
            {"heatTopDeg", file.heat_top_deg}};
}

}  // namespace

std::string bakeJson(const Outcome<BakeFileReport>& outcome, const std::string& high, ExitCode exit_code) {
    const Result<BakeFileReport>& result = outcome.result;
    Json json = documentJson("tspace.bake/1", result.ok(), exit_code);
    json["low"] = outcome.input;
    json["high"] = high;
    json["output"] = outcome.output;
    json["seconds"] = outcome.seconds;
    json["error"] = errorJson(result ? nullptr : &result.error());
    if (!result) return jsonText(json);
    json["lowTriangles"] = result->low_triangle_count;
    json["highTriangles"] = result->high_triangle_count;
    json["framesMade"] = result->frames_made;
    json["matchedByName"] = result->matched_by_name;
    json["files"] = listJson(result->files, bakedFileJson);
    json["outputFiles"] = result->output_files;
    json["findings"] = result->findings;
    json["warnings"] = result->warnings;
    return jsonText(json);
}

}  // namespace tspace::report
