// SPDX-License-Identifier: MIT
// Results as text for people and as JSON for programs.
#pragma once

#include <string>
#include <vector>

#include "arguments.h"
#include "exit_code.h"
#include "jobs.h"
#include "json/json.h"

namespace tspace::tool {

/// What became of one job: a value, or an error.
template <class Value>
struct Outcome {
    Job job = {};
    Result<Value> result = Error{};
    double seconds = 0;
    bool is_dry_run = false;       ///< nothing was written
    bool was_done_before = false;  ///< by the manifest; nothing changed, nothing was done, the value is empty
};
using GenerateOutcome = Outcome<GenerateReport>;
using IdentifyOutcome = Outcome<Identification>;
using InspectOutcome = Outcome<Inspection>;
using CheckOutcome = Outcome<CheckReport>;

std::string generateText(const GenerateOutcome& outcome);
/// The same in one line, for one of several files.
std::string generateLine(const GenerateOutcome& outcome);
std::string generateJson(const std::vector<GenerateOutcome>& outcomes, ExitCode exit_code, double seconds);
/// One line over several files.
std::string generateSummary(const std::vector<GenerateOutcome>& outcomes, double seconds);

std::string diffText(const DiffArguments& arguments, const FrameDiff& diff);
std::string diffJson(const DiffArguments& arguments, const Result<FrameDiff>& diff, ExitCode exit_code);

std::string identifyText(const IdentifyOutcome& outcome);
std::string identifyJson(const std::vector<IdentifyOutcome>& outcomes, ExitCode exit_code);

std::string inspectText(const InspectOutcome& outcome);
std::string inspectJson(const std::vector<InspectOutcome>& outcomes, ExitCode exit_code);

std::string checkText(const CheckOutcome& outcome, bool in_color);
std::string checkJson(const std::vector<CheckOutcome>& outcomes, ExitCode exit_code, Severity fail_on);
/// A line over several files, and one for each code that was found.
std::string checkSummary(const std::vector<CheckOutcome>& outcomes, bool in_color);
std::string checkSarif(const std::vector<CheckOutcome>& outcomes, ExitCode exit_code);

/// null, or the error as docs/json.md describes it.
Json errorJson(const Error* error);
/// The document as text. Bytes that are not UTF-8 (from file names) become U+FFFD.
std::string jsonText(const Json& document);

}  // namespace tspace::tool
