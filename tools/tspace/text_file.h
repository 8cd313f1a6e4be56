// SPDX-License-Identifier: MIT
// Reports that go to a file of their own.
#pragma once

#include <string>

#include "tspace/result.h"

namespace tspace::tool {

/// The file appears whole or not at all: it is written beside `path` under a temporary name, then renamed.
Result<Done> writeTextFile(const std::string& path, const std::string& text);

}  // namespace tspace::tool
