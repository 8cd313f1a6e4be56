// SPDX-License-Identifier: MIT
// Four lanes: WebAssembly SIMD, supported by every engine. Relaxed SIMD is not used: its results depend on the machine.
// lanes_scalar.h documents each function.
//
// f32x4.min and max return NaN if either operand is NaN, so pmin and pmax are used; they return the second operand
// then.
#pragma once

#include <wasm_simd128.h>

#include "core/simd/lanes.h"

// WebAssembly programs are compiled for size, and Clang then calls even functions of one instruction. Functions that
// move rows consist of many long instructions: they are not inlined, except in kernels that are compiled for speed.
#ifdef TSPACE_FAST_KERNELS
#define TSPACE_ROWS [[gnu::always_inline]]
#else
#define TSPACE_ROWS [[gnu::noinline]]
#endif

namespace tspace::simd::wasm {

inline constexpr std::size_t kWidth = 4;

#pragma clang attribute push(__attribute__((always_inline)), apply_to = function)
#include "core/simd/lanes_arithmetic.h"

inline v128_t wasmOf(Floats a) { return reinterpret_cast<v128_t>(a.v); }
inline v128_t wasmOf(Doubles a) { return reinterpret_cast<v128_t>(a.v); }
inline Floats floatsOf(v128_t v) { return {reinterpret_cast<FloatVector>(v)}; }
inline Doubles doublesOf(v128_t v) { return {reinterpret_cast<DoubleVector>(v)}; }

inline unsigned bitsOf(Mask m) { return static_cast<unsigned>(wasm_i32x4_bitmask(reinterpret_cast<v128_t>(m.v))); }
inline Floats smaller(Floats a, Floats b) { return floatsOf(wasm_f32x4_pmin(wasmOf(b), wasmOf(a))); }
inline Floats larger(Floats a, Floats b) { return floatsOf(wasm_f32x4_pmax(wasmOf(b), wasmOf(a))); }
inline Floats squareRoot(Floats a) { return floatsOf(wasm_f32x4_sqrt(wasmOf(a))); }

inline DoubleMask operator>(Doubles a, Doubles b) { return {a.v > b.v}; }
inline unsigned bitsOf(DoubleMask m) {
    return static_cast<unsigned>(wasm_i64x2_bitmask(reinterpret_cast<v128_t>(m.v)));
}
inline Doubles squareRoot(Doubles a) { return doublesOf(wasm_f64x2_sqrt(wasmOf(a))); }
inline Doubles loadAsDoubles(const float* p) {
    return doublesOf(wasm_f64x2_promote_low_f32x4(wasm_v128_load64_zero(p)));
}
inline void storeAsFloats(float* to, Doubles a) {
    wasm_v128_store64_lane(to, wasm_f32x4_demote_f64x2_zero(wasmOf(a)), 0);
}
inline Doubles part(Floats a, std::size_t which) {
    const v128_t four = wasmOf(a);
    return doublesOf(wasm_f64x2_promote_low_f32x4(which == 0 ? four : wasm_i64x2_shuffle(four, four, 1, 1)));
}
inline Floats join(const Doubles* parts) {
    return floatsOf(wasm_i64x2_shuffle(wasm_f32x4_demote_f64x2_zero(wasmOf(parts[0])),
                                       wasm_f32x4_demote_f64x2_zero(wasmOf(parts[1])), 0, 2));
}
#pragma clang attribute pop

#include "core/simd/lanes_rows.h"

}  // namespace tspace::simd::wasm
