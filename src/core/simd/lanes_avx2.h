// SPDX-License-Identifier: MIT
// Eight lanes: AVX2. lanes_scalar.h documents each function.
#pragma once

#include <immintrin.h>

#include "core/simd/lanes.h"

namespace tspace::simd::avx2 {

inline constexpr std::size_t kWidth = 8;

#include "core/simd/lanes_arithmetic.h"

inline unsigned bitsOf(Mask m) { return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(m.v))); }
inline Floats smaller(Floats a, Floats b) { return {_mm256_min_ps(a.v, b.v)}; }
inline Floats larger(Floats a, Floats b) { return {_mm256_max_ps(a.v, b.v)}; }
inline Floats squareRoot(Floats a) { return {_mm256_sqrt_ps(a.v)}; }

inline DoubleMask operator>(Doubles a, Doubles b) {
    return {reinterpret_cast<LongVector>(_mm256_cmp_pd(a.v, b.v, _CMP_GT_OQ))};
}
inline unsigned bitsOf(DoubleMask m) {
    return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(m.v)));
}
inline Doubles squareRoot(Doubles a) { return {_mm256_sqrt_pd(a.v)}; }
inline Doubles loadAsDoubles(const float* p) { return {_mm256_cvtps_pd(_mm_load_ps(p))}; }
inline void storeAsFloats(float* to, Doubles a) { _mm_store_ps(to, _mm256_cvtpd_ps(a.v)); }
inline Doubles part(Floats a, std::size_t which) {
    return {_mm256_cvtps_pd(which == 0 ? _mm256_castps256_ps128(a.v) : _mm256_extractf128_ps(a.v, 1))};
}
inline Floats join(const Doubles* parts) {
    return {_mm256_insertf128_ps(_mm256_castps128_ps256(_mm256_cvtpd_ps(parts[0].v)), _mm256_cvtpd_ps(parts[1].v), 1)};
}

inline FloatVector joinQuads(Quad a, Quad b) { return _mm256_insertf128_ps(_mm256_castps128_ps256(a), b, 1); }
#include "core/simd/lanes_rows.h"

}  // namespace tspace::simd::avx2
