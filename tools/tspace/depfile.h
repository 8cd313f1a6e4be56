// SPDX-License-Identifier: MIT
// --depfile: the outputs and inputs of a run, as a rule that make and ninja include.
#pragma once

#include <string>
#include <vector>

#include "command_table.h"

namespace tspace::tool {

/// Returns the rule "OUTPUTS: INPUTS", and an empty rule per input, so that make continues after an input has been
/// removed. Names are escaped for make and ninja; a name with a control character cannot be escaped: fails with
/// invalidOption.
Result<std::string> depfileText(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

/// Adds the option --depfile to a command that writes files.
void addDepfile(Command& command);

}  // namespace tspace::tool
