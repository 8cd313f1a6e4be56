// SPDX-License-Identifier: MIT
// Parses a command line according to the table of its command.
#pragma once

#include <span>
#include <string>

#include "command_table.h"

namespace tspace::tool {

/// Parses the arguments after the name of the command: --name VALUE, --name=VALUE, -n VALUE, -nVALUE, combined flags
/// (-ab), operands in between, and "--" before operands that start with a dash. "-" alone is an operand. Passes every
/// value to its option. Returns an error message, or an empty string. If --help is among the arguments, everything else
/// is ignored.
std::string readCommandLine(const Command& command, std::span<const char* const> arguments, Given& given);

}  // namespace tspace::tool
