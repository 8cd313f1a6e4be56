// SPDX-License-Identifier: MIT
// Makes findings: what was counted becomes sentences.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "commands/check/tally.h"
#include "tspace/check.h"

namespace tspace {

struct FrameHealth;
struct ScenePrimitive;

/// The view of tspace render that shows what a finding is about ("sign"), or an empty text.
const char* findingLook(FindingCode code);

/// A finding with the tally's numbers, without a place.
Finding makeFinding(FindingCode code, Severity severity, const Tally& tally, const char* unit, std::string message);

/// Says where the finding is: `place`, in that primitive.
void placeAt(const ScenePrimitive& primitive, const std::string& place, Finding& finding);

/// `severity`, but a warning where an error concerns less than `options.error_share` of the surface.
Severity onShare(Severity severity, double surface_share, const CheckOptions& options);

/// "12 of 345 vertices"; "all 345 vertices".
std::string countText(const Tally& tally, const char* unit);
/// "34.5 %", "less than 0.1 %".
std::string shareText(double share);
/// A length with two digits, or all before the point: "0.5", "0.00012", "4659477".
std::string stepText(double value);
/// "12.3".
std::string decimalText(double value);

/// The findings of an examination, without a place.
std::vector<Finding> tangentFindings(const FrameHealth& health, const CheckOptions& options);

/// Why these tangents surely render wrong, where a material reads them: the message of the first finding that is an error.
/// Empty: they are good enough to be kept.
std::string whyTangentsAreWrong(const FrameHealth& health, const CheckOptions& options);

}  // namespace tspace
