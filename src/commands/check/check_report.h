// SPDX-License-Identifier: MIT
// Reports of tspace check as JSON, SARIF and text. pages/check_page.h declares the HTML report.
#pragma once

#include <string>
#include <vector>

#include "commands/shared/report.h"
#include "tspace/check.h"

namespace tspace::report {

using CheckOutcome = Outcome<CheckReport>;

/// Returns the JSON of one file in the report.
Json checkedFileJson(const CheckOutcome& outcome);
/// `pictures`: pictures of the findings, or null.
std::string checkJson(const std::vector<CheckOutcome>& outcomes, ExitCode exit_code, Severity fail_on,
                      const Json& pictures = nullptr);
/// Returns the report as SARIF 2.1.0, for CI systems. `docs_url`: location of docs/, which each rule links to.
std::string checkSarif(const std::vector<CheckOutcome>& outcomes, ExitCode exit_code, const std::string& docs_url);

std::string checkText(const CheckOutcome& outcome, bool in_color);
/// Returns totals over several files, and one line for each code that was found.
std::string checkSummary(const std::vector<CheckOutcome>& outcomes, bool in_color);

}  // namespace tspace::report
