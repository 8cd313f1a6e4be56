// SPDX-License-Identifier: MIT
// Man pages and shell completions, generated from the table of options when tspace is built.
#pragma once

#include <string>

#include "command_table.h"

namespace tspace::tool {

/// Returns tspace.1, in the man macros of roff.
std::string manPage(const ToolTable& tool, const std::string& date);
/// Returns tspace-COMMAND.1, in the man macros of roff.
std::string manPage(const ToolTable& tool, const Command& command, const std::string& date);

std::string bashCompletion(const ToolTable& tool);
std::string zshCompletion(const ToolTable& tool);
std::string fishCompletion(const ToolTable& tool);

/// Returns the options of the C API calls as JSON.
std::string optionsJson();

/// Returns the description of an option for completions: its help up to the end of the first sentence, or up to its
/// first colon.
std::string firstSentence(const std::string& help);
/// Returns `text` with each `mark` replaced.
std::string replaced(std::string text, const std::string& mark, const std::string& by);

}  // namespace tspace::tool
