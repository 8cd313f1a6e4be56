// SPDX-License-Identifier: MIT
// Sixteen lanes: AVX-512 F and DQ. lanes_scalar.h documents each function.
#pragma once

#include <immintrin.h>

#include "core/simd/lanes.h"

#define TSPACE_ROWS [[gnu::always_inline]]

namespace tspace::simd::avx512 {

inline constexpr std::size_t kWidth = 16;

#include "core/simd/lanes_arithmetic.h"

inline unsigned bitsOf(Mask m) { return _mm512_movepi32_mask(reinterpret_cast<__m512i>(m.v)); }
inline Floats smaller(Floats a, Floats b) { return {_mm512_min_ps(a.v, b.v)}; }
inline Floats larger(Floats a, Floats b) { return {_mm512_max_ps(a.v, b.v)}; }
inline Floats squareRoot(Floats a) { return {_mm512_sqrt_ps(a.v)}; }

inline DoubleMask operator>(Doubles a, Doubles b) { return {a.v > b.v}; }
inline unsigned bitsOf(DoubleMask m) { return _mm512_movepi64_mask(reinterpret_cast<__m512i>(m.v)); }
inline Doubles squareRoot(Doubles a) { return {_mm512_sqrt_pd(a.v)}; }
inline Doubles loadAsDoubles(const float* p) { return {_mm512_cvtps_pd(_mm256_load_ps(p))}; }
inline void storeAsFloats(float* to, Doubles a) { _mm256_store_ps(to, _mm512_cvtpd_ps(a.v)); }
inline Doubles part(Floats a, std::size_t which) {
    return {_mm512_cvtps_pd(which == 0 ? _mm512_castps512_ps256(a.v) : _mm512_extractf32x8_ps(a.v, 1))};
}
inline Floats join(const Doubles* parts) {
    return {_mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps(parts[0].v)), _mm512_cvtpd_ps(parts[1].v), 1)};
}

inline FloatVector joinQuads(Quad a, Quad b, Quad c, Quad d) {
    const __m256 ab = _mm256_insertf128_ps(_mm256_castps128_ps256(a), b, 1);
    const __m256 cd = _mm256_insertf128_ps(_mm256_castps128_ps256(c), d, 1);
    return _mm512_insertf32x8(_mm512_castps256_ps512(ab), cd, 1);
}
#include "core/simd/lanes_rows.h"

}  // namespace tspace::simd::avx512
