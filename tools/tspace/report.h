// SPDX-License-Identifier: MIT
// Results as text for people; as JSON for programs they are in the library (src/commands/shared/).
#pragma once

#include <string>
#include <vector>

#include "arguments.h"
#include "commands/shared/report.h"

namespace tspace::tool {

using report::CheckOutcome;
using report::GenerateOutcome;
using report::IdentifyOutcome;
using report::InspectOutcome;
using report::packedNames;

std::string generateText(const GenerateOutcome& outcome);
/// The same in one line, for one of several files.
std::string generateLine(const GenerateOutcome& outcome);
/// One line over several files.
std::string generateSummary(const std::vector<GenerateOutcome>& outcomes, double seconds);

std::string diffText(const DiffArguments& arguments, const FrameDiff& diff);

std::string identifyText(const IdentifyOutcome& outcome);

std::string inspectText(const InspectOutcome& outcome);

std::string checkText(const CheckOutcome& outcome, bool in_color);
/// A line over several files, and one for each code that was found.
std::string checkSummary(const std::vector<CheckOutcome>& outcomes, bool in_color);
std::string checkSarif(const std::vector<CheckOutcome>& outcomes, ExitCode exit_code);

}  // namespace tspace::tool
