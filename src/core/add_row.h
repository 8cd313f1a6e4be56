// SPDX-License-Identifier: MIT
// The addition that all sums are made of. Not for files that are compiled for one CPU (see
// simd/lanes_scalar.h).
#pragma once

#if defined(TSPACE_SIMD_X86)
#include <emmintrin.h>
#endif

namespace tspace {

/// to[0..3] += row[0..3]; both aligned to 16 bytes.
inline void addRow(float* to, const float* row) {
#if defined(TSPACE_SIMD_X86)
    _mm_store_ps(to, _mm_add_ps(_mm_load_ps(to), _mm_load_ps(row)));
#else
    // Written when all are read, so that a compiler may add them together.
    const float x = to[0] + row[0], y = to[1] + row[1], z = to[2] + row[2], w = to[3] + row[3];
    to[0] = x;
    to[1] = y;
    to[2] = z;
    to[3] = w;
#endif
}

/// to[0..2] += row[0..2], where only `row` is aligned to 16 bytes.
inline void addVector(float* to, const float* row) {
#if defined(TSPACE_SIMD_X86)
    const __m128 xy = _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(to)));
    const __m128 sum = _mm_add_ps(_mm_movelh_ps(xy, _mm_load_ss(to + 2)), _mm_load_ps(row));
    _mm_storel_epi64(reinterpret_cast<__m128i*>(to), _mm_castps_si128(sum));
    _mm_store_ss(to + 2, _mm_movehl_ps(sum, sum));
#else
    const float x = to[0] + row[0], y = to[1] + row[1], z = to[2] + row[2];
    to[0] = x;
    to[1] = y;
    to[2] = z;
#endif
}

}  // namespace tspace
