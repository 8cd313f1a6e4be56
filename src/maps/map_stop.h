// SPDX-License-Identifier: MIT
#pragma once

#include "core/border.h"

namespace tspace {

/// What a call ends with when its `stop` said so.
inline Error stoppedError() { return makeError(ErrorCode::cancelled, kNoElement, "stopped before it was done"); }

}  // namespace tspace
