// SPDX-License-Identifier: MIT
// Reports of tspace bake.
#pragma once

#include <string>
#include <vector>

#include "commands/shared/report.h"
#include "commands/shared/text.h"
#include "tspace/bake_file.h"

namespace tspace::report {

/// Returns the exit code of a bake that ended without an error.
inline ExitCode exitCodeOf(const BakeFileReport& report) {
    return report.findings.empty() ? ExitCode::done : ExitCode::findings;
}
Json bakeDocument(const Outcome<BakeFileReport>& outcome, const std::string& high, ExitCode exit_code);
std::string bakeJson(const Outcome<BakeFileReport>& outcome, const std::string& high, ExitCode exit_code);
/// Returns the report of a bake that ended without an error as text. `out_mesh`: see BakeFileOptions::out_mesh.
std::string bakeText(const Outcome<BakeFileReport>& outcome, const std::string& out_mesh);
/// Returns the report as one line, for use in a list of bakes.
std::string bakeLine(const Outcome<BakeFileReport>& outcome);

/// Result of one of several bakes.
struct BakedPair {
    Outcome<BakeFileReport> outcome = {};
    std::string high = {};
    ExitCode exit_code = ExitCode::done;  ///< exit code of this bake
};
std::string bakedPairsJson(const std::vector<BakedPair>& pairs, ExitCode exit_code, double seconds);

/// Adds the rows of a completed bake to the table. `out_mesh`: see BakeFileOptions::out_mesh.
void addBakedRows(const BakeFileReport& done, const std::string& out_mesh, Table& table);

/// Returns the JSON of a normal map of the high poly, with the source of its green direction (docs/reference/json.md).
Json highMapJson(const BakedHighMap& map);
const char* greenSourceWord(GreenSource source);
std::string highMapText(const BakedHighMap& map);
const char* raysWord(const UsedRays& rays);
const char* directionsWord(const UsedRays& rays);

/// Returns the JSON of the angles between a map and the high poly.
Json errorOfMapJson(const MapError& error);

}  // namespace tspace::report
