// SPDX-License-Identifier: MIT
// Four lanes: SSE2, which every x86-64 CPU has. See lanes_scalar.h for what each function means.
#pragma once

#include <emmintrin.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace tspace::simd::sse2 {

inline constexpr std::size_t kWidth = 4;

struct Mask {
    __m128 v;
};
inline Mask operator&(Mask a, Mask b) { return {_mm_and_ps(a.v, b.v)}; }
inline Mask operator|(Mask a, Mask b) { return {_mm_or_ps(a.v, b.v)}; }
inline Mask operator!(Mask a) { return {_mm_xor_ps(a.v, _mm_castsi128_ps(_mm_set1_epi32(-1)))}; }
inline unsigned bitsOf(Mask m) { return static_cast<unsigned>(_mm_movemask_ps(m.v)); }
inline bool all(Mask m) { return _mm_movemask_ps(m.v) == 15; }

struct Floats {
    __m128 v;
};
inline Floats broadcast(float x) { return {_mm_set1_ps(x)}; }
inline Floats operator+(Floats a, Floats b) { return {_mm_add_ps(a.v, b.v)}; }
inline Floats operator-(Floats a, Floats b) { return {_mm_sub_ps(a.v, b.v)}; }
inline Floats operator*(Floats a, Floats b) { return {_mm_mul_ps(a.v, b.v)}; }
inline Floats operator/(Floats a, Floats b) { return {_mm_div_ps(a.v, b.v)}; }
inline Floats smaller(Floats a, Floats b) { return {_mm_min_ps(a.v, b.v)}; }
inline Floats larger(Floats a, Floats b) { return {_mm_max_ps(a.v, b.v)}; }
inline Floats squareRoot(Floats a) { return {_mm_sqrt_ps(a.v)}; }
inline Floats absolute(Floats a) { return {_mm_and_ps(a.v, _mm_castsi128_ps(_mm_set1_epi32(0x7fffffff)))}; }
inline Mask operator>(Floats a, Floats b) { return {_mm_cmpgt_ps(a.v, b.v)}; }
inline Mask operator<(Floats a, Floats b) { return {_mm_cmplt_ps(a.v, b.v)}; }
inline Mask operator==(Floats a, Floats b) { return {_mm_cmpeq_ps(a.v, b.v)}; }
inline Floats select(Mask m, Floats yes, Floats no) {
    return {_mm_or_ps(_mm_and_ps(m.v, yes.v), _mm_andnot_ps(m.v, no.v))};
}

struct Bits {
    __m128 v;
};
inline Bits broadcastBits(std::uint32_t x) { return {_mm_castsi128_ps(_mm_set1_epi32(static_cast<int>(x)))}; }
inline Bits operator&(Bits a, Bits b) { return {_mm_and_ps(a.v, b.v)}; }
inline Bits operator|(Bits a, Bits b) { return {_mm_or_ps(a.v, b.v)}; }
inline Bits operator^(Bits a, Bits b) { return {_mm_xor_ps(a.v, b.v)}; }
inline __m128i toWhole(Bits a) { return _mm_castps_si128(a.v); }
inline Bits fromWhole(__m128i a) { return {_mm_castsi128_ps(a)}; }
inline Bits operator+(Bits a, Bits b) { return fromWhole(_mm_add_epi32(toWhole(a), toWhole(b))); }
inline Bits operator-(Bits a, Bits b) { return fromWhole(_mm_sub_epi32(toWhole(a), toWhole(b))); }
template <int kBy>
inline Bits shiftLeft(Bits a) {
    return fromWhole(_mm_slli_epi32(toWhole(a), kBy));
}
template <int kBy>
inline Bits shiftRight(Bits a) {
    return fromWhole(_mm_srli_epi32(toWhole(a), kBy));
}
inline Bits smaller(Bits a, Bits b) {
    const __m128 m = _mm_castsi128_ps(_mm_cmplt_epi32(toWhole(a), toWhole(b)));
    return {_mm_or_ps(_mm_and_ps(m, a.v), _mm_andnot_ps(m, b.v))};
}
/// The halves of 64-bit products that `choice` names, of lanes 0 and 2, 1 and 3.
template <int choice>
inline Bits halfProduct(Bits a, std::uint32_t k) {
    const __m128i factor = _mm_set1_epi32(static_cast<int>(k));
    const __m128i even = _mm_mul_epu32(toWhole(a), factor), odd = _mm_mul_epu32(_mm_srli_epi64(toWhole(a), 32), factor);
    return fromWhole(_mm_unpacklo_epi32(_mm_shuffle_epi32(even, choice), _mm_shuffle_epi32(odd, choice)));
}
inline Bits product(Bits a, std::uint32_t k) { return halfProduct<0x08>(a, k); }
inline Bits highProduct(Bits a, std::uint32_t k) { return halfProduct<0x0d>(a, k); }
inline Floats toFloats(Bits a) { return {_mm_cvtepi32_ps(toWhole(a))}; }
inline Bits orWhere(Bits a, Mask m, std::uint32_t bit) {
    return {_mm_or_ps(a.v, _mm_and_ps(m.v, broadcastBits(bit).v))};
}
inline Floats asFloats(Bits b) { return {b.v}; }
inline Bits asBits(Floats f) { return {f.v}; }

struct Doubles {
    __m128d v;
};
inline constexpr std::size_t kDoubleParts = 2;
inline Doubles loadAsDoubles(const float* p) {
    return {_mm_cvtps_pd(_mm_castpd_ps(_mm_load_sd(reinterpret_cast<const double*>(p))))};
}
inline void storeAsFloats(float* to, Doubles a) {
    _mm_store_sd(reinterpret_cast<double*>(to), _mm_castps_pd(_mm_cvtpd_ps(a.v)));
}
inline Doubles broadcastDouble(double x) { return {_mm_set1_pd(x)}; }
inline Doubles part(Floats a, std::size_t which) { return {_mm_cvtps_pd(which == 0 ? a.v : _mm_movehl_ps(a.v, a.v))}; }
inline Floats join(const Doubles* parts) { return {_mm_movelh_ps(_mm_cvtpd_ps(parts[0].v), _mm_cvtpd_ps(parts[1].v))}; }
inline Doubles operator+(Doubles a, Doubles b) { return {_mm_add_pd(a.v, b.v)}; }
inline Doubles operator-(Doubles a, Doubles b) { return {_mm_sub_pd(a.v, b.v)}; }
inline Doubles operator*(Doubles a, Doubles b) { return {_mm_mul_pd(a.v, b.v)}; }
inline Doubles operator/(Doubles a, Doubles b) { return {_mm_div_pd(a.v, b.v)}; }
inline Doubles smaller(Doubles a, Doubles b) { return {_mm_min_pd(a.v, b.v)}; }
inline Doubles squareRoot(Doubles a) { return {_mm_sqrt_pd(a.v)}; }
inline Doubles absolute(Doubles a) { return {_mm_andnot_pd(_mm_set1_pd(-0.0), a.v)}; }
struct DoubleMask {
    __m128d v;
};
inline DoubleMask operator>(Doubles a, Doubles b) { return {_mm_cmpgt_pd(a.v, b.v)}; }
inline DoubleMask operator&(DoubleMask a, DoubleMask b) { return {_mm_and_pd(a.v, b.v)}; }
inline unsigned bitsOf(DoubleMask m) { return static_cast<unsigned>(_mm_movemask_pd(m.v)); }
inline Doubles withSignOf(Doubles a, Doubles b) { return {_mm_xor_pd(a.v, _mm_and_pd(b.v, _mm_set1_pd(-0.0)))}; }
inline Doubles select(DoubleMask m, Doubles yes, Doubles no) {
    return {_mm_or_pd(_mm_and_pd(m.v, yes.v), _mm_andnot_pd(m.v, no.v))};
}
inline Doubles keepWhere(DoubleMask m, Doubles a) { return {_mm_and_pd(m.v, a.v)}; }
inline Doubles negateUnless(DoubleMask m, Doubles a) {
    return {_mm_xor_pd(a.v, _mm_andnot_pd(m.v, _mm_set1_pd(-0.0)))};
}
inline void storeDoubles(double* to, Doubles a) { _mm_store_pd(to, a.v); }
inline void storeDoubleRows(double* rows, Doubles x, Doubles y, Doubles z, Doubles w) {
    _mm_store_pd(rows, _mm_unpacklo_pd(x.v, y.v));
    _mm_store_pd(rows + 2, _mm_unpacklo_pd(z.v, w.v));
    _mm_store_pd(rows + 4, _mm_unpackhi_pd(x.v, y.v));
    _mm_store_pd(rows + 6, _mm_unpackhi_pd(z.v, w.v));
}
inline void loadDoubleRows(const double* rows, Doubles& x, Doubles& y, Doubles& z, Doubles& w) {
    const __m128d xy[2] = {_mm_load_pd(rows), _mm_load_pd(rows + 4)};
    const __m128d zw[2] = {_mm_load_pd(rows + 2), _mm_load_pd(rows + 6)};
    x = {_mm_unpacklo_pd(xy[0], xy[1])};
    y = {_mm_unpackhi_pd(xy[0], xy[1])};
    z = {_mm_unpacklo_pd(zw[0], zw[1])};
    w = {_mm_unpackhi_pd(zw[0], zw[1])};
}

struct DoubleRow {
    __m128d low, high;
};
inline DoubleRow loadDoubleRow(const double* p) { return {_mm_load_pd(p), _mm_load_pd(p + 2)}; }
inline void addDoubleRow(double* to, double k, DoubleRow row) {
    const __m128d factor = _mm_set1_pd(k);
    _mm_store_pd(to, _mm_add_pd(_mm_load_pd(to), _mm_mul_pd(factor, row.low)));
    _mm_store_pd(to + 2, _mm_add_pd(_mm_load_pd(to + 2), _mm_mul_pd(factor, row.high)));
}

#include "simd/loads_x86.h"

inline void gather3(const std::byte* base, std::size_t stride, const std::uint32_t* index, bool exact, Floats& x,
                    Floats& y, Floats& z) {
    const __m128 a = loadVector(base + stride * index[0], exact), b = loadVector(base + stride * index[3], exact);
    const __m128 c = loadVector(base + stride * index[6], exact), d = loadVector(base + stride * index[9], exact);
    const __m128 ab = _mm_unpacklo_ps(a, b), cd = _mm_unpacklo_ps(c, d);
    x = {_mm_movelh_ps(ab, cd)};
    y = {_mm_movehl_ps(cd, ab)};
    z = {_mm_movelh_ps(_mm_unpackhi_ps(a, b), _mm_unpackhi_ps(c, d))};
}
inline void gather2(const std::byte* base, std::size_t stride, const std::uint32_t* index, Floats& x, Floats& y) {
    const __m128 ab = loadPair(base + stride * index[0], base + stride * index[3]);
    const __m128 cd = loadPair(base + stride * index[6], base + stride * index[9]);
    x = {_mm_shuffle_ps(ab, cd, 0x88)};
    y = {_mm_shuffle_ps(ab, cd, 0xdd)};
}
inline void store(float* to, Floats a) { _mm_store_ps(to, a.v); }
inline Floats load(const float* p) { return {_mm_load_ps(p)}; }
inline void store(std::uint32_t* to, Bits b) { _mm_store_ps(reinterpret_cast<float*>(to), b.v); }
inline Bits load(const std::uint32_t* p) { return fromWhole(_mm_load_si128(reinterpret_cast<const __m128i*>(p))); }
template <std::size_t kStep = 12>
inline void storeRows(float* rows, Floats x, Floats y, Floats z, Floats w) {
    const __m128 xy_low = _mm_unpacklo_ps(x.v, y.v), xy_high = _mm_unpackhi_ps(x.v, y.v);
    const __m128 zw_low = _mm_unpacklo_ps(z.v, w.v), zw_high = _mm_unpackhi_ps(z.v, w.v);
    _mm_storeu_ps(rows, _mm_movelh_ps(xy_low, zw_low));
    _mm_storeu_ps(rows + kStep, _mm_movehl_ps(zw_low, xy_low));
    _mm_storeu_ps(rows + 2 * kStep, _mm_movelh_ps(xy_high, zw_high));
    _mm_storeu_ps(rows + 3 * kStep, _mm_movehl_ps(zw_high, xy_high));
}
template <std::size_t kStep>
inline void storePairs(float* rows, Floats x, Floats y) {
    const __m128 low = _mm_unpacklo_ps(x.v, y.v), high = _mm_unpackhi_ps(x.v, y.v);
    storeTwoPairs<kStep>(rows, low);
    storeTwoPairs<kStep>(rows + 2 * kStep, high);
}

template <std::size_t kStep>
inline void loadRows(const float* rows, Floats& x, Floats& y, Floats& z, Floats& w) {
    const __m128 a = _mm_loadu_ps(rows), b = _mm_loadu_ps(rows + kStep), c = _mm_loadu_ps(rows + 2 * kStep),
                 d = _mm_loadu_ps(rows + 3 * kStep);
    const __m128 ab_low = _mm_unpacklo_ps(a, b), cd_low = _mm_unpacklo_ps(c, d);
    const __m128 ab_high = _mm_unpackhi_ps(a, b), cd_high = _mm_unpackhi_ps(c, d);
    x = {_mm_movelh_ps(ab_low, cd_low)};
    y = {_mm_movehl_ps(cd_low, ab_low)};
    z = {_mm_movelh_ps(ab_high, cd_high)};
    w = {_mm_movehl_ps(cd_high, ab_high)};
}

inline void loadPairs(const float* pairs, Floats& x, Floats& y) {
    const __m128 a = _mm_loadu_ps(pairs), b = _mm_loadu_ps(pairs + 4);
    x = {_mm_shuffle_ps(a, b, 0x88)};
    y = {_mm_shuffle_ps(a, b, 0xdd)};
}

}  // namespace tspace::simd::sse2
