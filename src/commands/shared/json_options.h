// SPDX-License-Identifier: MIT
// Options as JSON, for callers of the C API.
#pragma once

#include <string>
#include <string_view>

#include "commands/shared/option_table.h"

namespace tspace::options {

/// Gives the members of a JSON object to the options of these names, without their dashes: {"method": "best",
/// "crease": 60, "overwrite": true, "ignore": ["tangentsUnused"]}. A flag is a boolean; false and null are as if nothing
/// was given. An empty text has no members. Returns what is wrong, in the words of the command line, or nothing.
std::string readJsonOptions(const OptionList& list, std::string_view text, Given& given);

}  // namespace tspace::options
