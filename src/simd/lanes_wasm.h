// SPDX-License-Identifier: MIT
// Four lanes: the SIMD of WebAssembly, which every engine has. Nothing of relaxed SIMD: what it computes depends on the
// machine. See lanes_scalar.h for what each function means.
//
// f32x4.min and max give NaN when either number is NaN, so pmin and pmax are used, whose second operand is the one that
// stays.
#pragma once

#include <wasm_simd128.h>

#include <cstddef>
#include <cstdint>

// Programs are compiled for size, and then Clang calls functions of one instruction.
#pragma clang attribute push(__attribute__((always_inline)), apply_to = function)

namespace tspace::simd::wasm {

inline constexpr std::size_t kWidth = 4;

struct Mask {
    v128_t v;
};
inline Mask operator&(Mask a, Mask b) { return {wasm_v128_and(a.v, b.v)}; }
inline Mask operator|(Mask a, Mask b) { return {wasm_v128_or(a.v, b.v)}; }
inline Mask operator!(Mask a) { return {wasm_v128_not(a.v)}; }
inline unsigned bitsOf(Mask m) { return static_cast<unsigned>(wasm_i32x4_bitmask(m.v)); }
inline bool all(Mask m) { return wasm_i32x4_all_true(m.v); }

struct Floats {
    v128_t v;
};
inline Floats broadcast(float x) { return {wasm_f32x4_splat(x)}; }
inline Floats operator+(Floats a, Floats b) { return {wasm_f32x4_add(a.v, b.v)}; }
inline Floats operator-(Floats a, Floats b) { return {wasm_f32x4_sub(a.v, b.v)}; }
inline Floats operator*(Floats a, Floats b) { return {wasm_f32x4_mul(a.v, b.v)}; }
inline Floats operator/(Floats a, Floats b) { return {wasm_f32x4_div(a.v, b.v)}; }
inline Floats smaller(Floats a, Floats b) { return {wasm_f32x4_pmin(b.v, a.v)}; }
inline Floats larger(Floats a, Floats b) { return {wasm_f32x4_pmax(b.v, a.v)}; }
inline Floats squareRoot(Floats a) { return {wasm_f32x4_sqrt(a.v)}; }
inline Floats absolute(Floats a) { return {wasm_f32x4_abs(a.v)}; }
inline Mask operator>(Floats a, Floats b) { return {wasm_f32x4_gt(a.v, b.v)}; }
inline Mask operator<(Floats a, Floats b) { return {wasm_f32x4_lt(a.v, b.v)}; }
inline Mask operator==(Floats a, Floats b) { return {wasm_f32x4_eq(a.v, b.v)}; }
inline Floats select(Mask m, Floats yes, Floats no) { return {wasm_v128_bitselect(yes.v, no.v, m.v)}; }

struct Bits {
    v128_t v;
};
inline v128_t spread(std::uint32_t x) { return wasm_i32x4_splat(static_cast<std::int32_t>(x)); }
inline Bits broadcastBits(std::uint32_t x) { return {spread(x)}; }
inline Bits operator&(Bits a, Bits b) { return {wasm_v128_and(a.v, b.v)}; }
inline Bits operator|(Bits a, Bits b) { return {wasm_v128_or(a.v, b.v)}; }
inline Bits operator^(Bits a, Bits b) { return {wasm_v128_xor(a.v, b.v)}; }
inline Bits operator+(Bits a, Bits b) { return {wasm_i32x4_add(a.v, b.v)}; }
inline Bits operator-(Bits a, Bits b) { return {wasm_i32x4_sub(a.v, b.v)}; }
template <int kBy>
inline Bits shiftLeft(Bits a) {
    return {wasm_i32x4_shl(a.v, kBy)};
}
template <int kBy>
inline Bits shiftRight(Bits a) {
    return {wasm_u32x4_shr(a.v, kBy)};
}
inline Bits smaller(Bits a, Bits b) { return {wasm_u32x4_min(a.v, b.v)}; }
inline Bits product(Bits a, std::uint32_t k) { return {wasm_i32x4_mul(a.v, spread(k))}; }
inline Bits highProduct(Bits a, std::uint32_t k) {
    const v128_t low = wasm_u64x2_extmul_low_u32x4(a.v, spread(k));
    const v128_t high = wasm_u64x2_extmul_high_u32x4(a.v, spread(k));
    return {wasm_i32x4_shuffle(low, high, 1, 3, 5, 7)};
}
inline Floats toFloats(Bits a) { return {wasm_f32x4_convert_i32x4(a.v)}; }
inline Bits orWhere(Bits a, Mask m, std::uint32_t bit) { return {wasm_v128_or(a.v, wasm_v128_and(m.v, spread(bit)))}; }
inline Floats asFloats(Bits b) { return {b.v}; }
inline Bits asBits(Floats f) { return {f.v}; }

/// The upper two lanes in place of the lower ones.
inline v128_t upperHalf(v128_t v) { return wasm_i64x2_shuffle(v, v, 1, 1); }

struct Doubles {
    v128_t v;
};
inline constexpr std::size_t kDoubleParts = 2;
inline Doubles loadAsDoubles(const float* p) { return {wasm_f64x2_promote_low_f32x4(wasm_v128_load64_zero(p))}; }
inline void storeAsFloats(float* to, Doubles a) { wasm_v128_store64_lane(to, wasm_f32x4_demote_f64x2_zero(a.v), 0); }
inline Doubles broadcastDouble(double x) { return {wasm_f64x2_splat(x)}; }
inline Doubles part(Floats a, std::size_t which) {
    return {wasm_f64x2_promote_low_f32x4(which == 0 ? a.v : upperHalf(a.v))};
}
inline Floats join(const Doubles* parts) {
    const v128_t low = wasm_f32x4_demote_f64x2_zero(parts[0].v), high = wasm_f32x4_demote_f64x2_zero(parts[1].v);
    return {wasm_i64x2_shuffle(low, high, 0, 2)};
}
inline Doubles operator+(Doubles a, Doubles b) { return {wasm_f64x2_add(a.v, b.v)}; }
inline Doubles operator-(Doubles a, Doubles b) { return {wasm_f64x2_sub(a.v, b.v)}; }
inline Doubles operator*(Doubles a, Doubles b) { return {wasm_f64x2_mul(a.v, b.v)}; }
inline Doubles operator/(Doubles a, Doubles b) { return {wasm_f64x2_div(a.v, b.v)}; }
inline Doubles smaller(Doubles a, Doubles b) { return {wasm_f64x2_pmin(b.v, a.v)}; }
inline Doubles squareRoot(Doubles a) { return {wasm_f64x2_sqrt(a.v)}; }
inline Doubles absolute(Doubles a) { return {wasm_f64x2_abs(a.v)}; }
struct DoubleMask {
    v128_t v;
};
inline DoubleMask operator>(Doubles a, Doubles b) { return {wasm_f64x2_gt(a.v, b.v)}; }
inline DoubleMask operator&(DoubleMask a, DoubleMask b) { return {wasm_v128_and(a.v, b.v)}; }
inline unsigned bitsOf(DoubleMask m) { return static_cast<unsigned>(wasm_i64x2_bitmask(m.v)); }
inline v128_t signBits() { return wasm_f64x2_splat(-0.0); }
inline Doubles withSignOf(Doubles a, Doubles b) { return {wasm_v128_xor(a.v, wasm_v128_and(b.v, signBits()))}; }
inline Doubles select(DoubleMask m, Doubles yes, Doubles no) { return {wasm_v128_bitselect(yes.v, no.v, m.v)}; }
inline Doubles keepWhere(DoubleMask m, Doubles a) { return {wasm_v128_and(m.v, a.v)}; }
inline Doubles negateUnless(DoubleMask m, Doubles a) { return {wasm_v128_xor(a.v, wasm_v128_andnot(signBits(), m.v))}; }
inline void storeDoubles(double* to, Doubles a) { wasm_v128_store(to, a.v); }
inline void storeDoubleRows(double* rows, Doubles x, Doubles y, Doubles z, Doubles w) {
    wasm_v128_store(rows, wasm_i64x2_shuffle(x.v, y.v, 0, 2));
    wasm_v128_store(rows + 2, wasm_i64x2_shuffle(z.v, w.v, 0, 2));
    wasm_v128_store(rows + 4, wasm_i64x2_shuffle(x.v, y.v, 1, 3));
    wasm_v128_store(rows + 6, wasm_i64x2_shuffle(z.v, w.v, 1, 3));
}
inline void loadDoubleRows(const double* rows, Doubles& x, Doubles& y, Doubles& z, Doubles& w) {
    const v128_t xy[2] = {wasm_v128_load(rows), wasm_v128_load(rows + 4)};
    const v128_t zw[2] = {wasm_v128_load(rows + 2), wasm_v128_load(rows + 6)};
    x = {wasm_i64x2_shuffle(xy[0], xy[1], 0, 2)};
    y = {wasm_i64x2_shuffle(xy[0], xy[1], 1, 3)};
    z = {wasm_i64x2_shuffle(zw[0], zw[1], 0, 2)};
    w = {wasm_i64x2_shuffle(zw[0], zw[1], 1, 3)};
}

struct DoubleRow {
    v128_t low, high;
};
inline DoubleRow loadDoubleRow(const double* p) { return {wasm_v128_load(p), wasm_v128_load(p + 2)}; }
inline void addDoubleRow(double* to, double k, DoubleRow row) {
    const v128_t factor = wasm_f64x2_splat(k);
    wasm_v128_store(to, wasm_f64x2_add(wasm_v128_load(to), wasm_f64x2_mul(factor, row.low)));
    wasm_v128_store(to + 2, wasm_f64x2_add(wasm_v128_load(to + 2), wasm_f64x2_mul(factor, row.high)));
}

/// Three floats. `exact` reads no more; otherwise the four bytes after them are read too.
inline v128_t loadVector(const std::byte* p, bool exact) {
    if (!exact) return wasm_v128_load(p);
    return wasm_v128_load32_lane(p + 8, wasm_v128_load64_zero(p), 2);
}

/// Rows become columns.
inline void transpose(v128_t (&r)[4]) {
    const v128_t ab_low = wasm_i32x4_shuffle(r[0], r[1], 0, 4, 1, 5);
    const v128_t ab_high = wasm_i32x4_shuffle(r[0], r[1], 2, 6, 3, 7);
    const v128_t cd_low = wasm_i32x4_shuffle(r[2], r[3], 0, 4, 1, 5);
    const v128_t cd_high = wasm_i32x4_shuffle(r[2], r[3], 2, 6, 3, 7);
    r[0] = wasm_i64x2_shuffle(ab_low, cd_low, 0, 2);
    r[1] = wasm_i64x2_shuffle(ab_low, cd_low, 1, 3);
    r[2] = wasm_i64x2_shuffle(ab_high, cd_high, 0, 2);
    r[3] = wasm_i64x2_shuffle(ab_high, cd_high, 1, 3);
}

#pragma clang attribute pop

// What moves rows has many long instructions: it is called, but for the kernels that are compiled for speed.
#ifdef TSPACE_FAST_KERNELS
#define TSPACE_ROWS [[gnu::always_inline]]
#else
#define TSPACE_ROWS [[gnu::noinline]]
#endif

TSPACE_ROWS inline void gather3(const std::byte* base, std::size_t stride, const std::uint32_t* index, bool exact,
                                Floats& x, Floats& y, Floats& z) {
    v128_t r[4];
    for (std::size_t i = 0; i < 4; ++i) r[i] = loadVector(base + stride * index[3 * i], exact);
    transpose(r);
    x = {r[0]};
    y = {r[1]};
    z = {r[2]};
}
TSPACE_ROWS inline void gather2(const std::byte* base, std::size_t stride, const std::uint32_t* index, Floats& x,
                                Floats& y) {
    const auto two = [&](std::size_t i) {
        return wasm_v128_load64_lane(base + stride * index[3 * i + 3],
                                     wasm_v128_load64_zero(base + stride * index[3 * i]), 1);
    };
    const v128_t ab = two(0), cd = two(2);
    x = {wasm_i32x4_shuffle(ab, cd, 0, 2, 4, 6)};
    y = {wasm_i32x4_shuffle(ab, cd, 1, 3, 5, 7)};
}
[[gnu::always_inline]] inline void store(float* to, Floats a) { wasm_v128_store(to, a.v); }
[[gnu::always_inline]] inline Floats load(const float* p) { return {wasm_v128_load(p)}; }
[[gnu::always_inline]] inline void store(std::uint32_t* to, Bits b) { wasm_v128_store(to, b.v); }
[[gnu::always_inline]] inline Bits load(const std::uint32_t* p) { return {wasm_v128_load(p)}; }
template <std::size_t kStep = 12>
TSPACE_ROWS inline void storeRows(float* rows, Floats x, Floats y, Floats z, Floats w) {
    v128_t r[4] = {x.v, y.v, z.v, w.v};
    transpose(r);
    for (std::size_t i = 0; i < 4; ++i) wasm_v128_store(rows + kStep * i, r[i]);
}
template <std::size_t kStep>
TSPACE_ROWS inline void storePairs(float* rows, Floats x, Floats y) {
    const v128_t low = wasm_i32x4_shuffle(x.v, y.v, 0, 4, 1, 5), high = wasm_i32x4_shuffle(x.v, y.v, 2, 6, 3, 7);
    wasm_v128_store64_lane(rows, low, 0);
    wasm_v128_store64_lane(rows + kStep, low, 1);
    wasm_v128_store64_lane(rows + 2 * kStep, high, 0);
    wasm_v128_store64_lane(rows + 3 * kStep, high, 1);
}

template <std::size_t kStep>
TSPACE_ROWS inline void loadRows(const float* rows, Floats& x, Floats& y, Floats& z, Floats& w) {
    v128_t r[4];
    for (std::size_t i = 0; i < 4; ++i) r[i] = wasm_v128_load(rows + kStep * i);
    transpose(r);
    x = {r[0]};
    y = {r[1]};
    z = {r[2]};
    w = {r[3]};
}

TSPACE_ROWS inline void loadPairs(const float* pairs, Floats& x, Floats& y) {
    const v128_t ab = wasm_v128_load(pairs), cd = wasm_v128_load(pairs + 4);
    x = {wasm_i32x4_shuffle(ab, cd, 0, 2, 4, 6)};
    y = {wasm_i32x4_shuffle(ab, cd, 1, 3, 5, 7)};
}

#undef TSPACE_ROWS

}  // namespace tspace::simd::wasm
