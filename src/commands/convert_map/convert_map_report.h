// SPDX-License-Identifier: MIT
// Reports of tspace convert-map.
#pragma once

#include <string>

#include "commands/shared/report.h"
#include "tspace/map_files.h"

namespace tspace::report {

std::string convertMapJson(const Outcome<ConvertMapFileReport>& outcome, ExitCode exit_code);
/// Returns the report as text. `options`: options of the call; the text names its models.
std::string convertMapText(const Outcome<ConvertMapFileReport>& outcome, const ConvertMapFileOptions& options);

}  // namespace tspace::report
