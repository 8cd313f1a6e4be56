// SPDX-License-Identifier: MIT
// What tspace convert-map reports.
#pragma once

#include <string>

#include "commands/shared/report.h"
#include "tspace/map_files.h"

namespace tspace::report {

std::string convertMapJson(const Outcome<ConvertMapFileReport>& outcome, ExitCode exit_code);
/// `options`: those of the call; the text names their models.
std::string convertMapText(const Outcome<ConvertMapFileReport>& outcome, const ConvertMapFileOptions& options);

}  // namespace tspace::report
