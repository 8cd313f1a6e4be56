// SPDX-License-Identifier: MIT
// Four floats at a time, by the vector types of GCC and Clang: SSE2 on x86-64, NEON on 64-bit ARM, other
// units or scalar code elsewhere. Every lane rounds as the scalar operation does, so the bits are the same
// everywhere.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__aarch64__) && defined(__ARM_NEON)
#include <arm_neon.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

#include "tspace/vec.h"

namespace tspace {

using Float4 = float __attribute__((vector_size(16)));
using Mask4 = std::int32_t __attribute__((vector_size(16)));  ///< per lane all bits or none, from a comparison
using Double2 = double __attribute__((vector_size(16)));      ///< here a carrier of two pairs of floats

// Float4 at any multiple of 4 bytes, aliasing any type. Clang ignores `aligned` after the equals sign.
using Float4InMemory __attribute__((aligned(4), may_alias)) = Float4;

inline Float4 splat(float f) { return Float4{f, f, f, f}; }
inline Float4 abs4(Float4 v) { return std::bit_cast<Float4>(std::bit_cast<Mask4>(v) & 0x7fffffff); }
inline Float4 or4(Float4 a, Float4 b) {
    return std::bit_cast<Float4>(std::bit_cast<Mask4>(a) | std::bit_cast<Mask4>(b));
}

/// Bit i is set when lane i is true (its highest bit, that is).
inline unsigned laneBits(Mask4 mask) {
#if defined(__SSE2__)
    return static_cast<unsigned>(_mm_movemask_ps(std::bit_cast<__m128>(mask)));
#elif defined(__aarch64__) && defined(__ARM_NEON)
    constexpr Mask4 kBits = {1, 2, 4, 8};
    return vaddvq_u32(std::bit_cast<uint32x4_t>((mask >> 31) & kBits));
#elif defined(__wasm_simd128__)
    return static_cast<unsigned>(wasm_i32x4_bitmask(std::bit_cast<v128_t>(mask)));
#else
    unsigned bits = 0;
    for (unsigned i = 0; i < 4; ++i) bits |= mask[i] < 0 ? 1u << i : 0;
    return bits;
#endif
}

/// Per lane a where the mask is set, else b.
inline Float4 select4(Mask4 mask, Float4 a, Float4 b) {
    return std::bit_cast<Float4>((mask & std::bit_cast<Mask4>(a)) | (~mask & std::bit_cast<Mask4>(b)));
}
inline Float4 min4(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 max4(Float4 a, Float4 b) { return a > b ? a : b; }

inline Float4 sqrt4(Float4 v) {
#ifdef __SSE2__
    return std::bit_cast<Float4>(_mm_sqrt_ps(std::bit_cast<__m128>(v)));
#else
    return Float4{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
#endif
}

inline Float4 loadFloat4(const float* p) { return *reinterpret_cast<const Float4InMemory*>(p); }
inline void storeFloat4(float* p, Float4 v) { *reinterpret_cast<Float4InMemory*>(p) = v; }

/// Two floats in the lower half, zero in the upper one; and back.
inline double pairBits(const float* p) {
    double bits;
    std::memcpy(&bits, p, sizeof bits);
    return bits;
}
inline Float4 loadPair(const float* p) { return std::bit_cast<Float4>(Double2{pairBits(p), 0.0}); }
inline void storePair(float* p, Float4 v) {
    const double bits = std::bit_cast<Double2>(v)[0];
    std::memcpy(p, &bits, sizeof bits);
}
inline Float4 joinPairs(const float* low, const float* high) {
    return std::bit_cast<Float4>(Double2{pairBits(low), pairBits(high)});
}

/// The first three lanes.
inline void storeVec3(Vec3& to, Float4 v) {
    storePair(&to.x, v);
    to.z = v[2];
}

/// One array per component, four vectors.
struct Vec3x4 {
    Float4 x, y, z;
};

inline Vec3x4 operator+(const Vec3x4& a, const Vec3x4& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3x4 operator-(const Vec3x4& a, const Vec3x4& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3x4 operator*(Float4 k, const Vec3x4& v) { return {k * v.x, k * v.y, k * v.z}; }
inline Float4 dot(const Vec3x4& a, const Vec3x4& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3x4 cross(const Vec3x4& a, const Vec3x4& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Rows become columns.
inline void transpose4(Float4& a, Float4& b, Float4& c, Float4& d) {
    const Float4 ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5);
    const Float4 ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Float4 cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    const Float4 cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
    b = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
    c = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
    d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

/// From four vectors in memory. Two loads for each, which stay inside its 12 bytes: x y and y z.
inline Vec3x4 gatherVec3(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    Float4 x = joinPairs(&a.x, &a.y), y = joinPairs(&b.x, &b.y), y_again = joinPairs(&c.x, &c.y),
           z = joinPairs(&d.x, &d.y);
    transpose4(x, y, y_again, z);
    return {x, y, z};
}

// The additions that all sums are made of.

/// to[0..3] += row[0..3]; both aligned to 16 bytes.
inline void addRow(float* to, const float* row) {
    using Row __attribute__((may_alias)) = Float4;
    *reinterpret_cast<Row*>(to) += *reinterpret_cast<const Row*>(row);
}

/// to[0..2] += row[0..2], where `row` has four numbers.
inline void addVector(float* to, const float* row) {
    const Float4 sum = __builtin_shufflevector(loadPair(to), Float4{to[2], 0, 0, 0}, 0, 1, 4, 5) + loadFloat4(row);
    storePair(to, sum);
    to[2] = sum[2];
}

}  // namespace tspace
