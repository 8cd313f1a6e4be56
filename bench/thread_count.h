// SPDX-License-Identifier: MIT
// Whether a call starts threads.
#pragma once

#include <cstddef>

namespace tspace::bench {

/// Threads that this program has started so far.
std::size_t startedThreads();

}  // namespace tspace::bench
