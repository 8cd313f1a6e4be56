// SPDX-License-Identifier: MIT
// Functions of the caller that long calls use: to give bytes, and to tell how far they are.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "tspace/result.h"

namespace tspace {

/// Takes bytes of an output, in their order. Returns false when it can take no more. Called by one thread at a time, which
/// need not be that of the call. What it throws ends the call (internal, or outOfMemory); so it is with Progress, FindFile and
/// all that the caller has called: no exception leaves the library.
using Sink = std::function<bool(std::span<const std::uint8_t>)>;

/// Called now and then during long work, by the thread of the call. `done` of `total` steps; `what` names the step ("computing
/// tangents"). It may throw Cancelled, which ends the call with ErrorCode::cancelled: there is no result, and nothing on disk
/// has changed then.
using Progress = std::function<void(const char* what, std::uint64_t done, std::uint64_t total)>;

}  // namespace tspace
