// SPDX-License-Identifier: MIT
// Options that select the tested importer.
#pragma once

#include "tspace/file_options.h"

namespace tspace::test {

inline const FileOptions kWithImporter{.importer = TSPACE_IMPORTER};

}  // namespace tspace::test
