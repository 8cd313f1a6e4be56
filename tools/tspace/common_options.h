// SPDX-License-Identifier: MIT
// Options that several commands have.
#pragma once

#include <string>
#include <vector>

#include "batch.h"
#include "command_table.h"
#include "commands/shared/file_options.h"

namespace tspace::tool {

/// A heading in help. Options under it decide how a command runs, not what it finds or writes.
inline constexpr const char* kManyFiles = "Many files";

/// The operand IN... and --files-from, whose files follow those of the operand when the command is prepared.
void addInputs(Command& command, std::vector<std::string>& inputs);
void addBatch(Command& command, BatchArguments& batch, bool with_manifest);
/// Also --help.
void addReporting(Command& command, bool& json, bool& quiet);
Option helpOption();

/// The options given that decide about results: "--all --method=angle", in the order of their names, so that the
/// manifest of another command line with the same meaning fits.
std::string resultOptions(const Given& given);

}  // namespace tspace::tool
