// SPDX-License-Identifier: MIT
// A normal map that became a texture, as JSON.
#include "commands/compress_map/compress_map_report.h"

namespace tspace::report {

std::string compressMapJson(const Outcome<CompressMapFileReport>& outcome, ExitCode exit_code) {
    const Result<CompressMapFileReport>& result = outcome.result;
    Json json = madeFileJson("tspace.compress-map/1", outcome, exit_code);
    if (!result) return jsonText(json);
    json["width"] = result->width;
    json["height"] = result->height;
    json["bitsBefore"] = result->bits_before;
    json["levels"] = result->level_count;
    json["outputBytes"] = result->output_bytes;
    json["meanErrorDeg"] = result->mean_error_deg;
    json["p99ErrorDeg"] = result->p99_error_deg;
    json["maxErrorDeg"] = result->max_error_deg;
    json["belowHorizon"] = result->below_horizon;
    json["notUnit"] = result->not_unit;
    json["warnings"] = result->warnings;
    return jsonText(json);
}

}  // namespace tspace::report
