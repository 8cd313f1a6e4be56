// SPDX-License-Identifier: MIT
// Four lanes without SIMD instructions: plain C++ and vector types, which compilers split if a CPU has no vectors. For
// CPUs without their own lanes_*.h. All lanes_*.h define the same names, each in its own namespace, and every operation
// is the IEEE operation, rounded once; so a kernel has the same bits on all of them. This file and the files it
// includes document each function.
#pragma once

#include <cmath>

#include "core/simd/lanes.h"

namespace tspace::simd::scalar {

inline constexpr std::size_t kWidth = 4;

#include "core/simd/lanes_arithmetic.h"
#include "core/simd/lanes_rows.h"

inline unsigned bitsOf(Mask m) {
    unsigned bits = 0;
    for (std::size_t i = 0; i < kWidth; ++i) bits |= m.v[i] != 0 ? 1u << i : 0;
    return bits;
}
/// Return the second operand if either is NaN.
inline Floats smaller(Floats a, Floats b) { return {a.v < b.v ? a.v : b.v}; }
inline Floats larger(Floats a, Floats b) { return {a.v > b.v ? a.v : b.v}; }
inline Floats squareRoot(Floats a) {
    for (std::size_t i = 0; i < kWidth; ++i) a.v[i] = std::sqrt(a.v[i]);
    return a;
}

/// Comparisons with NaN are false.
inline DoubleMask operator>(Doubles a, Doubles b) { return {a.v > b.v}; }
inline unsigned bitsOf(DoubleMask m) { return (m.v[0] != 0 ? 1u : 0u) | (m.v[1] != 0 ? 2u : 0u); }
inline Doubles squareRoot(Doubles a) { return {DoubleVector{std::sqrt(a.v[0]), std::sqrt(a.v[1])}}; }
/// Convert between floats in memory and doubles, for half of the lanes. All addresses are aligned to the size of the
/// vector.
inline Doubles loadAsDoubles(const float* p) { return {DoubleVector{p[0], p[1]}}; }
inline void storeAsFloats(float* to, Doubles a) {
    for (std::size_t i = 0; i < 2; ++i) to[i] = static_cast<float>(a.v[i]);
}
inline Doubles part(Floats a, std::size_t which) { return {DoubleVector{a.v[2 * which], a.v[2 * which + 1]}}; }
inline Floats join(const Doubles* parts) {
    Floats joined;
    for (std::size_t i = 0; i < kWidth; ++i) joined.v[i] = static_cast<float>(parts[i / 2].v[i % 2]);
    return joined;
}

}  // namespace tspace::simd::scalar
