// SPDX-License-Identifier: MIT
// How --help looks: like a short man page, 80 columns wide.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "command_table.h"

namespace tspace::tool {

/// "Exit codes:" and a line for each.
extern const char* const kExitCodes;

/// "Built without: PNG and JPEG, WebP.", as a line; empty where nothing is left out.
std::string leftOut();

/// The page of the whole tool, with lines of any length.
std::string helpPage(const ToolTable& tool);
/// The page of a command: usage, description, options by group with their defaults, examples.
std::string helpPage(const Command& command);

/// "tspace generate IN... -o OUT [OPTION...]".
std::string usageLine(const Command& command);
/// "-o, --output OUT"; of an operand "IN...".
std::string optionHead(const Option& option);
/// Headings in the order of their first option, with their options.
std::vector<std::pair<std::string, std::vector<const Option*>>> optionsByGroup(const std::vector<Option>& options);

}  // namespace tspace::tool
