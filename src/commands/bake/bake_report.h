// SPDX-License-Identifier: MIT
// What tspace bake reports.
#pragma once

#include <string>

#include "commands/shared/report.h"
#include "tspace/bake_file.h"

namespace tspace::report {

std::string bakeJson(const Outcome<BakeFileReport>& outcome, const std::string& high, ExitCode exit_code);
/// Of a bake that was done. `out_mesh`: as BakeFileOptions::out_mesh.
std::string bakeText(const Outcome<BakeFileReport>& outcome, const std::string& out_mesh);

/// As docs/json.md has them.
/// A normal map of the high poly, and how it is known which way its green points.
Json highMapJson(const BakedHighMap& map);
const char* greenSourceWord(GreenSource source);
std::string highMapText(const BakedHighMap& map);
const char* raysWord(const UsedRays& rays);
const char* directionsWord(const UsedRays& rays);

/// The angles between what a map shows and the high poly.
Json errorOfMapJson(const MapError& error);

}  // namespace tspace::report
