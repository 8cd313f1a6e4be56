// SPDX-License-Identifier: MIT
// Callbacks of long calls: for output bytes and for progress.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "tspace/result.h"

namespace tspace {

/// Receives the bytes of an output, in order. Returns false if it cannot accept more. Called by one thread at a time,
/// which need not be the calling thread. An exception that it throws ends the call (internal, or outOfMemory); this
/// also applies to Progress, FindFile and all other callbacks: no exception leaves the library.
using Sink = std::function<bool(std::span<const std::uint8_t>)>;

/// Called periodically during long work, on the thread of the caller. `done` of `total` steps are complete; `what`
/// names the current step ("computing tangents"). It may throw Cancelled, which ends the call with
/// ErrorCode::cancelled, without a result and without changes on disk.
using Progress = std::function<void(const char* what, std::uint64_t done, std::uint64_t total)>;

}  // namespace tspace
