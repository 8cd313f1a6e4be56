// SPDX-License-Identifier: MIT
// --depfile: the outputs of a run and the files that it read, as a rule that make and ninja include.
#pragma once

#include <string>
#include <vector>

#include "command_table.h"

namespace tspace::tool {

/// The rule "OUTPUTS: INPUTS", and an empty rule per input, so that make goes on when an input has been removed. Names are escaped as
/// make and ninja read them; a name with a control character cannot be: fails with invalidOption.
Result<std::string> depfileText(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

/// Gives a command that writes files the option --depfile.
void addDepfile(Command& command);

}  // namespace tspace::tool
