// SPDX-License-Identifier: MIT
// A normal map that was converted, as JSON.
#include "commands/convert_map/convert_map_report.h"

namespace tspace::report {

std::string convertMapJson(const Outcome<ConvertMapFileReport>& outcome, ExitCode exit_code) {
    const Result<ConvertMapFileReport>& result = outcome.result;
    Json json = madeFileJson("tspace.convert-map/1", outcome, exit_code);
    if (!result) return jsonText(json);
    json["width"] = result->width;
    json["height"] = result->height;
    json["bitsBefore"] = result->bits_before;
    json["bits"] = result->bits;
    json["from"] = mapMeshJson(result->from);
    json["to"] = mapMeshJson(result->to);
    const ConvertMapReport& texels = result->texels;
    json["converted"] = texels.converted;
    json["changed"] = texels.changed;
    json["background"] = texels.background;
    json["withoutFrame"] = texels.without_frame;
    json["belowHorizon"] = texels.below_horizon;
    json["overlapping"] = texels.overlapping;
    json["unmatched"] = texels.unmatched;
    json["degenerateUvs"] = texels.degenerate_uv_count;
    json["badUvs"] = texels.bad_uv_count;
    json["meanChangeDeg"] = texels.mean_change_deg;
    json["maxChangeDeg"] = texels.max_change_deg;
    json["halfStepDeg"] = texels.half_step_deg;
    json["belowHalfStep"] = texels.is_below_half_step;
    json["warnings"] = result->warnings;
    return jsonText(json);
}

}  // namespace tspace::report
