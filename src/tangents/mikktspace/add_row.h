// SPDX-License-Identifier: MIT
// The addition that all sums are made of. Not for files that are compiled for one CPU (see
// simd/lanes_scalar.h).
#pragma once

#if defined(TSPACE_SIMD_X86)
#include <emmintrin.h>
#endif

namespace tspace::mikk {

/// to[0..3] += row[0..3]; both aligned to 16 bytes.
inline void addRow(float* to, const float* row) {
#if defined(TSPACE_SIMD_X86)
    _mm_store_ps(to, _mm_add_ps(_mm_load_ps(to), _mm_load_ps(row)));
#else
    for (int i = 0; i < 4; ++i) to[i] = to[i] + row[i];
#endif
}

}  // namespace tspace::mikk
