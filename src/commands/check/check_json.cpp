// SPDX-License-Identifier: MIT
// Findings as JSON.
#include "commands/check/check_report.h"

namespace tspace::report {
namespace {

Json findingJson(const Finding& finding) {
    return Json::object({
        {"code", findingName(finding.code)},
        {"severity", severityName(finding.severity)},
        {"place", finding.place},
        {"mesh", finding.mesh},
        {"primitive", finding.primitive},
        {"meshName", finding.mesh_name},
        {"materialName", finding.material_name},
        {"unit", finding.unit},
        {"count", finding.count},
        {"total", finding.total},
        {"surfaceShare", finding.surface_share},
        {"worstDegrees", finding.worst_deg},
        {"confidence", finding.confidence},
        {"vertices", finding.vertices},
        {"message", finding.message},
        {"remedy", finding.remedy},
    });
}

Json packedJson(const PackedFramesInfo& info) {
    const FrameErrorBound bound = frameErrorBound(info.format);
    return Json::object({
        {"place", info.place},
        {"attribute", info.attribute},
        {"format", frameFormatName(info.format)},
        {"mesh", info.mesh},
        {"primitive", info.primitive},
        {"vertices", info.vertex_count},
        {"readable", info.is_readable},
        {"compared", info.is_compared},
        {"worstNormalDegrees", info.worst_normal_deg},
        {"worstTangentDegrees", info.worst_tangent_deg},
        {"promisedNormalDegrees", bound.normal_deg},
        {"promisedTangentDegrees", bound.tangent_deg},
        {"differingSigns", info.differing_sign_count},
    });
}

Json checkedJson(const CheckOutcome& outcome) {
    Json json = fileJson(outcome);
    if (!outcome.result) return json;
    const CheckReport& report = *outcome.result;
    json["format"] = report.format;
    json["generator"] = report.generator;
    json["primitives"] = report.primitive_count;
    json["primitivesWithTangents"] = report.tangents_count;
    json["normalMaps"] = report.image_count;
    json["normalMapsWithGreen"] = report.green_count;
    json["counts"] =
        Json::object({{"error", report.error_count}, {"warning", report.warning_count}, {"note", report.note_count}});
    json["packedFrames"] = listJson(report.packed_frames, packedJson);
    json["findings"] = listJson(report.findings, findingJson);
    return json;
}

}  // namespace

std::string checkJson(const std::vector<CheckOutcome>& outcomes, ExitCode exit_code, Severity fail_on) {
    Json json = documentJson("tspace.check/1", exit_code == ExitCode::done, exit_code);
    json["failOn"] = severityName(fail_on);
    json["files"] = listJson(outcomes, checkedJson);
    return jsonText(json);
}

}  // namespace tspace::report
