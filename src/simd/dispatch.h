// SPDX-License-Identifier: MIT
// Which instructions this CPU has.
#pragma once

#include "tspace/execution.h"

namespace tspace::simd {

/// The target that runs for a wish: `best` and targets that this CPU or this build lacks become the best one
/// that is not above the wish. Never returns `best`. Thread-safe.
SimdTarget resolve(SimdTarget wish);

}  // namespace tspace::simd
