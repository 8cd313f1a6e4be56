// SPDX-License-Identifier: MIT
// What the reports of all commands have in common. A command's own are in NAME/NAME_report.h: as JSON for programs, as
// docs/reference/json.md describes it, which the tool prints with --json and the C API gives back; and as text for people, which the
// tool alone prints, and which needs a library of its own (tspace_texts).
#pragma once

#include <cstdint>
#include <string>

#include "commands/shared/exit_code.h"
#include "model/json/json.h"
#include "tspace/map_files.h"
#include "tspace/result.h"

namespace tspace::report {

/// The outcome of a call on one file: a value, or an error.
template <class Value>
struct Outcome {
    std::string input = {};
    std::string output = {};  ///< empty for calls that write nothing
    Result<Value> result = Error{};
    double seconds = 0;
    bool is_dry_run = false;       ///< dry run: nothing was written
    bool was_done_before = false;  ///< the manifest says so, and no file has changed since; the value is empty
};

/// null, or the error as docs/reference/json.md describes it.
Json errorJson(const Error* error);
/// null where there is no mesh.
Json mapMeshJson(const MapMeshReport& mesh);
/// The members with which every document begins.
Json documentJson(const char* schema, bool is_ok, ExitCode exit_code);
/// The members with which the report of a file begins: its name, the error if there is one, else what wrote it.
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
/// The members with which the document of a command begins that makes one file of one file.
template <class Value>
Json madeFileJson(const char* schema, const Outcome<Value>& outcome, ExitCode exit_code) {
    Json json = documentJson(schema, outcome.result.ok(), exit_code);
    json["input"] = outcome.input;
    json["output"] = outcome.output;
    json["dryRun"] = outcome.is_dry_run;
    json["error"] = errorJson(outcome.result ? nullptr : &outcome.result.error());
    return json;
}
/// An array of toJson(value) for each value.
template <class List, class ToJson>
Json listJson(const List& values, ToJson toJson) {
    Json list = Json::array();
    for (const auto& value : values) list.push_back(toJson(value));
    return list;
}

/// The document as text. Bytes that are not UTF-8 (from file names) become U+FFFD.
std::string jsonText(const Json& document);

/// "1 corner", "2 corners".
std::string counted(std::uint64_t count, const char* noun);

}  // namespace tspace::report
