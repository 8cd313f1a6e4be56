// SPDX-License-Identifier: MIT
// Reports of tspace height-to-normal.
#pragma once

#include <string>

#include "commands/shared/report.h"
#include "tspace/map_files.h"

namespace tspace::report {

std::string heightToNormalJson(const Outcome<HeightToNormalFileReport>& outcome, ExitCode exit_code);
/// Returns the report as text. `options`: options of the call; the text contains the strength and the model.
std::string heightToNormalText(const Outcome<HeightToNormalFileReport>& outcome,
                               const HeightToNormalFileOptions& options);

}  // namespace tspace::report
