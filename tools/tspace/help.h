// SPDX-License-Identifier: MIT
// Formats the pages of --help like short man pages, 80 columns wide.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "command_table.h"

namespace tspace::tool {

/// Text of the help: the heading "Exit codes:", and a line for each code.
extern const char* const kExitCodes;

/// Returns a line such as "Built without: PNG and JPEG, WebP."; empty if the build is complete.
std::string missingFeatures();

/// Returns the page of the whole tool, with lines of any length.
std::string helpPage(const ToolTable& tool);
/// Returns the page of a command: usage, description, options by group with their defaults, examples.
std::string helpPage(const Command& command);

/// Returns a line such as "tspace generate IN... -o OUT [OPTION...]".
std::string usageLine(const Command& command);
/// Returns "-o, --output OUT", or "IN..." for an operand.
std::string optionHead(const Option& option);
/// Returns the headings in the order of their first option, with their options.
std::vector<std::pair<std::string, std::vector<const Option*>>> optionsByGroup(const std::vector<Option>& options);

}  // namespace tspace::tool
