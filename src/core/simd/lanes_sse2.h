// SPDX-License-Identifier: MIT
// Four lanes: SSE2, supported by every x86-64 CPU. lanes_scalar.h documents each function.
#pragma once

#include <emmintrin.h>

#include "core/simd/lanes.h"

namespace tspace::simd::sse2 {

inline constexpr std::size_t kWidth = 4;

#include "core/simd/lanes_arithmetic.h"
#include "core/simd/lanes_rows.h"

inline unsigned bitsOf(Mask m) { return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(m.v))); }
/// Return the minimum and maximum, with intrinsics: GCC does not recognize a minimum if one operand is a constant.
inline Floats smaller(Floats a, Floats b) { return {_mm_min_ps(a.v, b.v)}; }
inline Floats larger(Floats a, Floats b) { return {_mm_max_ps(a.v, b.v)}; }
inline Floats squareRoot(Floats a) { return {_mm_sqrt_ps(a.v)}; }

/// Compares with an intrinsic, because GCC compiles the operator to branches.
inline DoubleMask operator>(Doubles a, Doubles b) { return {reinterpret_cast<LongVector>(_mm_cmpgt_pd(a.v, b.v))}; }
inline unsigned bitsOf(DoubleMask m) { return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(m.v))); }
inline Doubles squareRoot(Doubles a) { return {_mm_sqrt_pd(a.v)}; }
inline Doubles loadAsDoubles(const float* p) {
    return {_mm_cvtps_pd(_mm_castpd_ps(_mm_load_sd(reinterpret_cast<const double*>(p))))};
}
inline void storeAsFloats(float* to, Doubles a) {
    _mm_store_sd(reinterpret_cast<double*>(to), _mm_castps_pd(_mm_cvtpd_ps(a.v)));
}
inline Doubles part(Floats a, std::size_t which) { return {_mm_cvtps_pd(which == 0 ? a.v : _mm_movehl_ps(a.v, a.v))}; }
inline Floats join(const Doubles* parts) { return {_mm_movelh_ps(_mm_cvtpd_ps(parts[0].v), _mm_cvtpd_ps(parts[1].v))}; }

}  // namespace tspace::simd::sse2
