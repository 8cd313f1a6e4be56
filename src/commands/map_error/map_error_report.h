// SPDX-License-Identifier: MIT
// Reports of tspace map-error.
#pragma once

#include <string>

#include "commands/shared/report.h"
#include "tspace/bake_file.h"
#include "tspace/map_files.h"

namespace tspace::report {

/// Returns the JSON report on the map `outcome`.input.
std::string mapErrorJson(const Outcome<MapErrorFileReport>& outcome, const std::string& low, const std::string& high,
                         ExitCode exit_code);
std::string mapErrorText(const Outcome<MapErrorFileReport>& outcome);

/// Returns the JSON report on the texture `outcome`.input.
std::string textureErrorJson(const Outcome<TextureErrorReport>& outcome, const std::string& source, ExitCode exit_code);
std::string textureErrorText(const Outcome<TextureErrorReport>& outcome);

}  // namespace tspace::report
