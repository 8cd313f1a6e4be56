// SPDX-License-Identifier: MIT
// What tspace map-error reports.
#pragma once

#include <string>

#include "commands/shared/report.h"
#include "tspace/bake_file.h"

namespace tspace::report {

/// Of the map `outcome`.input.
std::string mapErrorJson(const Outcome<MapErrorFileReport>& outcome, const std::string& low, const std::string& high,
                         ExitCode exit_code);
std::string mapErrorText(const Outcome<MapErrorFileReport>& outcome);

}  // namespace tspace::report
