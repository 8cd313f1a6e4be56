// SPDX-License-Identifier: MIT
// Findings as a page for people.
#pragma once

#include <string>
#include <vector>

#include "commands/check/check_report.h"

namespace tspace {

/// One HTML file that needs nothing else: a summary, an overview where there are several files, and of each file its
/// findings, with pictures of their places before and after the remedy where that can be shown. Files are read once more
/// for the pictures, as `file` says; of one that cannot be, such as stdin, there are none. All text from files is
/// escaped. Pictures of one file take 1.5 MB at most, and of all 12 MB; then findings come without.
std::string checkPage(const std::vector<report::CheckOutcome>& outcomes, const FileOptions& file);

}  // namespace tspace
