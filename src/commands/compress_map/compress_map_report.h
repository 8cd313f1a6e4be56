// SPDX-License-Identifier: MIT
// Reports of tspace compress-map.
#pragma once

#include <cstddef>
#include <string>

#include "commands/shared/report.h"
#include "tspace/map_files.h"

namespace tspace {

/// Returns the path of the PNG of a mip level: FOLDER/NAME.LEVEL.png; `folder` ends in "/".
std::string levelPath(const std::string& folder, const std::string& input, std::size_t level);

}  // namespace tspace

namespace tspace::report {

std::string compressMapJson(const Outcome<CompressMapFileReport>& outcome, ExitCode exit_code);
std::string compressMapText(const Outcome<CompressMapFileReport>& outcome);

}  // namespace tspace::report
