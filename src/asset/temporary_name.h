// SPDX-License-Identifier: MIT
// Names of temporary files, which tell whose they are.
#pragma once

#include "asset/path.h"

namespace tspace {

inline constexpr const char* kTemporaryEnding = ".tmp";

/// A name beside `target` that no other run and no other thread uses: TARGET.tspace-MACHINE-PROCESS-NUMBER and the
/// ending. Two models that share an image may copy it at the same time.
Path besideName(const Path& target, const char* ending);

}  // namespace tspace
