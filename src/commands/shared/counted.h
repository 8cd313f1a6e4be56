// SPDX-License-Identifier: MIT
// Numbers of things in sentences.
#pragma once

#include <cstdint>
#include <string>

namespace tspace::report {

/// "1 corner", "2 corners".
std::string counted(std::uint64_t count, const char* noun);

}  // namespace tspace::report
