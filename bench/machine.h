// SPDX-License-Identifier: MIT
// Description of the machine that produced the results.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace tspace::bench {

nlohmann::ordered_json machineJson();
/// Returns the description as one line.
std::string machineText();

}  // namespace tspace::bench
