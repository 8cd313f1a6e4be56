// SPDX-License-Identifier: MIT
// A page with a model in it, as JSON.
#include "commands/view/view_report.h"

namespace tspace::report {

std::string viewJson(const Outcome<ViewReport>& outcome, ExitCode exit_code) {
    const Result<ViewReport>& result = outcome.result;
    Json json = documentJson("tspace.view/1", result.ok(), exit_code);
    json["input"] = outcome.input;
    json["output"] = outcome.output;
    json["error"] = errorJson(result ? nullptr : &result.error());
    if (!result) return jsonText(json);
    json["files"] = result->files;
    json["outputBytes"] = result->output_bytes;
    return jsonText(json);
}

}  // namespace tspace::report
