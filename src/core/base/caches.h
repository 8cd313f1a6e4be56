// SPDX-License-Identifier: MIT
// Prefetching of cache lines, and streaming stores for large outputs: such outputs leave the caches before they are
// read, and an ordinary store reads each line first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#if defined(TSPACE_SIMD_X86)
#include <xmmintrin.h>
#endif

namespace tspace {

/// Prefetches the lines of `bytes` bytes that lie `ahead` bytes after `place`, to read or to write them. Hardware
/// prefetchers do not cross pages. The addresses need not exist.
template <bool kToWrite = false>
inline void prefetchLines(const void* place, std::size_t bytes, std::size_t ahead = 4096) {
    constexpr std::size_t kLine = 64;
    const auto first = reinterpret_cast<std::uintptr_t>(place) + ahead;
    for (std::size_t i = 0; i < bytes; i += kLine)
        __builtin_prefetch(reinterpret_cast<const void*>(first + i), kToWrite ? 1 : 0);
}

/// Whether rows at `to`, so many bytes in all, should be streamed. They must lie one behind the other.
inline bool areStreamed([[maybe_unused]] const void* to, [[maybe_unused]] std::size_t bytes) {
#if defined(TSPACE_SIMD_X86)
    constexpr std::size_t kLarge = std::size_t{32} << 20;  // what many processors have as their last cache
    return bytes >= kLarge && reinterpret_cast<std::uintptr_t>(to) % 16 == 0;
#else
    return false;
#endif
}

/// to[0..3] = row[0..3]; both aligned to 16 bytes. No thread may read it before this one has called endOfRows.
inline void streamRow(float* to, const float* row) {
#if defined(TSPACE_SIMD_X86)
    _mm_stream_ps(to, _mm_load_ps(row));
#else
    std::memcpy(to, row, 4 * sizeof(float));
#endif
}

inline void endOfRows() {
#if defined(TSPACE_SIMD_X86)
    _mm_sfence();
#endif
}

}  // namespace tspace
