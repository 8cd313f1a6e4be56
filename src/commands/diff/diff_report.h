// SPDX-License-Identifier: MIT
// Reports of tspace diff as JSON and as text. diff_page.h in pages has the HTML page.
#pragma once

#include <string>
#include <vector>

#include "commands/shared/report.h"
#include "tspace/inspect.h"

namespace tspace::report {

/// Returns the report on the models `a` and `b` as JSON.
std::string diffJson(const std::string& a, const std::string& b, double tolerance_deg, const Result<FrameDiff>& diff,
                     ExitCode exit_code);
std::string diffText(const std::string& a, const std::string& b, const FrameDiff& diff);

// A comparison as sentences and tables, for a terminal or a page.

/// Rows of cells; the first row is the header. An empty list means no table.
using TextTable = std::vector<std::vector<std::string>>;

/// Sentences and tables of a comparison. Names from files are not escaped.
struct DiffWords {
    std::string summary = {};               ///< "A against B: ..."
    std::vector<std::string> remarks = {};  ///< further sentences of the report
    TextTable angles = {};                  ///< angles of the whole file
    TextTable primitives = {};
    TextTable worst = {};
};

/// Returns the report as sentences and tables. `a`, `b`: names of the files.
DiffWords diffWords(const std::string& a, const std::string& b, const FrameDiff& diff);

/// Returns the label of a bin of kAngleBins, such as "up to 0.1".
std::string binText(std::size_t bin);

}  // namespace tspace::report
