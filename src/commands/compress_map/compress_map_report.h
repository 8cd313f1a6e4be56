// SPDX-License-Identifier: MIT
// What tspace compress-map reports.
#pragma once

#include <string>

#include "commands/shared/report.h"
#include "tspace/map_compress_file.h"

namespace tspace::report {

std::string compressMapJson(const Outcome<CompressMapFileReport>& outcome, ExitCode exit_code);
std::string compressMapText(const Outcome<CompressMapFileReport>& outcome);

}  // namespace tspace::report
