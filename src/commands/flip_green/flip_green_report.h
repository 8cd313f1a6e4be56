// SPDX-License-Identifier: MIT
// What tspace flip-green reports.
#pragma once

#include <string>

#include "commands/shared/report.h"
#include "tspace/map_files.h"

namespace tspace::report {

std::string flipGreenJson(const Outcome<FlipGreenReport>& outcome, ExitCode exit_code);
std::string flipGreenText(const Outcome<FlipGreenReport>& outcome);

/// Format name: "PNG", "JPEG" or "WebP".
const char* imageFormatName(ImageFileFormat format);

}  // namespace tspace::report
