// SPDX-License-Identifier: MIT
// Reports of tspace identify.
#pragma once

#include <string>
#include <vector>

#include "commands/shared/report.h"
#include "tspace/inspect.h"

namespace tspace::report {

using IdentifyOutcome = Outcome<Identification>;

std::string identifyJson(const std::vector<IdentifyOutcome>& outcomes, ExitCode exit_code);
std::string identifyText(const IdentifyOutcome& outcome);

}  // namespace tspace::report
