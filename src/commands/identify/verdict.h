// SPDX-License-Identifier: MIT
// The verdict on the explanations of a file, in sentences for a person.
#pragma once

#include <string>

#include "tspace/identify.h"

namespace tspace {

/// PrimitiveIdentity::skipped where an importer cannot give all that a file has.
inline constexpr const char* kNotRead = "its tangents were not read";

/// All other members of `result` must be filled.
std::string verdictOf(const Identification& result);

}  // namespace tspace
