// SPDX-License-Identifier: MIT
// What tspace check reports. As a page it is in pages/check_page.h.
#pragma once

#include <string>
#include <vector>

#include "commands/shared/report.h"
#include "tspace/check.h"

namespace tspace::report {

using CheckOutcome = Outcome<CheckReport>;

/// JSON of one file in the report.
Json checkedFileJson(const CheckOutcome& outcome);
std::string checkJson(const std::vector<CheckOutcome>& outcomes, ExitCode exit_code, Severity fail_on);
/// Report as SARIF 2.1.0, for CI systems. `docs_url`: location of docs/, which each rule links to.
std::string checkSarif(const std::vector<CheckOutcome>& outcomes, ExitCode exit_code, const std::string& docs_url);

std::string checkText(const CheckOutcome& outcome, bool in_color);
/// Totals over several files, and a line for each code that was found.
std::string checkSummary(const std::vector<CheckOutcome>& outcomes, bool in_color);

}  // namespace tspace::report
