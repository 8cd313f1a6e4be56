// SPDX-License-Identifier: MIT
// Which instructions this CPU has.
#pragma once

#include "tspace/execution.h"

namespace tspace::simd {

/// The target that runs for a wish: `best`, and the best one of a lower number for those that this CPU or
/// this build lacks. Never returns `best`. Thread-safe.
SimdTarget resolve(SimdTarget wish);

}  // namespace tspace::simd
