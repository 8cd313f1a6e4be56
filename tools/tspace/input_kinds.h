// SPDX-License-Identifier: MIT
// Refuses files of a wrong kind by their names, before anything is read: an image in place of a model, and the reverse.
#pragma once

#include <string>

#include "command_table.h"

namespace tspace::tool {

/// Returns whether the name has the extension of a model that some build of tspace reads, with tspace-import or
/// without.
bool isModelName(const std::string& name);

/// Returns the error message if an operand or option of the command names a file of a wrong kind; otherwise an empty
/// string. Operands that accept several files are refused only if all of them are wrong. Folders have no kind.
std::string wrongKindOfInput(const Command& command, const Given& given);

}  // namespace tspace::tool
