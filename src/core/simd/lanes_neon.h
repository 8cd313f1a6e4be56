// SPDX-License-Identifier: MIT
// Four lanes: Advanced SIMD (NEON), supported by every 64-bit ARM CPU. lanes_scalar.h documents each function.
//
// Compilers may fuse * and + unless -ffp-contract=off is set. vminq and vmaxq return NaN if either operand is NaN, so
// comparisons are used here.
#pragma once

#include <arm_neon.h>

#include "core/simd/lanes.h"

namespace tspace::simd::neon {

inline constexpr std::size_t kWidth = 4;

#include "core/simd/lanes_arithmetic.h"
#include "core/simd/lanes_rows.h"

inline unsigned bitsOf(Mask m) {
    constexpr WholeVector kBits = {1, 2, 4, 8};
    return vaddvq_u32(reinterpret_cast<uint32x4_t>(m.v & kBits));
}
inline Floats smaller(Floats a, Floats b) { return {a.v < b.v ? a.v : b.v}; }
inline Floats larger(Floats a, Floats b) { return {a.v > b.v ? a.v : b.v}; }
inline Floats squareRoot(Floats a) {
    return {reinterpret_cast<FloatVector>(vsqrtq_f32(reinterpret_cast<float32x4_t>(a.v)))};
}

inline float64x2_t neonOf(Doubles a) { return reinterpret_cast<float64x2_t>(a.v); }
inline Doubles fromNeon(float64x2_t v) { return {reinterpret_cast<DoubleVector>(v)}; }
inline DoubleMask operator>(Doubles a, Doubles b) { return {a.v > b.v}; }
inline unsigned bitsOf(DoubleMask m) {
    constexpr LongVector kBits = {1, 2};
    return static_cast<unsigned>(vaddvq_u64(reinterpret_cast<uint64x2_t>(m.v & kBits)));
}
inline Doubles squareRoot(Doubles a) { return fromNeon(vsqrtq_f64(neonOf(a))); }
inline Doubles loadAsDoubles(const float* p) { return fromNeon(vcvt_f64_f32(vld1_f32(p))); }
inline void storeAsFloats(float* to, Doubles a) { vst1_f32(to, vcvt_f32_f64(neonOf(a))); }
inline Doubles part(Floats a, std::size_t which) {
    const auto four = reinterpret_cast<float32x4_t>(a.v);
    return fromNeon(which == 0 ? vcvt_f64_f32(vget_low_f32(four)) : vcvt_high_f64_f32(four));
}
inline Floats join(const Doubles* parts) {
    return {reinterpret_cast<FloatVector>(vcvt_high_f32_f64(vcvt_f32_f64(neonOf(parts[0])), neonOf(parts[1])))};
}

}  // namespace tspace::simd::neon
