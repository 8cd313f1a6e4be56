// SPDX-License-Identifier: MIT
// What a normal map is off, and what it fits, as JSON.
#include "commands/bake/bake_report.h"
#include "commands/map_error/map_error_report.h"

namespace tspace::report {

std::string mapErrorJson(const Outcome<MapErrorFileReport>& outcome, const std::string& low, const std::string& high,
                         ExitCode exit_code) {
    const Result<MapErrorFileReport>& result = outcome.result;
    Json json = documentJson("tspace.map-error/1", result.ok(), exit_code);
    json["map"] = outcome.input;
    json["low"] = low;
    json["high"] = high;
    json["error"] = errorJson(result ? nullptr : &result.error());
    if (!result) return jsonText(json);
    json["width"] = result->width;
    json["height"] = result->height;
    json["bits"] = result->bits;
    json["fits"] = result->fits;
    json["verdict"] = result->verdict;
    json["reach"] = result->error.reach;
    json["cageOffset"] = result->error.cage_offset;
    json["angles"] = errorOfMapJson(result->error);
    json["rays"] = listJson(result->rays, [](const ExplainedRays& rays) -> Json {
        return {{"rays", raysWord(rays.rays)},
                {"directions", directionsWord(rays.rays)},
                {"reach", rays.error.reach},
                {"cageOffset", rays.error.cage_offset},
                {"angles", errorOfMapJson(rays.error)}};
    });
    json["readings"] = listJson(result->readings, [](const ExplainedReading& reading) -> Json {
        return {{"frames", reading.frames},
                {"green", reading.reading.green == Green::up ? "up" : "down"},
                {"bitangent", reading.reading.bitangent == BitangentPlace::perPixel ? "pixel" : "vertex"},
                {"unitVectors", reading.reading.unit_vectors},
                {"twoChannels", reading.reading.two_channels},
                {"angles", errorOfMapJson(reading.error)}};
    });
    json["framesMade"] = result->frames_made;
    json["matchedByName"] = result->matched_by_name;
    json["heatTopDeg"] = result->heat_top_deg;
    json["warnings"] = result->warnings;
    return jsonText(json);
}

}  // namespace tspace::report
