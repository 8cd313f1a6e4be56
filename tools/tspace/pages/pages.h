// SPDX-License-Identifier: MIT
// Man pages and completions of shells, made from the table of options when tspace is built.
#pragma once

#include <string>

#include "command_table.h"

namespace tspace::tool {

/// tspace.1, in man's macros of roff.
std::string manPage(const ToolTable& tool, const std::string& date);
/// tspace-COMMAND.1.
std::string manPage(const ToolTable& tool, const Command& command, const std::string& date);

std::string bashCompletion(const ToolTable& tool);
std::string zshCompletion(const ToolTable& tool);
std::string fishCompletion(const ToolTable& tool);

/// Options of the calls of the C API, as JSON.
std::string optionsJson();

/// The description of an option in completions: its help up to the end of the first sentence, or its first colon.
std::string firstSentence(const std::string& help);
/// `text` with each `mark` replaced.
std::string replaced(std::string text, const std::string& mark, const std::string& by);

}  // namespace tspace::tool
