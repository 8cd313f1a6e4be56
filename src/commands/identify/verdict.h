// SPDX-License-Identifier: MIT
// What the explanations of a file say, in sentences for a person.
#pragma once

#include <string>

#include "tspace/identify.h"

namespace tspace {

/// PrimitiveIdentity::skipped where an importer cannot give all that a file has.
inline constexpr const char* kNotRead = "its tangents were not read";

/// Everything else in `result` is there.
std::string verdictOf(const Identification& result);

}  // namespace tspace
