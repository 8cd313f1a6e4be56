// SPDX-License-Identifier: MIT
// One function per format behind inspectFile. They throw FileError.
#pragma once

#include <string>

#include "tspace/asset.h"

namespace tspace {

Inspection inspectGltf(const std::string& input, const FileOptions& options);
Inspection inspectObj(const std::string& input, const FileOptions& options);

}  // namespace tspace
