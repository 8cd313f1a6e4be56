// SPDX-License-Identifier: MIT
// Cleanup of temporary files that killed runs left next to outputs.
#pragma once

#include "model/io/path.h"

namespace tspace {

/// Removes files that killed runs left in a folder, like removeAbandonedFiles(), on the first call for the folder in
/// this process. AtomicOutput calls it for each folder that it writes into; commands call it before they read inputs,
/// because it restores files that were set aside.
void removeAbandonedOnce(const Path& folder);

}  // namespace tspace
