// SPDX-License-Identifier: MIT
// What compilers make of their own vector types as well as intrinsics say it: arithmetic and bits. Included inside the
// namespace of each lanes_*.h of more than one lane, behind its kWidth, so that each CPU has functions of its own: see
// the rules in lanes_scalar.h. Without a guard, for the same reason.

using FloatVector = float __attribute__((vector_size(4 * kWidth)));
using WordVector = std::uint32_t __attribute__((vector_size(4 * kWidth)));
using WholeVector = decltype(FloatVector{} < FloatVector{});
using DoubleVector = double __attribute__((vector_size(4 * kWidth)));  // half of the lanes
using LongVector = decltype(DoubleVector{} < DoubleVector{});
using FloatsInMemory = float __attribute__((vector_size(4 * kWidth), may_alias));
using WordsInMemory = std::uint32_t __attribute__((vector_size(4 * kWidth), may_alias));
using DoublesInMemory = double __attribute__((vector_size(4 * kWidth), may_alias));

struct Floats {
    FloatVector v;
};
inline Floats broadcast(float x) { return {x - FloatVector{}}; }
inline Floats operator+(Floats a, Floats b) { return {a.v + b.v}; }
inline Floats operator-(Floats a, Floats b) { return {a.v - b.v}; }
inline Floats operator*(Floats a, Floats b) { return {a.v * b.v}; }
inline Floats operator/(Floats a, Floats b) { return {a.v / b.v}; }
inline void store(float* to, Floats a) { *reinterpret_cast<FloatsInMemory*>(to) = a.v; }
inline Floats load(const float* p) { return {*reinterpret_cast<const FloatsInMemory*>(p)}; }

/// Whole numbers, for flags and words.
struct Bits {
    WordVector v;
};
inline Bits broadcastBits(std::uint32_t x) { return {x + WordVector{}}; }
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
/// The lower half of the product.
inline Bits product(Bits a, std::uint32_t k) { return {a.v * k}; }
/// Numbers below 2^31, rounded to the nearest float.
inline Floats toFloats(Bits a) { return {__builtin_convertvector(reinterpret_cast<WholeVector>(a.v), FloatVector)}; }
inline Floats asFloats(Bits b) { return {reinterpret_cast<FloatVector>(b.v)}; }
inline Bits asBits(Floats f) { return {reinterpret_cast<WordVector>(f.v)}; }
inline Floats absolute(Floats a) { return asFloats({asBits(a).v & 0x7fffffffu}); }
inline void store(std::uint32_t* to, Bits b) { *reinterpret_cast<WordsInMemory*>(to) = b.v; }
inline Bits load(const std::uint32_t* p) { return {*reinterpret_cast<const WordsInMemory*>(p)}; }

/// Half of the lanes as doubles.
struct Doubles {
    DoubleVector v;
};
inline constexpr std::size_t kDoubleParts = 2;
inline constexpr auto kSignBit = static_cast<long long>(1ull << 63);
inline LongVector longsOf(Doubles a) { return reinterpret_cast<LongVector>(a.v); }
inline Doubles doublesOf(LongVector v) { return {reinterpret_cast<DoubleVector>(v)}; }
inline Doubles broadcastDouble(double x) { return {x - DoubleVector{}}; }
inline Doubles operator+(Doubles a, Doubles b) { return {a.v + b.v}; }
inline Doubles operator-(Doubles a, Doubles b) { return {a.v - b.v}; }
inline Doubles operator*(Doubles a, Doubles b) { return {a.v * b.v}; }
inline Doubles operator/(Doubles a, Doubles b) { return {a.v / b.v}; }
inline Doubles absolute(Doubles a) { return doublesOf(longsOf(a) & ~kSignBit); }
/// a with its sign turned over where b is negative (-0 counts), else a.
inline Doubles withSignOf(Doubles a, Doubles b) { return doublesOf(longsOf(a) ^ (longsOf(b) & kSignBit)); }
inline void storeDoubles(double* to, Doubles a) { *reinterpret_cast<DoublesInMemory*>(to) = a.v; }
