// SPDX-License-Identifier: MIT
// Options with the importer that is tested.
#pragma once

#include "tspace/file_options.h"

namespace tspace::test {

inline const FileOptions kWithImporter{.importer = TSPACE_IMPORTER};

}  // namespace tspace::test
