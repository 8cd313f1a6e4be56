// SPDX-License-Identifier: MIT
// Reads a command line by the table of its command.
#pragma once

#include <span>
#include <string>

#include "command_table.h"

namespace tspace::tool {

/// Reads what stands behind the name of the command: --name VALUE, --name=VALUE, -n VALUE, -nVALUE, flags together
/// (-ab), operands in between, and "--" before those that begin with a dash. "-" alone is an operand. Gives every value
/// to its option. Returns what is wrong with the line, or nothing. With --help among the arguments nothing else is
/// looked at.
std::string readCommandLine(const Command& command, std::span<const char* const> arguments, Given& given);

}  // namespace tspace::tool
