// SPDX-License-Identifier: MIT
// Where the figures come from.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace tspace::bench {

nlohmann::ordered_json machineJson();
/// One line.
std::string machineText();

}  // namespace tspace::bench
