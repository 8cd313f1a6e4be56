// SPDX-License-Identifier: MIT
// What tspace diff reports, as JSON, as text and in words. As a page it is in pages/diff_page.h.
#pragma once

#include <string>
#include <vector>

#include "commands/shared/report.h"
#include "tspace/inspect.h"

namespace tspace::report {

/// Report on the models `a` and `b`.
std::string diffJson(const std::string& a, const std::string& b, double tolerance_deg, const Result<FrameDiff>& diff,
                     ExitCode exit_code);
std::string diffText(const std::string& a, const std::string& b, const FrameDiff& diff);

// A comparison in words and tables for people, on a terminal or a page.

/// Rows of cells, of which the first is the head; empty: there is nothing to show.
using TextTable = std::vector<std::vector<std::string>>;

/// Names from files are not escaped.
struct DiffWords {
    std::string summary = {};               ///< "A against B: ..."
    std::vector<std::string> remarks = {};  ///< further sentences
    TextTable angles = {};                  ///< angles over the whole file
    TextTable primitives = {};
    TextTable worst = {};
};

/// `a`, `b`: the names of the files.
DiffWords diffWords(const std::string& a, const std::string& b, const FrameDiff& diff);

/// "up to 0.1": the angles in a bin of kAngleBins.
std::string binText(std::size_t bin);

}  // namespace tspace::report
