// SPDX-License-Identifier: MIT
// Common parts of the reports of all commands. NAME/NAME_report.h declares the reports of a single command, as JSON and
// as text. The tool prints JSON with --json, and the C API returns it (docs/reference/json.md). Only the tool prints
// text, whose code is in a separate library (tspace_texts).
#pragma once

#include <cstdint>
#include <string>

#include "commands/shared/exit_code.h"
#include "model/json/json.h"
#include "tspace/map_files.h"
#include "tspace/result.h"

namespace tspace::report {

/// Outcome of a call on one file: a value, or an error.
template <class Value>
struct Outcome {
    std::string input = {};
    std::string output = {};  ///< empty for calls that write nothing
    Result<Value> result = Error{};
    double seconds = 0;
    bool is_dry_run = false;       ///< nothing was written
    bool was_done_before = false;  ///< unchanged since an earlier run, according to the manifest; the value is empty
};

/// Returns null, or the error as described by docs/reference/json.md.
Json errorJson(const Error* error);
/// Returns null if there is no mesh.
Json mapMeshJson(const MapMeshReport& mesh);
/// Returns the first members of every document.
Json documentJson(const char* schema, bool is_ok, ExitCode exit_code);
/// Returns the first members of the report of a file: its name and its error, or its format and generator.
template <class Value>
Json fileJson(const Outcome<Value>& outcome) {
    Json json = {{"input", outcome.input},
                 {"ok", outcome.result.ok()},
                 {"error", errorJson(outcome.result ? nullptr : &outcome.result.error())}};
    if (!outcome.result) return json;
    json["format"] = outcome.result->format;
    json["generator"] = outcome.result->generator;
    return json;
}
/// Returns the first members of the document of a command with one input and one output.
template <class Value>
Json madeFileJson(const char* schema, const Outcome<Value>& outcome, ExitCode exit_code) {
    Json json = documentJson(schema, outcome.result.ok(), exit_code);
    json["input"] = outcome.input;
    json["output"] = outcome.output;
    json["dryRun"] = outcome.is_dry_run;
    json["error"] = errorJson(outcome.result ? nullptr : &outcome.result.error());
    return json;
}
/// Returns an array of toJson(value) for each value.
template <class List, class ToJson>
Json listJson(const List& values, ToJson toJson) {
    Json list = Json::array();
    for (const auto& value : values) list.push_back(toJson(value));
    return list;
}

/// Returns the document as text. Bytes that are not valid UTF-8 (from file names) become U+FFFD.
std::string jsonText(const Json& document);

/// Formats a count with its noun: "1 corner", "2 corners".
std::string counted(std::uint64_t count, const char* noun);

}  // namespace tspace::report
