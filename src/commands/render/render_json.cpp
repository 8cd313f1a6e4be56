// SPDX-License-Identifier: MIT
// A picture that was drawn, as JSON.
#include "commands/render/render_report.h"

namespace tspace::report {

std::string renderJson(const Outcome<RenderReport>& outcome, ExitCode exit_code) {
    const Result<RenderReport>& result = outcome.result;
    Json json = madeFileJson("tspace.render/1", outcome, exit_code);
    if (!result) return jsonText(json);
    json["show"] = renderShowName(result->show);
    json["width"] = result->width;
    json["height"] = result->height;
    json["primitives"] = result->primitive_count;
    json["triangles"] = result->triangle_count;
    json["primitivesComputed"] = result->computed_count;
    json["primitivesWithoutTangents"] = result->without_tangents_count;
    json["tangentError"] = nullptr;
    if (result->error_sample_count > 0) {
        json["tangentError"] = Json::object({{"samples", result->error_sample_count},
                                             {"meanDeg", result->mean_error_deg},
                                             {"maxDeg", result->max_error_deg}});
    }
    json["warnings"] = result->warnings;
    return jsonText(json);
}

}  // namespace tspace::report
