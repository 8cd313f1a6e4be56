// SPDX-License-Identifier: MIT
// A height map that became a normal map, as JSON.
#include "commands/height_to_normal/height_to_normal_report.h"

namespace tspace::report {

std::string heightToNormalJson(const Outcome<HeightToNormalFileReport>& outcome, ExitCode exit_code) {
    const Result<HeightToNormalFileReport>& result = outcome.result;
    Json json = madeFileJson("tspace.height-to-normal/1", outcome, exit_code);
    if (!result) return jsonText(json);
    json["width"] = result->width;
    json["height"] = result->height;
    json["bitsBefore"] = result->bits_before;
    json["bits"] = result->bits;
    json["mesh"] = mapMeshJson(result->mesh);
    json["texelsOnMesh"] = result->texels.on_mesh;
    json["texelSize"] = result->texels.texel_size;
    json["meanLeanDeg"] = result->texels.mean_lean_deg;
    json["maxLeanDeg"] = result->texels.max_lean_deg;
    json["warnings"] = result->warnings;
    return jsonText(json);
}

}  // namespace tspace::report
