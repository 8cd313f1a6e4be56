// SPDX-License-Identifier: MIT
// What killed runs left beside outputs.
#pragma once

#include "model/io/path.h"

namespace tspace {

/// Removes what killed runs left in a folder, as removeAbandonedFiles() does, at the first call about it in this process.
/// AtomicOutput calls it for each folder that it writes into; commands call it before they read inputs, because a file that
/// was set aside comes back.
void removeAbandonedOnce(const Path& folder);

}  // namespace tspace
