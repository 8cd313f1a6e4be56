// SPDX-License-Identifier: MIT
// Reports of tspace flip-green.
#pragma once

#include <string>

#include "commands/shared/report.h"
#include "tspace/map_files.h"

namespace tspace::report {

std::string flipGreenJson(const Outcome<FlipGreenReport>& outcome, ExitCode exit_code);
std::string flipGreenText(const Outcome<FlipGreenReport>& outcome);

/// Returns the name of a format: "PNG", "JPEG" or "WebP".
const char* imageFormatName(ImageFileFormat format);

}  // namespace tspace::report
