// SPDX-License-Identifier: MIT
// Functions that convert counts of faults to findings with sentences.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "commands/check/tally.h"
#include "tspace/check.h"

namespace tspace {

struct FrameHealth;
struct ScenePrimitive;

/// Returns the value of `tspace render --show` that makes findings of this kind visible, such as "sign"; empty if there
/// is none.
const char* findingView(FindingCode code);

/// The message of a finding in two parts.
struct FindingText {
    std::string symptom = {};  ///< "bumps look like dents along v"; empty: the message is the cause alone
    std::string cause = {};    ///< Finding::cause
};

/// Creates a finding with the numbers of the tally and without a location.
Finding makeFinding(FindingCode code, Severity severity, const Tally& tally, const char* unit, FindingText text);

/// Appends a clause to the cause, and therefore to the message.
void extendCause(Finding& finding, const std::string& more);

/// Sets the location of a finding: `place` in the primitive.
void placeAt(const ScenePrimitive& primitive, const std::string& place, Finding& finding);

/// Returns `severity`, but lowers an error to a warning if it concerns less than `options.error_share` of the surface.
Severity onShare(Severity severity, double surface_share, const CheckOptions& options);

/// Formats a count: "12 of 345 vertices" or "all 345 vertices".
std::string countText(const Tally& tally, const char* unit);
/// Formats a share: "34.5 %" or "less than 0.1 %".
std::string shareText(double share);
/// Formats a length with two significant digits, or with all digits before the decimal point: "0.5", "0.00012",
/// "4659477".
std::string stepText(double value);
/// Formats a number with one decimal: "12.3".
std::string decimalText(double value);

/// Returns the findings of an examination, without locations.
std::vector<Finding> tangentFindings(const FrameHealth& health, const CheckOptions& options);

/// Returns why the tangents certainly render wrong if a material reads them: the message of the first finding that is
/// an error. Returns an empty string if no finding is an error.
std::string whyTangentsAreWrong(const FrameHealth& health, const CheckOptions& options);

}  // namespace tspace
