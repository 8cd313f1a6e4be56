// SPDX-License-Identifier: MIT
// One lane: plain C++ for every CPU without a file of its own here, and the meaning of the other lanes_*.h
// files. They all define the same names, each in a namespace of its own, and every operation is the IEEE one,
// rounded once; so a kernel gives the same bits on all of them.
//
// Rules for code that is compiled for one CPU: it includes nothing but these files and its own kernel,
// because an inline function of a shared header might be emitted with instructions that other CPUs do not
// have, and the linker keeps one copy of it for everybody.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace tspace::simd::scalar {

inline constexpr std::size_t kWidth = 1;

struct Mask {
    bool v;
};
inline Mask operator&(Mask a, Mask b) { return {a.v && b.v}; }
inline Mask operator|(Mask a, Mask b) { return {a.v || b.v}; }
inline Mask operator!(Mask a) { return {!a.v}; }
inline bool all(Mask m) { return m.v; }
/// Bit i: lane i.
inline unsigned bitsOf(Mask m) { return m.v ? 1u : 0u; }

struct Floats {
    float v;
};
inline Floats broadcast(float x) { return {x}; }
inline Floats operator+(Floats a, Floats b) { return {a.v + b.v}; }
inline Floats operator-(Floats a, Floats b) { return {a.v - b.v}; }
inline Floats operator*(Floats a, Floats b) { return {a.v * b.v}; }
inline Floats operator/(Floats a, Floats b) { return {a.v / b.v}; }
/// The second one when either is NaN.
inline Floats smaller(Floats a, Floats b) { return a.v < b.v ? a : b; }
inline Floats larger(Floats a, Floats b) { return a.v > b.v ? a : b; }
inline Floats squareRoot(Floats a) { return {std::sqrt(a.v)}; }
inline Floats absolute(Floats a) { return {std::fabs(a.v)}; }
/// Comparisons with NaN are false.
inline Mask operator>(Floats a, Floats b) { return {a.v > b.v}; }
inline Mask operator<(Floats a, Floats b) { return {a.v < b.v}; }
inline Mask operator==(Floats a, Floats b) { return {a.v == b.v}; }
inline Floats select(Mask m, Floats yes, Floats no) { return m.v ? yes : no; }

/// Whole numbers, for flags and words.
struct Bits {
    std::uint32_t v;
};
inline Bits broadcastBits(std::uint32_t x) { return {x}; }
inline Bits operator&(Bits a, Bits b) { return {a.v & b.v}; }
inline Bits operator|(Bits a, Bits b) { return {a.v | b.v}; }
inline Bits operator^(Bits a, Bits b) { return {a.v ^ b.v}; }
inline Bits operator+(Bits a, Bits b) { return {a.v + b.v}; }
inline Bits operator-(Bits a, Bits b) { return {a.v - b.v}; }
template <int kBy>
inline Bits shiftLeft(Bits a) {
    return {a.v << kBy};
}
template <int kBy>
inline Bits shiftRight(Bits a) {
    return {a.v >> kBy};
}
/// Of numbers below 2^31.
inline Bits smaller(Bits a, Bits b) { return {a.v < b.v ? a.v : b.v}; }
/// The lower and the upper half of the product.
inline Bits product(Bits a, std::uint32_t k) { return {a.v * k}; }
inline Bits highProduct(Bits a, std::uint32_t k) { return {static_cast<std::uint32_t>(std::uint64_t{a.v} * k >> 32)}; }
/// Numbers below 2^31, rounded to the nearest float.
inline Floats toFloats(Bits a) { return {static_cast<float>(static_cast<std::int32_t>(a.v))}; }
/// a | bit where the mask is set, else a.
inline Bits orWhere(Bits a, Mask m, std::uint32_t bit) { return {m.v ? a.v | bit : a.v}; }
inline Floats asFloats(Bits b) {
    Floats f;
    std::memcpy(&f.v, &b.v, 4);
    return f;
}
inline Bits asBits(Floats f) {
    Bits b;
    std::memcpy(&b.v, &f.v, 4);
    return b;
}

/// Half of the lanes as doubles.
struct Doubles {
    double v;
};
inline constexpr std::size_t kDoubleParts = 1;
/// Between floats in memory and doubles. All addresses here and below are multiples of the vector's size.
inline Doubles loadAsDoubles(const float* p) { return {*p}; }
inline void storeAsFloats(float* to, Doubles a) { *to = static_cast<float>(a.v); }
inline Doubles broadcastDouble(double x) { return {x}; }
inline Doubles part(Floats a, std::size_t) { return {a.v}; }
inline Floats join(const Doubles* parts) { return {static_cast<float>(parts[0].v)}; }
inline Doubles operator+(Doubles a, Doubles b) { return {a.v + b.v}; }
inline Doubles operator-(Doubles a, Doubles b) { return {a.v - b.v}; }
inline Doubles operator*(Doubles a, Doubles b) { return {a.v * b.v}; }
inline Doubles operator/(Doubles a, Doubles b) { return {a.v / b.v}; }
inline Doubles smaller(Doubles a, Doubles b) { return a.v < b.v ? a : b; }
inline Doubles squareRoot(Doubles a) { return {std::sqrt(a.v)}; }
inline Doubles absolute(Doubles a) { return {std::fabs(a.v)}; }
struct DoubleMask {
    bool v;
};
/// a with the sign of b turned over where b is negative (-0 counts), else a.
inline Doubles withSignOf(Doubles a, Doubles b) { return {std::signbit(b.v) ? -a.v : a.v}; }
inline Doubles select(DoubleMask m, Doubles yes, Doubles no) { return m.v ? yes : no; }
/// a where the mask is set, else +0.
inline Doubles keepWhere(DoubleMask m, Doubles a) { return {m.v ? a.v : 0.0}; }
/// a where the mask is set, else -a.
inline Doubles negateUnless(DoubleMask m, Doubles a) { return {m.v ? a.v : -a.v}; }
inline DoubleMask operator>(Doubles a, Doubles b) { return {a.v > b.v}; }
inline DoubleMask operator&(DoubleMask a, DoubleMask b) { return {a.v && b.v}; }
inline unsigned bitsOf(DoubleMask m) { return m.v ? 1u : 0u; }
inline void storeDoubles(double* to, Doubles a) { *to = a.v; }
/// Writes lane i's four values to row i of an array of rows of four doubles.
inline void storeDoubleRows(double* rows, Doubles x, Doubles y, Doubles z, Doubles w) {
    rows[0] = x.v;
    rows[1] = y.v;
    rows[2] = z.v;
    rows[3] = w.v;
}

/// The opposite of storeDoubleRows.
inline void loadDoubleRows(const double* rows, Doubles& x, Doubles& y, Doubles& z, Doubles& w) {
    x = {rows[0]};
    y = {rows[1]};
    z = {rows[2]};
    w = {rows[3]};
}

/// Four doubles, whatever the number of lanes.
struct DoubleRow {
    double v[4];
};
inline DoubleRow loadDoubleRow(const double* p) { return {{p[0], p[1], p[2], p[3]}}; }
/// to[0 .. 4) += k * row
inline void addDoubleRow(double* to, double k, DoubleRow row) {
    for (std::size_t i = 0; i < 4; ++i) to[i] += k * row.v[i];
}

/// Reads the elements numbered index[0], index[3], index[6], ... (one corner of consecutive triangles) of an
/// array of vectors. `exact` reads their 12 bytes and no more; otherwise the 4 bytes after them are read too.
inline void gather3(const std::byte* base, std::size_t stride, const std::uint32_t* index, bool, Floats& x, Floats& y,
                    Floats& z) {
    float v[3];
    std::memcpy(v, base + stride * index[0], 12);
    x = {v[0]};
    y = {v[1]};
    z = {v[2]};
}
inline void gather2(const std::byte* base, std::size_t stride, const std::uint32_t* index, Floats& x, Floats& y) {
    float v[2];
    std::memcpy(v, base + stride * index[0], 8);
    x = {v[0]};
    y = {v[1]};
}
inline void store(float* to, Floats a) { *to = a.v; }
inline Floats load(const float* p) { return {*p}; }
inline void store(std::uint32_t* to, Bits b) { *to = b.v; }
inline Bits load(const std::uint32_t* p) { return {*p}; }
/// Writes lane i's four values to rows[kStep * i ...], by default row 3 * i of an array of rows of four floats. At any
/// address that floats may have. Rows are written one after the other: with a step of 3, all but the last row hold three
/// values, and one more is written after them.
template <std::size_t kStep = 12>
inline void storeRows(float* rows, Floats x, Floats y, Floats z, Floats w) {
    const float v[4] = {x.v, y.v, z.v, w.v};
    std::memcpy(rows, v, sizeof v);  // the rows may have been other numbers before
}
/// The same for two values.
template <std::size_t kStep>
inline void storePairs(float* rows, Floats x, Floats y) {
    rows[0] = x.v;
    rows[1] = y.v;
}

/// The opposite of storeRows.
template <std::size_t kStep>
inline void loadRows(const float* rows, Floats& x, Floats& y, Floats& z, Floats& w) {
    x = {rows[0]};
    y = {rows[1]};
    z = {rows[2]};
    w = {rows[3]};
}

/// Reads kWidth pairs of floats that lie side by side.
inline void loadPairs(const float* pairs, Floats& x, Floats& y) {
    x = {pairs[0]};
    y = {pairs[1]};
}

}  // namespace tspace::simd::scalar
