// SPDX-License-Identifier: MIT
// Sixteen lanes: AVX-512 F and DQ. See lanes_scalar.h for what each function means.
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

#define TSPACE_ROWS [[gnu::always_inline]]

namespace tspace::simd::avx512 {

inline constexpr std::size_t kWidth = 16;

#include "simd/lanes_arithmetic.h"
#include "simd/lanes_loads.h"

struct Mask {
    __mmask16 v;
};
inline Mask operator&(Mask a, Mask b) { return {static_cast<__mmask16>(a.v & b.v)}; }
inline Mask operator|(Mask a, Mask b) { return {static_cast<__mmask16>(a.v | b.v)}; }
inline Mask operator!(Mask a) { return {static_cast<__mmask16>(~a.v)}; }
inline unsigned bitsOf(Mask m) { return m.v; }
inline bool all(Mask m) { return m.v == 0xffff; }
inline Mask operator>(Floats a, Floats b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_GT_OQ)}; }
inline Mask operator<(Floats a, Floats b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ)}; }
inline Mask operator==(Floats a, Floats b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_EQ_OQ)}; }
inline Floats smaller(Floats a, Floats b) { return {_mm512_min_ps(a.v, b.v)}; }
inline Floats larger(Floats a, Floats b) { return {_mm512_max_ps(a.v, b.v)}; }
inline Floats squareRoot(Floats a) { return {_mm512_sqrt_ps(a.v)}; }
inline Floats select(Mask m, Floats yes, Floats no) { return {_mm512_mask_blend_ps(m.v, no.v, yes.v)}; }
inline __m512i toWhole(Bits a) { return reinterpret_cast<__m512i>(a.v); }
inline Bits fromWhole(__m512i a) { return {reinterpret_cast<WordVector>(a)}; }
inline Bits smaller(Bits a, Bits b) { return fromWhole(_mm512_min_epu32(toWhole(a), toWhole(b))); }
inline Bits highProduct(Bits a, std::uint32_t k) {
    const __m512i factor = toWhole(broadcastBits(k)), even = _mm512_mul_epu32(toWhole(a), factor);
    const __m512i odd = _mm512_mul_epu32(_mm512_srli_epi64(toWhole(a), 32), factor);
    return fromWhole(_mm512_mask_blend_epi32(0xaaaa, _mm512_srli_epi64(even, 32), odd));
}
inline Bits orWhere(Bits a, Mask m, std::uint32_t bit) {
    return fromWhole(_mm512_mask_or_epi32(toWhole(a), m.v, toWhole(a), toWhole(broadcastBits(bit))));
}

struct DoubleMask {
    __mmask8 v;
};
inline DoubleMask operator>(Doubles a, Doubles b) { return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_GT_OQ)}; }
inline DoubleMask operator&(DoubleMask a, DoubleMask b) { return {static_cast<__mmask8>(a.v & b.v)}; }
inline unsigned bitsOf(DoubleMask m) { return m.v; }
inline Doubles smaller(Doubles a, Doubles b) { return {_mm512_min_pd(a.v, b.v)}; }
inline Doubles squareRoot(Doubles a) { return {_mm512_sqrt_pd(a.v)}; }
inline Doubles select(DoubleMask m, Doubles yes, Doubles no) { return {_mm512_mask_blend_pd(m.v, no.v, yes.v)}; }
inline Doubles keepWhere(DoubleMask m, Doubles a) { return {_mm512_maskz_mov_pd(m.v, a.v)}; }
inline Doubles negateUnless(DoubleMask m, Doubles a) {
    return {_mm512_mask_xor_pd(_mm512_xor_pd(a.v, _mm512_set1_pd(-0.0)), m.v, a.v, _mm512_setzero_pd())};
}
inline Doubles loadAsDoubles(const float* p) { return {_mm512_cvtps_pd(_mm256_load_ps(p))}; }
inline void storeAsFloats(float* to, Doubles a) { _mm256_store_ps(to, _mm512_cvtpd_ps(a.v)); }
inline Doubles part(Floats a, std::size_t which) {
    return {_mm512_cvtps_pd(which == 0 ? _mm512_castps512_ps256(a.v) : _mm512_extractf32x8_ps(a.v, 1))};
}
inline Floats join(const Doubles* parts) {
    return {_mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps(parts[0].v)), _mm512_cvtpd_ps(parts[1].v), 1)};
}
inline void storeDoubleRows(double* rows, Doubles x, Doubles y, Doubles z, Doubles w) {
    const __m512d xy[2] = {_mm512_unpacklo_pd(x.v, y.v), _mm512_unpackhi_pd(x.v, y.v)};
    const __m512d zw[2] = {_mm512_unpacklo_pd(z.v, w.v), _mm512_unpackhi_pd(z.v, w.v)};
    const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11),
                  high = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
    for (std::size_t odd = 0; odd < 2; ++odd) {  // even or odd rows: 0 and 2, 4 and 6 and so on
        const __m512d r02 = _mm512_permutex2var_pd(xy[odd], low, zw[odd]);
        const __m512d r46 = _mm512_permutex2var_pd(xy[odd], high, zw[odd]);
        double* to = rows + 4 * odd;
        _mm256_store_pd(to, _mm512_castpd512_pd256(r02));
        _mm256_store_pd(to + 8, _mm512_extractf64x4_pd(r02, 1));
        _mm256_store_pd(to + 16, _mm512_castpd512_pd256(r46));
        _mm256_store_pd(to + 24, _mm512_extractf64x4_pd(r46, 1));
    }
}
inline void loadDoubleRows(const double* rows, Doubles& x, Doubles& y, Doubles& z, Doubles& w) {
    __m512d r[4];
    for (std::size_t i = 0; i < 4; ++i) r[i] = _mm512_loadu_pd(rows + 8 * i);
    const __m512d xy[2] = {_mm512_shuffle_f64x2(r[0], r[1], 0x88), _mm512_shuffle_f64x2(r[2], r[3], 0x88)};
    const __m512d zw[2] = {_mm512_shuffle_f64x2(r[0], r[1], 0xdd), _mm512_shuffle_f64x2(r[2], r[3], 0xdd)};
    const __m512i even = _mm512_setr_epi64(0, 2, 4, 6, 8, 10, 12, 14),
                  odd = _mm512_setr_epi64(1, 3, 5, 7, 9, 11, 13, 15);
    x = {_mm512_permutex2var_pd(xy[0], even, xy[1])};
    y = {_mm512_permutex2var_pd(xy[0], odd, xy[1])};
    z = {_mm512_permutex2var_pd(zw[0], even, zw[1])};
    w = {_mm512_permutex2var_pd(zw[0], odd, zw[1])};
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
    constexpr int a = kA + kA / 4 * 12, b = kB + kB / 4 * 12, c = kC + kC / 4 * 12, d = kD + kD / 4 * 12;
    return __builtin_shufflevector(x, y, a, b, c, d, a + 4, b + 4, c + 4, d + 4, a + 8, b + 8, c + 8, d + 8, a + 12,
                                   b + 12, c + 12, d + 12);
}
inline constexpr Quads<0, 1, 2, 3> kQuads;
inline FloatVector joinQuads(Quad a, Quad b, Quad c, Quad d) {
    const __m256 ab = _mm256_insertf128_ps(_mm256_castps128_ps256(a), b, 1);
    const __m256 cd = _mm256_insertf128_ps(_mm256_castps128_ps256(c), d, 1);
    return _mm512_insertf32x8(_mm512_castps256_ps512(ab), cd, 1);
}
template <std::size_t kWhich>
inline Quad quad(FloatVector v) {
    return _mm512_extractf32x4_ps(v, kWhich);
}
#include "simd/lanes_rows.h"

}  // namespace tspace::simd::avx512

#undef TSPACE_ROWS
