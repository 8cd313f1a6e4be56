// SPDX-License-Identifier: MIT
// Results as JSON for programs, as docs/json.md describes it: what the tool prints with --json, and the C API gives back.
#pragma once

#include <string>
#include <vector>

#include "commands/shared/exit_code.h"
#include "model/json/json.h"
#include "tspace/asset.h"
#include "tspace/bake_file.h"
#include "tspace/check.h"
#include "tspace/diff.h"
#include "tspace/flip_green.h"
#include "tspace/identify.h"
#include "tspace/map_convert_file.h"
#include "tspace/map_height_file.h"
#include "tspace/render.h"

namespace tspace::report {

/// What became of one file: a value, or an error.
template <class Value>
struct Outcome {
    std::string input = {};
    std::string output = {};  ///< empty for calls that write nothing
    Result<Value> result = Error{};
    double seconds = 0;
    bool is_dry_run = false;       ///< nothing was written
    bool was_done_before = false;  ///< by the manifest; nothing changed, nothing was done, the value is empty
};
using GenerateOutcome = Outcome<GenerateReport>;
using IdentifyOutcome = Outcome<Identification>;
using InspectOutcome = Outcome<Inspection>;
using CheckOutcome = Outcome<CheckReport>;

std::string generateJson(const std::vector<GenerateOutcome>& outcomes, ExitCode exit_code, double seconds);
std::string identifyJson(const std::vector<IdentifyOutcome>& outcomes, ExitCode exit_code);
std::string inspectJson(const std::vector<InspectOutcome>& outcomes, ExitCode exit_code);
std::string checkJson(const std::vector<CheckOutcome>& outcomes, ExitCode exit_code, Severity fail_on);
/// Of the models `a` and `b`.
std::string diffJson(const std::string& a, const std::string& b, double tolerance_deg, const Result<FrameDiff>& diff,
                     ExitCode exit_code);
std::string bakeJson(const Outcome<BakeFileReport>& outcome, const std::string& high, ExitCode exit_code);
/// Of the map `outcome`.input.
std::string mapErrorJson(const Outcome<MapErrorFileReport>& outcome, const std::string& low, const std::string& high,
                         ExitCode exit_code);
std::string flipGreenJson(const Outcome<FlipGreenReport>& outcome, ExitCode exit_code);
std::string renderJson(const Outcome<RenderReport>& outcome, ExitCode exit_code);
std::string convertMapJson(const Outcome<ConvertMapFileReport>& outcome, ExitCode exit_code);
std::string heightToNormalJson(const Outcome<HeightToNormalFileReport>& outcome, ExitCode exit_code);

/// null, or the error as docs/json.md describes it.
Json errorJson(const Error* error);
/// null where there is no mesh.
Json mapMeshJson(const MapMeshReport& mesh);
/// How every document begins.
Json documentJson(const char* schema, bool is_ok, ExitCode exit_code);
/// How what is said of a file begins: its name, and the error if there is one.
template <class Value>
Json fileJson(const Outcome<Value>& outcome) {
    return {{"input", outcome.input},
            {"ok", outcome.result.ok()},
            {"error", errorJson(outcome.result ? nullptr : &outcome.result.error())}};
}
/// An array of what `toJson` makes of each value.
template <class List, class ToJson>
Json listJson(const List& values, ToJson toJson) {
    Json list = Json::array();
    for (const auto& value : values) list.push_back(toJson(value));
    return list;
}

/// The document as text. Bytes that are not UTF-8 (from file names) become U+FFFD.
std::string jsonText(const Json& document);

/// The names of the formats of packed frames that a primitive has.
std::vector<std::string> packedNames(const PrimitiveInfo& primitive);
/// "PNG", "JPEG" or "WebP".
const char* imageFormatName(ImageFileFormat format);

}  // namespace tspace::report
