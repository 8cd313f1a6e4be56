// SPDX-License-Identifier: MIT
// What tspace generate reports.
#pragma once

#include <string>
#include <vector>

#include "commands/shared/report.h"
#include "tspace/asset.h"

namespace tspace::report {

using GenerateOutcome = Outcome<GenerateReport>;

std::string generateJson(const std::vector<GenerateOutcome>& outcomes, ExitCode exit_code, double seconds);

std::string generateText(const GenerateOutcome& outcome);
/// In one line, for one of several files.
std::string generateLine(const GenerateOutcome& outcome);
/// Totals over several files.
std::string generateSummary(const std::vector<GenerateOutcome>& outcomes, double seconds);

}  // namespace tspace::report
