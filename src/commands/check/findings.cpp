// SPDX-License-Identifier: MIT
// Converts tallies to findings, formats their texts, and creates the findings on tangents.
#include "commands/check/findings.h"

#include <cmath>

#include "commands/check/frame_health.h"
#include "commands/check/remedy.h"
#include "commands/check/scene_checks.h"
#include "core/base/numbers.h"

namespace tspace {
const char* severityName(Severity severity) {
    switch (severity) {
        case Severity::note: return "note";
        case Severity::warning: return "warning";
        case Severity::error: return "error";
    }
    return "";
}

Finding makeFinding(FindingCode code, Severity severity, const Tally& tally, const char* unit, FindingText text) {
    Finding finding;
    finding.code = code;
    finding.severity = severity;
    finding.unit = unit;
    finding.count = tally.count;
    finding.total = tally.total;
    finding.surface_share = tally.surface_share;
    finding.worst_deg = tally.worst_deg;
    finding.vertices = tally.vertices;
    finding.message = text.symptom.empty() ? text.cause : text.symptom + ": " + text.cause;
    finding.cause = std::move(text.cause);
    setRemedy(finding, usualRemedy(code));
    return finding;
}

void extendCause(Finding& finding, const std::string& more) {
    finding.cause += more;
    finding.message += more;
}

void placeAt(const ScenePrimitive& primitive, const std::string& place, Finding& finding) {
    finding.place = place;
    finding.mesh = primitive.mesh;
    finding.primitive = primitive.primitive;
    finding.mesh_name = primitive.mesh_name;
    finding.material_name = primitive.material_name;
}

Severity onShare(Severity severity, double surface_share, const CheckOptions& options) {
    return severity == Severity::error && surface_share < options.error_share ? Severity::warning : severity;
}

std::string decimalText(double value) {
    // Numbers have one decimal, independent of the locale.
    const auto tenths = static_cast<std::uint64_t>(std::llround(value * 10));
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10);
}

std::string stepText(double value) {
    constexpr double kMin = 1e-9, kMax = 1e15;
    if (value >= kMax || (value > 0 && value < kMin)) return shortNumber(value);
    if (value >= 10) return std::to_string(static_cast<std::uint64_t>(std::llround(value)));
    int digits = 1;
    for (double scaled = value; scaled > 0 && scaled < 1 && digits < 12; scaled *= 10) ++digits;
    auto number = static_cast<std::uint64_t>(std::llround(value * std::pow(10, digits)));
    while (digits > 0 && number % 10 == 0) {
        number /= 10;
        --digits;
    }
    std::string text = std::to_string(number);
    if (digits == 0) return text;
    const auto behind = static_cast<std::size_t>(digits);
    if (text.size() <= behind) text = std::string(behind + 1 - text.size(), '0') + text;
    return text.substr(0, text.size() - behind) + "." + text.substr(text.size() - behind);
}

std::string countText(const Tally& tally, const char* unit) {
    const std::string total = std::to_string(tally.total) + " " + unit;
    if (tally.count == tally.total) return "all " + total;
    return std::to_string(tally.count) + " of " + total;
}

std::string shareText(double share) {
    if (share > 0 && share < 0.001) return "less than 0.1 %";
    return decimalText(share * 100) + " %";
}

// Findings on the tangents of one mesh.

namespace {

constexpr const char* kVertices = "vertices";
constexpr const char* kTriangles = "triangles";

std::string onSurface(const Tally& tally) { return " (" + shareText(tally.surface_share) + " of the surface)"; }

class FindingList {
  public:
    explicit FindingList(const CheckOptions& options) : options_(options) {}

    void add(FindingCode code, Severity severity, const Tally& tally, const char* unit, FindingText text) {
        if (tally.count == 0) return;
        findings.push_back(
            makeFinding(code, onShare(severity, tally.surface_share, options_), tally, unit, std::move(text)));
    }

    /// Adds a finding for any number of vertices, regardless of their share of the surface.
    void addWhole(FindingCode code, Severity severity, const Tally& tally, FindingText text) {
        if (tally.count != 0) findings.push_back(makeFinding(code, severity, tally, kVertices, std::move(text)));
    }

    std::vector<Finding> findings = {};

  private:
    const CheckOptions& options_;
};

void addValues(const FrameHealth& health, const CheckOptions& options, FindingList& list) {
    const auto severity = [&](double bad_share) {
        return bad_share >= options.error_share ? Severity::error : Severity::warning;
    };
    list.addWhole(FindingCode::tangentsNotFinite, health.has_not_finite ? Severity::error : Severity::warning,
                  health.not_finite,
                  {.symptom = "the surface has black or flickering spots",
                   .cause = "the tangents of " + countText(health.not_finite, kVertices) + " are NaN or infinite"});
    list.addWhole(FindingCode::tangentsNotUnit, health.has_zero ? Severity::error : severity(health.far_from_unit),
                  health.not_unit,
                  {.symptom = "the relief looks too strong or too weak",
                   .cause = "the tangents of " + countText(health.not_unit, kVertices) + " do not have unit length" +
                            (health.has_zero ? ", some have length 0" : "") + onSurface(health.not_unit)});
    Tally all_tilted = health.not_orthogonal;
    if (health.parallel_apart) {
        list.addWhole(
            FindingCode::tangentsNotOrthogonal, Severity::error, health.parallel,
            {.symptom = "the relief vanishes or turns black",
             .cause = "the tangents of " + countText(health.parallel, kVertices) +
                      " are parallel to the normal, so the bitangent is undefined" + onSurface(health.parallel)});
    } else {
        all_tilted.include(health.parallel);
    }
    const bool is_parallel =
        !health.parallel_apart && health.parallel.surface_share >= options.error_share && health.parallel.count != 0;
    list.addWhole(
        FindingCode::tangentsNotOrthogonal, is_parallel ? Severity::error : Severity::warning, all_tilted,
        {.symptom = "the relief may look tilted",
         .cause = "the tangents of " + countText(all_tilted, kVertices) +
                  " are not perpendicular to the normal; they deviate by up to " + decimalText(all_tilted.worst_deg) +
                  " degrees" +
                  (is_parallel ? "; " + std::to_string(health.parallel.count) + " of them are parallel to it" : "") +
                  onSurface(all_tilted)});
    list.addWhole(FindingCode::signsNotOne, health.sign_vanishes ? Severity::error : Severity::warning,
                  health.sign_not_one,
                  {.symptom = "the relief may look too strong, too weak or flat",
                   .cause = "the sign (w) of " + countText(health.sign_not_one, kVertices) + " is neither +1 nor -1"});
}

void addSigns(const FrameHealth& health, FindingList& list) {
    if (health.all_signs_wrong) {
        list.add(FindingCode::signsInverted, Severity::error, health.signs_wrong, kVertices,
                 {.symptom = "bumps look like dents along v",
                  .cause = "every sign is inverted, so w is the opposite of what the UVs require at " +
                           countText(health.signs_wrong, kVertices)});
    } else {
        list.add(FindingCode::signsWrong, Severity::error, health.signs_wrong, kVertices,
                 {.symptom = "bumps look like dents in places",
                  .cause = "the sign (w) of " + countText(health.signs_wrong, kVertices) +
                           " is the opposite of what the UVs require" + onSurface(health.signs_wrong)});
    }
    list.add(
        FindingCode::signsMixed, Severity::error, health.signs_mixed, kTriangles,
        {.symptom = "triangles have dark spots",
         .cause = "the corners of " + countText(health.signs_mixed, kTriangles) +
                  " have different signs, so the bitangent vanishes between them" + onSurface(health.signs_mixed)});
    list.add(FindingCode::mirroredSeamAveraged, Severity::error, health.mirrored_seams, kVertices,
             {.symptom = "a seam is visible along a mirrored UV border",
              .cause = "both sides share one tangent at " + countText(health.mirrored_seams, kVertices) +
                       onSurface(health.mirrored_seams)});
}

void addDirections(const FrameHealth& health, const CheckOptions& options, FindingList& list) {
    const auto severity = [&](const Tally& tally) {
        if (health.far_directions >= options.error_share) return Severity::error;
        return tally.surface_share >= options.error_share ? Severity::warning : Severity::note;
    };
    list.add(FindingCode::uvSeamAveraged, severity(health.uv_seams), health.uv_seams, kVertices,
             {.symptom = "a seam is visible along a UV border",
              .cause = "the tangents of " + countText(health.uv_seams, kVertices) +
                       " are averaged over both sides and fit neither; they deviate by up to " +
                       decimalText(health.uv_seams.worst_deg) + " degrees" + onSurface(health.uv_seams)});
    list.add(
        FindingCode::directionsWrong, severity(health.directions_wrong), health.directions_wrong, kVertices,
        {.symptom = "the relief is lit from the wrong direction",
         .cause = "the tangents of " + countText(health.directions_wrong, kVertices) +
                  " do not point along increasing u; they deviate by up to " +
                  decimalText(health.directions_wrong.worst_deg) + " degrees" + onSurface(health.directions_wrong)});
    list.add(FindingCode::splitFramesDiffer, Severity::warning, health.frames_differ, kVertices,
             {.symptom = "an edge is visible on a smooth surface",
              .cause = countText(health.frames_differ, kVertices) +
                       " equal another vertex in position, normal and UV, but have a different tangent"});
}

}  // namespace

std::vector<Finding> tangentFindings(const FrameHealth& health, const CheckOptions& options) {
    FindingList list(options);
    addValues(health, options, list);
    addSigns(health, list);
    addDirections(health, options, list);
    return std::move(list.findings);
}

std::string whyTangentsAreWrong(const FrameHealth& health, const CheckOptions& options) {
    for (Finding& finding : tangentFindings(health, options)) {
        if (finding.severity == Severity::error) return std::move(finding.message);
    }
    return {};
}

}  // namespace tspace
