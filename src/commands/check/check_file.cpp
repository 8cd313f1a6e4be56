// SPDX-License-Identifier: MIT
// checkFile: reads a scene, checks it and sorts the findings; its report as JSON.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "commands/check/check_image.h"
#include "commands/check/check_report.h"
#include "commands/check/findings.h"
#include "commands/check/remedy.h"
#include "commands/check/scene_checks.h"
#include "commands/check/scene_verdict.h"
#include "core/base/sort.h"
#include "model/io/file_error.h"
#include "model/read/read_scene.h"
#include "tspace/check.h"

namespace tspace {
namespace {

void checkOptions(const CheckOptions& options) {
    for (const double value : {options.direction_deg, options.error_deg, options.orthogonal_deg, options.split_deg,
                               options.unit_tolerance, options.error_share}) {
        if (!(value >= 0) || !std::isfinite(value))
            failFile(ErrorCode::invalidOption, "angles, tolerances and shares must be finite and not negative");
    }
}

/// Returns whether `generate --strip` would remove the tangents. It keeps them if a morph target moves only tangents.
bool canStrip(const ScenePrimitive& primitive) {
    return std::none_of(primitive.morph_targets.begin(), primitive.morph_targets.end(), [](const auto& target) {
        return !target.tangents.empty() && target.positions.empty() && target.normals.empty();
    });
}

/// Reports all unused tangents of the file in one note, instead of one note per primitive.
void joinUnused(const Scene& scene, std::span<PrimitiveJudgement> judgements, std::vector<Finding>& findings) {
    std::vector<Finding> unused;
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < judgements.size(); ++i) {
        total += !scene.primitives[i].tangents.empty();
        std::vector<Finding>& own = judgements[i].findings;
        const auto found = std::find_if(
            own.begin(), own.end(), [](const Finding& finding) { return finding.code == FindingCode::tangentsUnused; });
        if (found == own.end()) continue;
        if (canStrip(scene.primitives[i])) unused.push_back(std::move(*found));
        own.erase(found);
    }
    if (unused.size() <= 1) {
        std::move(unused.begin(), unused.end(), std::back_inserter(findings));
        return;
    }
    const Tally all{.count = unused.size(), .total = total};
    findings.push_back(
        makeFinding(FindingCode::tangentsUnused, Severity::note, all, "primitives",
                    {.cause = countText(all, "primitives with tangents") +
                              " do not need them, because none of their materials uses a texture in tangent space"}));
}

/// Converts a warning from reading the file to a finding about the whole file, without a primitive.
Finding fileRemark(const std::string& warning) {
    return makeFinding(FindingCode::fileRemark, Severity::note, Tally::all(1), "files", {.cause = warning});
}

/// Sorts and counts the findings, and writes their remedies as text.
void finishFindings(CheckReport& report) {
    formatRemedies(report.findings);
    sortStably(report.findings.begin(), report.findings.end(),
               [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
    for (const Finding& finding : report.findings) {
        report.error_count += finding.severity == Severity::error;
        report.warning_count += finding.severity == Severity::warning;
        report.note_count += finding.severity == Severity::note;
    }
}

}  // namespace

CheckedModel checkScene(const Scene& scene, const CheckOptions& options) {
    const auto reportProgress = [&](const char* what) {
        if (options.progress) options.progress(what, 0, 1);
    };
    CheckedModel checked;
    CheckReport& report = checked.report;
    report.format = scene.format;
    report.generator = scene.generator;
    report.primitive_count = scene.primitives.size();
    std::vector<PrimitiveJudgement> judgements = judgePrimitives(scene, options);
    ImageFindings images;
    reportProgress("checking normal maps");
    if (options.images) images = checkImages(scene, options);
    reportProgress("comparing primitives");
    report.image_count = images.examined_count;
    report.green_count = images.green_known_count;
    applyImageVerdicts(scene, options, images, judgements);
    setRemedies(scene, options, judgements);
    std::vector<Finding> unused;
    joinUnused(scene, judgements, unused);
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
        const ScenePrimitive& primitive = scene.primitives[i];
        report.tangents_count += !primitive.tangents.empty() && !primitive.corners.empty();
        const bool has_uvs = std::any_of(primitive.uv_sets.begin(), primitive.uv_sets.end(),
                                         [](const auto& set) { return !set.empty(); });
        checked.without_uvs_count += !primitive.corners.empty() && !has_uvs ? 1 : 0;
        std::move(judgements[i].findings.begin(), judgements[i].findings.end(), std::back_inserter(report.findings));
    }
    for (Finding& seam : checkSeams(scene, options)) report.findings.push_back(std::move(seam));
    std::move(unused.begin(), unused.end(), std::back_inserter(report.findings));
    PackedFindings packed = checkPacked(scene, options);
    report.packed_frames = std::move(packed.infos);
    std::move(packed.findings.begin(), packed.findings.end(), std::back_inserter(report.findings));
    for (Finding& finding : images.findings) report.findings.push_back(std::move(finding));
    for (Finding& finding : checkMapScales(scene)) report.findings.push_back(std::move(finding));
    for (std::size_t i = 0; i < scene.warnings.size(); ++i) {
        // The lengths of normals are already reported by a finding on each primitive.
        const std::vector<std::size_t>& known = scene.normals_warnings;
        if (std::find(known.begin(), known.end(), i) == known.end())
            report.findings.push_back(fileRemark(scene.warnings[i]));
    }
    finishFindings(report);
    return checked;
}

CheckedModel checkModel(const std::string& input, const CheckOptions& options) {
    checkOptions(options);
    if (isImageInput(input, options.file.content)) {
        CheckReport report = checkImageFile(input, options);
        finishFindings(report);
        return {.report = std::move(report)};
    }
    if (options.progress) options.progress("reading", 0, 1);
    const Scene scene = readScene(input, options.file, options.images);
    if (options.progress) options.progress("reading", 1, 1);
    return checkScene(scene, options);
}

Result<CheckReport> checkFile(const std::string& input, const CheckOptions& options) {
    return atFileBorder([&]() -> Result<CheckReport> { return checkModel(input, options).report; });
}

}  // namespace tspace

namespace tspace::report {

// Findings as JSON.

namespace {

Json commandJson(const RemedyCommand& command) {
    return Json::object({
        {"verb", command.verb},
        {"inputs", command.inputs},
        {"options", listJson(command.options,
                             [](const RemedyOption& option) {
                                 return Json::object({{"name", option.name}, {"value", option.value}});
                             })},
        {"placeholders", command.placeholders},
        {"line", commandLine(command)},
    });
}

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
        {"summary", findingSummary(finding.code)},
        {"effect", findingEffect(finding.code)},
        {"message", finding.message},
        {"cause", finding.cause},
        {"remedy", finding.remedy},
        {"show", findingView(finding.code)},
        {"commands", listJson(finding.commands, commandJson)},
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

}  // namespace

Json checkedFileJson(const CheckOutcome& outcome) {
    Json json = fileJson(outcome);
    if (!outcome.result) return json;
    const CheckReport& report = *outcome.result;
    json["primitives"] = report.primitive_count;
    json["primitivesWithTangents"] = report.tangents_count;
    json["normalMaps"] = report.image_count;
    json["normalMapsWithGreen"] = report.green_count;
    json["counts"] =
        Json::object({{"error", report.error_count}, {"warning", report.warning_count}, {"note", report.note_count}});
    json["image"] = nullptr;
    if (report.image)
        json["image"] = Json::object({{"width", report.image->width},
                                      {"height", report.image->height},
                                      {"content", report.image->content},
                                      {"green", report.image->green},
                                      {"greenConfidence", report.image->green_confidence}});
    json["packedFrames"] = listJson(report.packed_frames, packedJson);
    json["findings"] = listJson(report.findings, findingJson);
    return json;
}

std::string checkJson(const std::vector<CheckOutcome>& outcomes, ExitCode exit_code, Severity fail_on,
                      const Json& pictures) {
    Json json = documentJson("tspace.check/1", exit_code == ExitCode::done, exit_code);
    json["failOn"] = severityName(fail_on);
    json["files"] = listJson(outcomes, checkedFileJson);
    if (!pictures.is_null()) json["pictures"] = pictures;
    return jsonText(json);
}

}  // namespace tspace::report
