// SPDX-License-Identifier: MIT
// Counts started threads, to test whether a call starts any.
#pragma once

#include <cstddef>

namespace tspace::bench {

/// Returns the number of threads that this program has started so far.
std::size_t startedThreads();

}  // namespace tspace::bench
