// SPDX-License-Identifier: MIT
// Findings of tspace check in SARIF 2.1.0 (Static Analysis Results Interchange Format, OASIS 2020). docs/check.md says
// what stands where.
#include <filesystem>

#include "commands/check/check_report.h"
#include "model/io/path.h"
#include "tspace/version.h"

namespace tspace::report {
namespace {

/// Bytes that may not stand in a path of a URI (RFC 3986) as "%xx". A colon too: before the first slash it would end a
/// scheme.
std::string percentEncoded(const std::string& path) {
    constexpr const char* kDigits = "0123456789ABCDEF";
    std::string uri;
    for (const char c : path) {
        const auto byte = static_cast<unsigned char>(c);
        const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        if (is_letter || (c != '\0' && std::string("-._~/").find(c) != std::string::npos)) {
            uri += c;
        } else {
            uri += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
        }
    }
    return uri;
}

/// Relative paths stay relative, so that a CI system finds the file in its checkout.
Json artifactLocation(const std::string& input) {
    const std::filesystem::path path = std::filesystem::path(Path(input)).lexically_normal();
    const std::string text = Path(path).string();
    // file:///C:/model.glb
    if (path.is_absolute()) return {{"uri", (text.starts_with('/') ? "file://" : "file:///") + percentEncoded(text)}};
    return {{"uri", percentEncoded(text)}, {"uriBaseId", "%SRCROOT%"}};
}

/// A model has no lines. CI systems want one, and 1 is where they show what concerns the whole file.
Json physicalLocation(const std::string& input) {
    return {{"artifactLocation", artifactLocation(input)}, {"region", {{"startLine", 1}}}};
}

Json rulesJson(const std::string& docs_url) {
    Json rules = Json::array();
    for (std::uint32_t number = 0; number < kFindingCodeCount; ++number) {
        const auto code = static_cast<FindingCode>(number);
        rules.push_back({
            {"id", findingName(code)},
            {"shortDescription", {{"text", findingSummary(code)}}},
            {"help", {{"text", findingRemedy(code)}}},
            {"helpUri", docs_url + "/check.md#all-codes"},
        });
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
        {"message", {{"text", finding.message + ". " + finding.remedy}}},
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

/// A file that could not be read.
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
