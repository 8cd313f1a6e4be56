// SPDX-License-Identifier: MIT
// Prefetch: cache lines are asked for before they are needed.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tspace {

/// Asks for the lines of `bytes` bytes that lie `ahead` bytes after `place`, where they will be read or written.
/// Processors do this by themselves, but not across pages. There need not be any memory: then this asks for nothing.
template <bool kToWrite = false>
inline void prefetchLines(const void* place, std::size_t bytes, std::size_t ahead = 4096) {
    constexpr std::size_t kLine = 64;
    const auto first = reinterpret_cast<std::uintptr_t>(place) + ahead;
    for (std::size_t i = 0; i < bytes; i += kLine)
        __builtin_prefetch(reinterpret_cast<const void*>(first + i), kToWrite ? 1 : 0);
}

}  // namespace tspace
