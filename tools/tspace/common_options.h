// SPDX-License-Identifier: MIT
// Options shared by several commands.
#pragma once

#include <string>
#include <vector>

#include "batch.h"
#include "command_table.h"
#include "commands/shared/file_options.h"

namespace tspace::tool {

/// Heading in the help. Options under it affect how a command runs, but not its results.
inline constexpr const char* kManyFiles = "Many files";

/// Adds the operand IN... and --files-from, whose files are appended when the command is prepared.
void addInputs(Command& command, std::vector<std::string>& inputs, InputKind reads);
void addBatch(Command& command, BatchArguments& batch, bool with_manifest);
/// Adds the options --json, --quiet and --help.
void addReporting(Command& command, bool& json, bool& quiet);
Option helpOption();

/// Returns the given options that affect results: "--all --method=angle", sorted by name, so that equivalent command
/// lines match in a manifest.
std::string resultOptions(const Given& given);

}  // namespace tspace::tool
