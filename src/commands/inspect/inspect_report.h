// SPDX-License-Identifier: MIT
// What tspace inspect reports.
#pragma once

#include <string>
#include <vector>

#include "commands/shared/report.h"
#include "tspace/inspect.h"

namespace tspace::report {

using InspectOutcome = Outcome<Inspection>;

std::string inspectJson(const std::vector<InspectOutcome>& outcomes, ExitCode exit_code);
std::string inspectText(const InspectOutcome& outcome);

/// The names of the formats of packed frames that a primitive has.
std::vector<std::string> packedNames(const PrimitiveInfo& primitive);

}  // namespace tspace::report
