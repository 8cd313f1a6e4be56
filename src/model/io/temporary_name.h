// SPDX-License-Identifier: MIT
// Names of temporary files, which tell whose they are.
#pragma once

#include "model/io/path.h"

namespace tspace {

inline constexpr const char* kTemporaryEnding = ".tmp";
/// Of a file that was there, while others take their places.
inline constexpr const char* kAsideEnding = ".old";

/// A name beside `target` that nobody can foresee: TARGET.tspace-MACHINE-PROCESS-RANDOM and the ending, as many bytes as
/// names may have. Of a longer target only the begin is in it.
Path besideName(const Path& target, const char* ending);

}  // namespace tspace
