// SPDX-License-Identifier: MIT
// What tspace bake reports.
#pragma once

#include <string>
#include <vector>

#include "commands/shared/report.h"
#include "commands/shared/text.h"
#include "tspace/bake_file.h"

namespace tspace::report {

/// Exit code of a successful bake.
inline ExitCode exitCodeOf(const BakeFileReport& report) {
    return report.findings.empty() ? ExitCode::done : ExitCode::findings;
}
Json bakeDocument(const Outcome<BakeFileReport>& outcome, const std::string& high, ExitCode exit_code);
std::string bakeJson(const Outcome<BakeFileReport>& outcome, const std::string& high, ExitCode exit_code);
/// Report of a successful bake as text. `out_mesh`: as BakeFileOptions::out_mesh.
std::string bakeText(const Outcome<BakeFileReport>& outcome, const std::string& out_mesh);
/// In one line, for one of several.
std::string bakeLine(const Outcome<BakeFileReport>& outcome);

/// One bake of several.
struct BakedPair {
    Outcome<BakeFileReport> outcome = {};
    std::string high = {};
    ExitCode exit_code = ExitCode::done;  ///< exit code of this bake
};
std::string bakedPairsJson(const std::vector<BakedPair>& pairs, ExitCode exit_code, double seconds);

/// The rows of a bake that was done. `out_mesh`: as BakeFileOptions::out_mesh.
void addBakedRows(const BakeFileReport& done, const std::string& out_mesh, Table& table);

/// As docs/reference/json.md has them.
/// A normal map of the high poly, and how it is known which way its green points.
Json highMapJson(const BakedHighMap& map);
const char* greenSourceWord(GreenSource source);
std::string highMapText(const BakedHighMap& map);
const char* raysWord(const UsedRays& rays);
const char* directionsWord(const UsedRays& rays);

/// The angles between what a map shows and the high poly.
Json errorOfMapJson(const MapError& error);

}  // namespace tspace::report
