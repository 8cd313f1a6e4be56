// SPDX-License-Identifier: MIT
// Reports of tspace inspect.
#pragma once

#include <string>
#include <vector>

#include "commands/shared/report.h"
#include "tspace/inspect.h"

namespace tspace::report {

using InspectOutcome = Outcome<Inspection>;

std::string inspectJson(const std::vector<InspectOutcome>& outcomes, ExitCode exit_code);
std::string inspectText(const InspectOutcome& outcome);

/// Returns the names of the packed frame formats of a primitive.
std::vector<std::string> packedNames(const PrimitiveInfo& primitive);

}  // namespace tspace::report
