// SPDX-License-Identifier: MIT
// Results of tspace check as text and as SARIF.
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include "commands/check/check_image.h"
#include "commands/check/check_report.h"
#include "commands/shared/text.h"
#include "model/io/path.h"
#include "model/io/uri.h"
#include "tspace/version.h"

namespace tspace::report {
namespace {

/// Maximum number of locations listed per kind of finding; the JSON contains all.
constexpr std::size_t kMaxPlaces = 5;

std::string countsText(std::uint64_t errors, std::uint64_t warnings, std::uint64_t notes) {
    return fmt::format("{}, {}, {}", counted(errors, "error"), counted(warnings, "warning"), counted(notes, "note"));
}

/// Lists the tests that normal maps were examined with. Flat maps have no relief that shows the direction of green.
std::string testsText(const CheckReport& report) {
    if (report.image_count == 0) return {};
    std::string text = fmt::format("; examined {}: channel contents", counted(report.image_count, "normal map"));
    if (report.green_count == report.image_count) return text + ", direction of green";
    if (report.green_count == 0) return text + "; the direction of green cannot be determined";
    return text + fmt::format(", direction of green in {} of them", report.green_count);
}

std::string summaryLine(const CheckOutcome& outcome) {
    const CheckReport& report = *outcome.result;
    const std::string what = report.findings.empty()
                                 ? "nothing found"
                                 : countsText(report.error_count, report.warning_count, report.note_count);
    if (report.image) return fmt::format("{}: {}; {}\n", unbroken(outcome.input), imageText(report), what);
    std::string text = fmt::format("{}: {} in {}, {} of them with tangents", unbroken(outcome.input), what,
                                   counted(report.primitive_count, "primitive"), report.tangents_count);
    return text + testsText(report) + "\n";
}

/// Returns the largest error of packed frames of one format, over all primitives that could be compared.
std::string packedText(std::span<const PackedFramesInfo> all, FrameFormat format) {
    PackedFramesInfo worst;
    std::uint64_t primitives = 0, compared = 0;
    for (const PackedFramesInfo& info : all) {
        if (info.format != format || !info.is_readable) continue;
        worst.attribute = info.attribute;
        ++primitives;
        compared += info.is_compared;
        worst.worst_normal_deg = std::max(worst.worst_normal_deg, info.worst_normal_deg);
        worst.worst_tangent_deg = std::max(worst.worst_tangent_deg, info.worst_tangent_deg);
        worst.differing_sign_count += info.differing_sign_count;
    }
    if (primitives == 0) return {};
    std::string text = fmt::format("  packed frames of {} in {}: ", counted(primitives, "primitive"), worst.attribute);
    if (compared == 0) return text + "there are no NORMAL and TANGENT to compare with\n";
    const FrameErrorBound bound = frameErrorBound(format);
    text += fmt::format(
        "N within {:.2g} degrees, T within {:.2g} ({} and {} guaranteed), {}", worst.worst_normal_deg,
        worst.worst_tangent_deg, bound.normal_deg, bound.tangent_deg,
        worst.differing_sign_count == 0 ? "all signs match" : counted(worst.differing_sign_count, "sign") + " differ");
    if (compared != primitives) text += fmt::format("; {} could not be compared", primitives - compared);
    return text + "\n";
}

std::string packedLines(std::span<const PackedFramesInfo> all) {
    std::string text;
    for (std::uint32_t format = 0; frameBytes(static_cast<FrameFormat>(format)) != 0; ++format)
        text += packedText(all, static_cast<FrameFormat>(format));
    return text;
}

std::string severityText(Severity severity, bool in_color) {
    const std::string name = fmt::format("{:<7}", severityName(severity));
    if (!in_color) return name;
    const int color = severity == Severity::error ? 31 : severity == Severity::warning ? 33 : 36;
    return fmt::format("\033[1;{}m{}\033[0m", color, name);
}

std::string whereText(const Finding& finding) {
    std::string text = fmt::format("mesh {}", finding.mesh);
    if (!finding.mesh_name.empty()) text += fmt::format(" \"{}\"", printable(finding.mesh_name));
    text += fmt::format(", primitive {}", finding.primitive);
    if (!finding.material_name.empty()) text += fmt::format(", material \"{}\"", printable(finding.material_name));
    return text;
}

std::string verticesText(const Finding& finding) {
    if (finding.vertices.empty()) return {};
    return fmt::format("        first at {} {}\n", finding.vertices.size() == 1 ? "vertex" : "vertices",
                       fmt::join(finding.vertices, ", "));
}

/// Formats findings with equal code, severity and remedy.
std::string groupText(std::span<const Finding* const> group, bool in_color) {
    const Finding& first = *group.front();
    std::string text = fmt::format("\n  {}  {}", severityText(first.severity, in_color), findingName(first.code));
    if (first.confidence < 1) text += fmt::format(" (confidence {:.0f} %)", 100 * first.confidence);
    if (group.size() > 1) text += fmt::format(", {} places", group.size());
    text += "\n";
    for (std::size_t i = 0; i < group.size() && i < kMaxPlaces; ++i) {
        if (!group[i]->place.empty())
            text += fmt::format("      {} (at {})\n", whereText(*group[i]), unbroken(group[i]->place));
        // If consecutive locations have the same message, it is printed once, below the last of them.
        const bool is_shared = i + 1 < std::min(group.size(), kMaxPlaces) &&
                               group[i + 1]->message == group[i]->message && !group[i]->place.empty();
        if (!is_shared) text += fmt::format("        {}\n", printable(group[i]->message));
        if (group.size() == 1) text += verticesText(first);
    }
    if (group.size() > kMaxPlaces) text += fmt::format("      and {} more\n", group.size() - kMaxPlaces);
    return text + fmt::format("      fix: {}\n", first.remedy);
}

}  // namespace

std::string checkText(const CheckOutcome& outcome, bool in_color) {
    std::string text = summaryLine(outcome) + packedLines(outcome.result->packed_frames);
    // Groups are sorted by severity, and then by code in the order of first occurrence.
    std::vector<std::vector<const Finding*>> groups;
    for (const Finding& finding : outcome.result->findings) {
        const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& candidate) {
            const Finding& first = *candidate.front();
            return first.code == finding.code && first.severity == finding.severity && first.remedy == finding.remedy;
        });
        if (group != groups.end()) {
            group->push_back(&finding);
        } else {
            groups.push_back({&finding});
        }
    }
    for (const auto& group : groups) text += groupText(group, in_color);
    return text;
}

std::string checkSummary(const std::vector<CheckOutcome>& outcomes, bool in_color) {
    std::uint64_t errors = 0, warnings = 0, notes = 0, clean = 0, unread = 0;
    struct Occurrence {
        std::uint64_t file_count = 0, finding_count = 0;
        const CheckOutcome* last_file = nullptr;
    };
    std::map<std::pair<int, FindingCode>, Occurrence> codes;  // most severe first
    for (const CheckOutcome& outcome : outcomes) {
        if (!outcome.result) {
            ++unread;
            continue;
        }
        errors += outcome.result->error_count;
        warnings += outcome.result->warning_count;
        notes += outcome.result->note_count;
        clean += outcome.result->error_count == 0;
        for (const Finding& finding : outcome.result->findings) {
            Occurrence& code = codes[{-static_cast<int>(finding.severity), finding.code}];
            ++code.finding_count;
            code.file_count += code.last_file != &outcome;
            code.last_file = &outcome;
        }
    }
    std::string text = fmt::format("\n{}: {}; {} without errors", counted(outcomes.size(), "file"),
                                   countsText(errors, warnings, notes), clean);
    if (unread > 0) text += fmt::format(", {} could not be read", unread);
    text += "\n";
    for (const auto& [key, code] : codes) {
        text += fmt::format("  {}  {:<24} {} in {}\n", severityText(static_cast<Severity>(-key.first), in_color),
                            findingName(key.second), counted(code.finding_count, "finding"),
                            counted(code.file_count, "file"));
    }
    return text;
}

// Findings of tspace check in SARIF 2.1.0 (Static Analysis Results Interchange Format, OASIS 2020).
// docs/reference/check.md describes the mapping.

namespace {

/// Encodes a path for readers of URIs (RFC 3986). Colons are encoded too: before the first slash, a colon would end a
/// scheme.
std::string percentEncoded(const std::string& path) { return percentEncode(path, "-._~/"); }

/// Returns the URI of a file. Relative paths stay relative, so that a CI system finds the file in its checkout.
Json artifactLocation(const std::string& input) {
    const std::filesystem::path path = std::filesystem::path(Path(input)).lexically_normal();
    const std::string text = Path(path).string();
    // On Windows, a slash must be added: file:///C:/model.glb.
    if (path.is_absolute()) return {{"uri", (text.starts_with('/') ? "file://" : "file:///") + percentEncoded(text)}};
    return {{"uri", percentEncoded(text)}, {"uriBaseId", "%SRCROOT%"}};
}

/// Models have no lines, but CI systems require one. They show findings about a whole file at line 1.
Json physicalLocation(const std::string& input) {
    return {{"artifactLocation", artifactLocation(input)}, {"region", {{"startLine", 1}}}};
}

Json rulesJson(const std::string& docs_url) {
    Json rules = Json::array();
    for (std::uint32_t number = 0; number < kFindingCodeCount; ++number) {
        const auto code = static_cast<FindingCode>(number);
        Json rule = {{"id", findingName(code)},
                     {"shortDescription", {{"text", findingSummary(code)}}},
                     {"help", {{"text", findingRemedy(code)}}}};
        if (!docs_url.empty()) rule["helpUri"] = docs_url + "/reference/check.md#" + findingName(code);
        rules.push_back(std::move(rule));
    }
    return rules;
}

Json resultJson(const std::string& input, const Finding& finding) {
    Json location = {{"physicalLocation", physicalLocation(input)}};
    if (!finding.place.empty()) {
        Json logical = {{"fullyQualifiedName", finding.place}};
        if (!finding.mesh_name.empty()) logical["name"] = finding.mesh_name;
        location["logicalLocations"] = Json::array({std::move(logical)});
    }
    return {
        {"ruleId", findingName(finding.code)},
        {"ruleIndex", static_cast<std::uint32_t>(finding.code)},
        {"level", severityName(finding.severity)},
        {"message",
         {{"text",
           (finding.place.empty() ? "" : whereText(finding) + ": ") + finding.message + ". " + finding.remedy}}},
        {"locations", Json::array({std::move(location)})},
        {"properties",
         {{"mesh", finding.mesh},
          {"primitive", finding.primitive},
          {"materialName", finding.material_name},
          {"unit", finding.unit},
          {"count", finding.count},
          {"total", finding.total},
          {"surfaceShare", finding.surface_share},
          {"confidence", finding.confidence}}},
    };
}

/// Describes a file that could not be read.
Json notificationJson(const CheckOutcome& outcome) {
    const Error& error = outcome.result.error();
    std::string text = error.message;
    if (!error.place.empty()) text += " (at " + error.place + ")";
    return {
        {"level", "error"},
        {"message", {{"text", text}}},
        {"locations", Json::array({{{"physicalLocation", physicalLocation(outcome.input)}}})},
    };
}

}  // namespace

std::string checkSarif(const std::vector<CheckOutcome>& outcomes, ExitCode exit_code, const std::string& docs_url) {
    Json results = Json::array();
    Json notifications = Json::array();
    for (const CheckOutcome& outcome : outcomes) {
        if (!outcome.result) {
            notifications.push_back(notificationJson(outcome));
            continue;
        }
        for (const Finding& finding : outcome.result->findings) results.push_back(resultJson(outcome.input, finding));
    }
    const bool all_read = notifications.empty();
    const Json driver = {{"name", "tspace"}, {"version", TSPACE_VERSION_STRING}, {"rules", rulesJson(docs_url)}};
    const Json invocation = {{"executionSuccessful", all_read},
                             {"exitCode", static_cast<int>(exit_code)},
                             {"toolExecutionNotifications", std::move(notifications)}};
    const Json run = {
        {"tool", {{"driver", driver}}}, {"invocations", Json::array({invocation})}, {"results", std::move(results)}};
    const Json document = {{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                           {"version", "2.1.0"},
                           {"runs", Json::array({run})}};
    return jsonText(document);
}

}  // namespace tspace::report
