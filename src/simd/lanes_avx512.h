// SPDX-License-Identifier: MIT
// Sixteen lanes: AVX-512 F and DQ. See lanes_scalar.h for what each function means.
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace tspace::simd::avx512 {

inline constexpr std::size_t kWidth = 16;

#include "simd/lanes_arithmetic.h"

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

#include "simd/loads_x86.h"
inline __m512 combine(__m128 a, __m128 b, __m128 c, __m128 d) {
    const __m256 ab = _mm256_insertf128_ps(_mm256_castps128_ps256(a), b, 1);
    const __m256 cd = _mm256_insertf128_ps(_mm256_castps128_ps256(c), d, 1);
    return _mm512_insertf32x8(_mm512_castps256_ps512(ab), cd, 1);
}

[[gnu::always_inline]] inline void gather3(const std::byte* base, std::size_t stride, const std::uint32_t* index,
                                           bool exact, Floats& x, Floats& y, Floats& z) {
    const auto at = [&](std::size_t i) { return loadVector(base + stride * index[3 * i], exact); };
    __m512 r[4];
    for (std::size_t j = 0; j < 4; ++j) r[j] = combine(at(j), at(j + 4), at(j + 8), at(j + 12));
    const __m512 ab = _mm512_unpacklo_ps(r[0], r[1]), cd = _mm512_unpacklo_ps(r[2], r[3]);
    x = {_mm512_shuffle_ps(ab, cd, 0x44)};
    y = {_mm512_shuffle_ps(ab, cd, 0xee)};
    z = {_mm512_shuffle_ps(_mm512_unpackhi_ps(r[0], r[1]), _mm512_unpackhi_ps(r[2], r[3]), 0x44)};
}
[[gnu::always_inline]] inline void gather2(const std::byte* base, std::size_t stride, const std::uint32_t* index,
                                           Floats& x, Floats& y) {
    const auto pair = [&](std::size_t i) {
        return loadPair(base + stride * index[3 * i], base + stride * index[3 * i + 3]);
    };
    const __m512 ab = combine(pair(0), pair(4), pair(8), pair(12)), cd = combine(pair(2), pair(6), pair(10), pair(14));
    x = {_mm512_shuffle_ps(ab, cd, 0x88)};
    y = {_mm512_shuffle_ps(ab, cd, 0xdd)};
}
template <std::size_t kStep = 12>
inline void storeRows(float* rows, Floats x, Floats y, Floats z, Floats w) {
    const __m512 xy_low = _mm512_unpacklo_ps(x.v, y.v), xy_high = _mm512_unpackhi_ps(x.v, y.v);
    const __m512 zw_low = _mm512_unpacklo_ps(z.v, w.v), zw_high = _mm512_unpackhi_ps(z.v, w.v);
    const __m512 r[4] = {_mm512_shuffle_ps(xy_low, zw_low, 0x44), _mm512_shuffle_ps(xy_low, zw_low, 0xee),
                         _mm512_shuffle_ps(xy_high, zw_high, 0x44), _mm512_shuffle_ps(xy_high, zw_high, 0xee)};
    for (std::size_t j = 0; j < 4; ++j) _mm_storeu_ps(rows + kStep * j, _mm512_castps512_ps128(r[j]));
    for (std::size_t j = 0; j < 4; ++j) _mm_storeu_ps(rows + kStep * (j + 4), _mm512_extractf32x4_ps(r[j], 1));
    for (std::size_t j = 0; j < 4; ++j) _mm_storeu_ps(rows + kStep * (j + 8), _mm512_extractf32x4_ps(r[j], 2));
    for (std::size_t j = 0; j < 4; ++j) _mm_storeu_ps(rows + kStep * (j + 12), _mm512_extractf32x4_ps(r[j], 3));
}
template <std::size_t kStep>
inline void storePairs(float* rows, Floats x, Floats y) {
    const __m512 low = _mm512_unpacklo_ps(x.v, y.v), high = _mm512_unpackhi_ps(x.v, y.v);
    const auto four = [&](float* to, __m128 a, __m128 b) {
        storeTwoPairs<kStep>(to, a);
        storeTwoPairs<kStep>(to + 2 * kStep, b);
    };
    four(rows, _mm512_castps512_ps128(low), _mm512_castps512_ps128(high));
    four(rows + 4 * kStep, _mm512_extractf32x4_ps(low, 1), _mm512_extractf32x4_ps(high, 1));
    four(rows + 8 * kStep, _mm512_extractf32x4_ps(low, 2), _mm512_extractf32x4_ps(high, 2));
    four(rows + 12 * kStep, _mm512_extractf32x4_ps(low, 3), _mm512_extractf32x4_ps(high, 3));
}

template <std::size_t kStep>
inline void loadRows(const float* rows, Floats& x, Floats& y, Floats& z, Floats& w) {
    const auto at = [&](std::size_t i) { return _mm_loadu_ps(rows + kStep * i); };
    __m512 r[4];
    for (std::size_t j = 0; j < 4; ++j) r[j] = combine(at(j), at(j + 4), at(j + 8), at(j + 12));
    const __m512 ab_low = _mm512_unpacklo_ps(r[0], r[1]), cd_low = _mm512_unpacklo_ps(r[2], r[3]);
    const __m512 ab_high = _mm512_unpackhi_ps(r[0], r[1]), cd_high = _mm512_unpackhi_ps(r[2], r[3]);
    x = {_mm512_shuffle_ps(ab_low, cd_low, 0x44)};
    y = {_mm512_shuffle_ps(ab_low, cd_low, 0xee)};
    z = {_mm512_shuffle_ps(ab_high, cd_high, 0x44)};
    w = {_mm512_shuffle_ps(ab_high, cd_high, 0xee)};
}

inline void loadPairs(const float* pairs, Floats& x, Floats& y) {
    const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    const __m512i odd = _mm512_setr_epi32(1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
    const __m512 a = _mm512_loadu_ps(pairs), b = _mm512_loadu_ps(pairs + 16);
    x = {_mm512_permutex2var_ps(a, even, b)};
    y = {_mm512_permutex2var_ps(a, odd, b)};
}

}  // namespace tspace::simd::avx512
