// SPDX-License-Identifier: MIT
// What tspace compress-map reports.
#pragma once

#include <cstddef>
#include <string>

#include "commands/shared/report.h"
#include "tspace/map_files.h"

namespace tspace {

/// The PNG of a level in a folder of PNGs, which ends in "/": FOLDER/NAME.LEVEL.png.
std::string levelPath(const std::string& folder, const std::string& input, std::size_t level);

}  // namespace tspace

namespace tspace::report {

std::string compressMapJson(const Outcome<CompressMapFileReport>& outcome, ExitCode exit_code);
std::string compressMapText(const Outcome<CompressMapFileReport>& outcome);

}  // namespace tspace::report
