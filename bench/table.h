// SPDX-License-Identifier: MIT
// The table of targets.
#pragma once

#include <string>

#include "rows.h"

namespace tspace::bench {

struct TableOptions {
    std::string pattern = {};  ///< regular expression for titles and sections of rows; empty: all rows
    std::string json = {};     ///< file, "-" (instead of the table), or empty
};

/// Measures and prints all matching rows. Returns 1 if a result was wrong, or nothing matched; a row that misses its
/// target is not an error.
int printTable(Lab& lab, const TableOptions& options);

}  // namespace tspace::bench
