// SPDX-License-Identifier: MIT
// Four lanes: Advanced SIMD (NEON), which every 64-bit ARM CPU has. See lanes_scalar.h for what each function
// means.
//
// Compilers take vmulq and vaddq for * and +, which they may fuse: only -ffp-contract=off keeps them apart.
// vminq and vmaxq give NaN when either number is NaN, so comparisons choose here.
#pragma once

#include <arm_neon.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace tspace::simd::neon {

inline constexpr std::size_t kWidth = 4;

struct Mask {
    uint32x4_t v;
};
inline Mask operator&(Mask a, Mask b) { return {vandq_u32(a.v, b.v)}; }
inline Mask operator|(Mask a, Mask b) { return {vorrq_u32(a.v, b.v)}; }
inline Mask operator!(Mask a) { return {vmvnq_u32(a.v)}; }
inline unsigned bitsOf(Mask m) {
    constexpr uint32x4_t kBits = {1, 2, 4, 8};
    return vaddvq_u32(vandq_u32(m.v, kBits));
}
inline bool all(Mask m) { return vminvq_u32(m.v) != 0; }

struct Floats {
    float32x4_t v;
};
inline Floats broadcast(float x) { return {vdupq_n_f32(x)}; }
inline Floats operator+(Floats a, Floats b) { return {vaddq_f32(a.v, b.v)}; }
inline Floats operator-(Floats a, Floats b) { return {vsubq_f32(a.v, b.v)}; }
inline Floats operator*(Floats a, Floats b) { return {vmulq_f32(a.v, b.v)}; }
inline Floats operator/(Floats a, Floats b) { return {vdivq_f32(a.v, b.v)}; }
inline Floats smaller(Floats a, Floats b) { return {vbslq_f32(vcltq_f32(a.v, b.v), a.v, b.v)}; }
inline Floats larger(Floats a, Floats b) { return {vbslq_f32(vcgtq_f32(a.v, b.v), a.v, b.v)}; }
inline Floats squareRoot(Floats a) { return {vsqrtq_f32(a.v)}; }
inline Floats absolute(Floats a) { return {vabsq_f32(a.v)}; }
inline Mask operator>(Floats a, Floats b) { return {vcgtq_f32(a.v, b.v)}; }
inline Mask operator<(Floats a, Floats b) { return {vcltq_f32(a.v, b.v)}; }
inline Mask operator==(Floats a, Floats b) { return {vceqq_f32(a.v, b.v)}; }
inline Floats select(Mask m, Floats yes, Floats no) { return {vbslq_f32(m.v, yes.v, no.v)}; }

struct Bits {
    uint32x4_t v;
};
inline Bits broadcastBits(std::uint32_t x) { return {vdupq_n_u32(x)}; }
inline Bits operator&(Bits a, Bits b) { return {vandq_u32(a.v, b.v)}; }
inline Bits operator|(Bits a, Bits b) { return {vorrq_u32(a.v, b.v)}; }
inline Bits operator^(Bits a, Bits b) { return {veorq_u32(a.v, b.v)}; }
inline Bits operator+(Bits a, Bits b) { return {vaddq_u32(a.v, b.v)}; }
inline Bits operator-(Bits a, Bits b) { return {vsubq_u32(a.v, b.v)}; }
template <int kBy>
inline Bits shiftLeft(Bits a) {
    return {vshlq_n_u32(a.v, kBy)};
}
template <int kBy>
inline Bits shiftRight(Bits a) {
    return {vshrq_n_u32(a.v, kBy)};
}
inline Bits smaller(Bits a, Bits b) { return {vminq_u32(a.v, b.v)}; }
inline Bits product(Bits a, std::uint32_t k) { return {vmulq_u32(a.v, vdupq_n_u32(k))}; }
inline Bits highProduct(Bits a, std::uint32_t k) {
    const uint64x2_t low = vmull_u32(vget_low_u32(a.v), vdup_n_u32(k)), high = vmull_high_u32(a.v, vdupq_n_u32(k));
    return {vuzp2q_u32(vreinterpretq_u32_u64(low), vreinterpretq_u32_u64(high))};
}
inline Floats toFloats(Bits a) { return {vcvtq_f32_s32(vreinterpretq_s32_u32(a.v))}; }
inline Bits orWhere(Bits a, Mask m, std::uint32_t bit) { return {vorrq_u32(a.v, vandq_u32(m.v, vdupq_n_u32(bit)))}; }
inline Floats asFloats(Bits b) { return {vreinterpretq_f32_u32(b.v)}; }
inline Bits asBits(Floats f) { return {vreinterpretq_u32_f32(f.v)}; }

/// The instructions of vld1 and vst1, but at any address, and over numbers of other types.
template <class Vector>
inline Vector fromMemory(const void* from) {
    Vector v;
    std::memcpy(&v, from, sizeof v);
    return v;
}
template <class Vector>
inline void toMemory(void* to, Vector v) {
    std::memcpy(to, &v, sizeof v);
}

struct Doubles {
    float64x2_t v;
};
inline constexpr std::size_t kDoubleParts = 2;
inline Doubles loadAsDoubles(const float* p) { return {vcvt_f64_f32(fromMemory<float32x2_t>(p))}; }
inline void storeAsFloats(float* to, Doubles a) { toMemory(to, vcvt_f32_f64(a.v)); }
inline Doubles broadcastDouble(double x) { return {vdupq_n_f64(x)}; }
inline Doubles part(Floats a, std::size_t which) {
    return {which == 0 ? vcvt_f64_f32(vget_low_f32(a.v)) : vcvt_high_f64_f32(a.v)};
}
inline Floats join(const Doubles* parts) { return {vcvt_high_f32_f64(vcvt_f32_f64(parts[0].v), parts[1].v)}; }
inline Doubles operator+(Doubles a, Doubles b) { return {vaddq_f64(a.v, b.v)}; }
inline Doubles operator-(Doubles a, Doubles b) { return {vsubq_f64(a.v, b.v)}; }
inline Doubles operator*(Doubles a, Doubles b) { return {vmulq_f64(a.v, b.v)}; }
inline Doubles operator/(Doubles a, Doubles b) { return {vdivq_f64(a.v, b.v)}; }
inline Doubles smaller(Doubles a, Doubles b) { return {vbslq_f64(vcltq_f64(a.v, b.v), a.v, b.v)}; }
inline Doubles squareRoot(Doubles a) { return {vsqrtq_f64(a.v)}; }
inline Doubles absolute(Doubles a) { return {vabsq_f64(a.v)}; }
struct DoubleMask {
    uint64x2_t v;
};
inline DoubleMask operator>(Doubles a, Doubles b) { return {vcgtq_f64(a.v, b.v)}; }
inline DoubleMask operator&(DoubleMask a, DoubleMask b) { return {vandq_u64(a.v, b.v)}; }
inline unsigned bitsOf(DoubleMask m) {
    constexpr uint64x2_t kBits = {1, 2};
    return static_cast<unsigned>(vaddvq_u64(vandq_u64(m.v, kBits)));
}
inline uint64x2_t signBits() { return vdupq_n_u64(std::uint64_t{1} << 63); }
inline Doubles turnedOver(Doubles a, uint64x2_t signs) {
    return {vreinterpretq_f64_u64(veorq_u64(vreinterpretq_u64_f64(a.v), signs))};
}
inline Doubles withSignOf(Doubles a, Doubles b) {
    return turnedOver(a, vandq_u64(vreinterpretq_u64_f64(b.v), signBits()));
}
inline Doubles select(DoubleMask m, Doubles yes, Doubles no) { return {vbslq_f64(m.v, yes.v, no.v)}; }
inline Doubles keepWhere(DoubleMask m, Doubles a) {
    return {vreinterpretq_f64_u64(vandq_u64(m.v, vreinterpretq_u64_f64(a.v)))};
}
inline Doubles negateUnless(DoubleMask m, Doubles a) { return turnedOver(a, vbicq_u64(signBits(), m.v)); }
inline void storeDoubles(double* to, Doubles a) { toMemory(to, a.v); }
inline void storeDoubleRows(double* rows, Doubles x, Doubles y, Doubles z, Doubles w) {
    toMemory(rows, vzip1q_f64(x.v, y.v));
    toMemory(rows + 2, vzip1q_f64(z.v, w.v));
    toMemory(rows + 4, vzip2q_f64(x.v, y.v));
    toMemory(rows + 6, vzip2q_f64(z.v, w.v));
}
inline void loadDoubleRows(const double* rows, Doubles& x, Doubles& y, Doubles& z, Doubles& w) {
    const auto at = [&](std::size_t i) { return fromMemory<float64x2_t>(rows + i); };
    x = {vzip1q_f64(at(0), at(4))};
    y = {vzip2q_f64(at(0), at(4))};
    z = {vzip1q_f64(at(2), at(6))};
    w = {vzip2q_f64(at(2), at(6))};
}

struct DoubleRow {
    float64x2_t low, high;
};
inline DoubleRow loadDoubleRow(const double* p) { return {fromMemory<float64x2_t>(p), fromMemory<float64x2_t>(p + 2)}; }
inline void addDoubleRow(double* to, double k, DoubleRow row) {
    const float64x2_t factor = vdupq_n_f64(k);
    toMemory(to, vaddq_f64(fromMemory<float64x2_t>(to), vmulq_f64(factor, row.low)));
    toMemory(to + 2, vaddq_f64(fromMemory<float64x2_t>(to + 2), vmulq_f64(factor, row.high)));
}

/// Three floats. `exact` reads no more; otherwise the four bytes after them are read too.
inline float32x4_t loadVector(const std::byte* p, bool exact) {
    if (!exact) return fromMemory<float32x4_t>(p);
    return vcombine_f32(fromMemory<float32x2_t>(p), vdup_n_f32(fromMemory<float>(p + 8)));
}

inline float32x4_t lowerHalves(float32x4_t a, float32x4_t b) {
    return vreinterpretq_f32_f64(vzip1q_f64(vreinterpretq_f64_f32(a), vreinterpretq_f64_f32(b)));
}
inline float32x4_t upperHalves(float32x4_t a, float32x4_t b) {
    return vreinterpretq_f32_f64(vzip2q_f64(vreinterpretq_f64_f32(a), vreinterpretq_f64_f32(b)));
}
/// Rows become columns.
inline void transpose(float32x4_t (&r)[4]) {
    const float32x4_t ab_even = vtrn1q_f32(r[0], r[1]), ab_odd = vtrn2q_f32(r[0], r[1]);
    const float32x4_t cd_even = vtrn1q_f32(r[2], r[3]), cd_odd = vtrn2q_f32(r[2], r[3]);
    r[0] = lowerHalves(ab_even, cd_even);
    r[1] = lowerHalves(ab_odd, cd_odd);
    r[2] = upperHalves(ab_even, cd_even);
    r[3] = upperHalves(ab_odd, cd_odd);
}

inline void gather3(const std::byte* base, std::size_t stride, const std::uint32_t* index, bool exact, Floats& x,
                    Floats& y, Floats& z) {
    float32x4_t r[4];
    for (std::size_t i = 0; i < 4; ++i) r[i] = loadVector(base + stride * index[3 * i], exact);
    transpose(r);
    x = {r[0]};
    y = {r[1]};
    z = {r[2]};
}
inline void gather2(const std::byte* base, std::size_t stride, const std::uint32_t* index, Floats& x, Floats& y) {
    const auto at = [&](std::size_t i) { return fromMemory<float32x2_t>(base + stride * index[3 * i]); };
    const float32x4_t ab = vcombine_f32(at(0), at(1)), cd = vcombine_f32(at(2), at(3));
    x = {vuzp1q_f32(ab, cd)};
    y = {vuzp2q_f32(ab, cd)};
}
inline void store(float* to, Floats a) { toMemory(to, a.v); }
inline Floats load(const float* p) { return {fromMemory<float32x4_t>(p)}; }
inline void store(std::uint32_t* to, Bits b) { toMemory(to, b.v); }
inline Bits load(const std::uint32_t* p) { return {fromMemory<uint32x4_t>(p)}; }
template <std::size_t kStep = 12>
inline void storeRows(float* rows, Floats x, Floats y, Floats z, Floats w) {
    float32x4_t r[4] = {x.v, y.v, z.v, w.v};
    transpose(r);
    for (std::size_t i = 0; i < 4; ++i) toMemory(rows + kStep * i, r[i]);
}
template <std::size_t kStep>
inline void storePairs(float* rows, Floats x, Floats y) {
    const float32x4_t low = vzip1q_f32(x.v, y.v), high = vzip2q_f32(x.v, y.v);
    toMemory(rows, vget_low_f32(low));
    toMemory(rows + kStep, vget_high_f32(low));
    toMemory(rows + 2 * kStep, vget_low_f32(high));
    toMemory(rows + 3 * kStep, vget_high_f32(high));
}

template <std::size_t kStep>
inline void loadRows(const float* rows, Floats& x, Floats& y, Floats& z, Floats& w) {
    float32x4_t r[4];
    for (std::size_t i = 0; i < 4; ++i) r[i] = fromMemory<float32x4_t>(rows + kStep * i);
    transpose(r);
    x = {r[0]};
    y = {r[1]};
    z = {r[2]};
    w = {r[3]};
}

inline void loadPairs(const float* pairs, Floats& x, Floats& y) {
    const float32x4_t ab = fromMemory<float32x4_t>(pairs), cd = fromMemory<float32x4_t>(pairs + 4);
    x = {vuzp1q_f32(ab, cd)};
    y = {vuzp2q_f32(ab, cd)};
}

}  // namespace tspace::simd::neon
