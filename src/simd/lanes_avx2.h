// SPDX-License-Identifier: MIT
// Eight lanes: AVX2. See lanes_scalar.h for what each function means.
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

#define TSPACE_ROWS

namespace tspace::simd::avx2 {

inline constexpr std::size_t kWidth = 8;

#include "simd/lanes_arithmetic.h"
#include "simd/lanes_loads.h"
#include "simd/lanes_masks.h"

inline unsigned bitsOf(Mask m) { return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(m.v))); }
inline bool all(Mask m) { return bitsOf(m) == 255; }
inline Floats smaller(Floats a, Floats b) { return {_mm256_min_ps(a.v, b.v)}; }
inline Floats larger(Floats a, Floats b) { return {_mm256_max_ps(a.v, b.v)}; }
inline Floats squareRoot(Floats a) { return {_mm256_sqrt_ps(a.v)}; }
inline Floats select(Mask m, Floats yes, Floats no) {
    return {_mm256_blendv_ps(no.v, yes.v, reinterpret_cast<__m256>(m.v))};
}
inline __m256i toWhole(Bits a) { return reinterpret_cast<__m256i>(a.v); }
inline Bits fromWhole(__m256i a) { return {reinterpret_cast<WordVector>(a)}; }
inline Bits smaller(Bits a, Bits b) { return fromWhole(_mm256_min_epu32(toWhole(a), toWhole(b))); }
inline Bits highProduct(Bits a, std::uint32_t k) {
    const __m256i factor = toWhole(broadcastBits(k));
    const __m256i even = _mm256_mul_epu32(toWhole(a), factor);
    const __m256i odd = _mm256_mul_epu32(_mm256_srli_epi64(toWhole(a), 32), factor);
    return fromWhole(_mm256_blend_epi32(_mm256_srli_epi64(even, 32), odd, 0xaa));
}

inline DoubleMask operator>(Doubles a, Doubles b) {
    return {reinterpret_cast<LongVector>(_mm256_cmp_pd(a.v, b.v, _CMP_GT_OQ))};
}
inline unsigned bitsOf(DoubleMask m) {
    return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(m.v)));
}
inline Doubles smaller(Doubles a, Doubles b) { return {_mm256_min_pd(a.v, b.v)}; }
inline Doubles squareRoot(Doubles a) { return {_mm256_sqrt_pd(a.v)}; }
inline Doubles select(DoubleMask m, Doubles yes, Doubles no) {
    return {_mm256_blendv_pd(no.v, yes.v, reinterpret_cast<__m256d>(m.v))};
}
inline Doubles loadAsDoubles(const float* p) { return {_mm256_cvtps_pd(_mm_load_ps(p))}; }
inline void storeAsFloats(float* to, Doubles a) { _mm_store_ps(to, _mm256_cvtpd_ps(a.v)); }
inline Doubles part(Floats a, std::size_t which) {
    return {_mm256_cvtps_pd(which == 0 ? _mm256_castps256_ps128(a.v) : _mm256_extractf128_ps(a.v, 1))};
}
inline Floats join(const Doubles* parts) {
    return {_mm256_insertf128_ps(_mm256_castps128_ps256(_mm256_cvtpd_ps(parts[0].v)), _mm256_cvtpd_ps(parts[1].v), 1)};
}
inline void storeDoubleRows(double* rows, Doubles x, Doubles y, Doubles z, Doubles w) {
    const __m256d xy_even = _mm256_unpacklo_pd(x.v, y.v), xy_odd = _mm256_unpackhi_pd(x.v, y.v);
    const __m256d zw_even = _mm256_unpacklo_pd(z.v, w.v), zw_odd = _mm256_unpackhi_pd(z.v, w.v);
    _mm256_store_pd(rows, _mm256_permute2f128_pd(xy_even, zw_even, 0x20));
    _mm256_store_pd(rows + 4, _mm256_permute2f128_pd(xy_odd, zw_odd, 0x20));
    _mm256_store_pd(rows + 8, _mm256_permute2f128_pd(xy_even, zw_even, 0x31));
    _mm256_store_pd(rows + 12, _mm256_permute2f128_pd(xy_odd, zw_odd, 0x31));
}
inline void loadDoubleRows(const double* rows, Doubles& x, Doubles& y, Doubles& z, Doubles& w) {
    __m256d r[4];
    for (std::size_t i = 0; i < 4; ++i) r[i] = _mm256_load_pd(rows + 4 * i);
    const __m256d xy_even = _mm256_permute2f128_pd(r[0], r[2], 0x20), xy_odd = _mm256_permute2f128_pd(r[1], r[3], 0x20);
    const __m256d zw_even = _mm256_permute2f128_pd(r[0], r[2], 0x31), zw_odd = _mm256_permute2f128_pd(r[1], r[3], 0x31);
    x = {_mm256_unpacklo_pd(xy_even, xy_odd)};
    y = {_mm256_unpackhi_pd(xy_even, xy_odd)};
    z = {_mm256_unpacklo_pd(zw_even, zw_odd)};
    w = {_mm256_unpackhi_pd(zw_even, zw_odd)};
}

struct DoubleRow {
    __m256d v;
};
inline DoubleRow loadDoubleRow(const double* p) { return {_mm256_load_pd(p)}; }
inline void addDoubleRow(double* to, double k, DoubleRow row) {
    _mm256_store_pd(to, _mm256_add_pd(_mm256_load_pd(to), _mm256_mul_pd(_mm256_set1_pd(k), row.v)));
}

template <int kA, int kB, int kC, int kD>
inline FloatVector inFours(FloatVector x, FloatVector y) {
    constexpr int a = kA + kA / 4 * 4, b = kB + kB / 4 * 4, c = kC + kC / 4 * 4, d = kD + kD / 4 * 4;
    return __builtin_shufflevector(x, y, a, b, c, d, a + 4, b + 4, c + 4, d + 4);
}
inline constexpr Quads<0, 1> kQuads;
inline FloatVector joinQuads(Quad a, Quad b) { return _mm256_insertf128_ps(_mm256_castps128_ps256(a), b, 1); }
template <std::size_t kWhich>
inline Quad quad(FloatVector v) {
    return _mm256_extractf128_ps(v, kWhich);
}
#include "simd/lanes_rows.h"

}  // namespace tspace::simd::avx2

#undef TSPACE_ROWS
