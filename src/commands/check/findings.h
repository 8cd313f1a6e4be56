// SPDX-License-Identifier: MIT
// Makes findings: numbers become sentences.
#pragma once

#include <string>

#include "commands/check/tally.h"
#include "tspace/check.h"

namespace tspace {

/// The remedy of inverted signs and green that points down, which cancel out.
inline constexpr const char* kBothOrNeither =
    "Do both or neither: negate every w and invert the green channel of the normal map, or leave both as they are. "
    "They cancel out.";

/// The remedy of green that points down where the convention that is asked for has it so.
inline constexpr const char* kNothingToDo = "Nothing needs to be done; a reader of plain glTF wants green to point up.";

/// The remedy of green that points down where the signs of some meshes, but not of all, are made for that.
inline constexpr const char* kSignsFirst =
    "Do both together: negate every w of the meshes whose signs are inverted, and invert the green channel.";

/// A finding with the tally's numbers, without a place.
Finding makeFinding(FindingCode code, Severity severity, const Tally& tally, const char* unit, std::string message);

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

}  // namespace tspace
