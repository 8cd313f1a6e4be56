// SPDX-License-Identifier: MIT
// Arithmetic, bits and masks in the compiler's vector types, which compile to code as good as intrinsics. Included
// inside the namespace of each lanes_*.h with more than one lane, after its kWidth, so that each instruction set has
// its own functions: see the rules in lanes.h. It therefore has no include guard.

using FloatVector = float __attribute__((vector_size(4 * kWidth)));
using WordVector = std::uint32_t __attribute__((vector_size(4 * kWidth)));
using WholeVector = decltype(FloatVector{} < FloatVector{});
using DoubleVector = double __attribute__((vector_size(4 * kWidth)));  // doubles for half of the lanes
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

/// Integer lanes, for flags and words.
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
/// Returns the minimum. Operands must be below 2^31.
inline Bits smaller(Bits a, Bits b) {
    return {reinterpret_cast<WholeVector>(a.v) < reinterpret_cast<WholeVector>(b.v) ? a.v : b.v};
}
/// Returns the lower half of the product of each lane.
inline Bits product(Bits a, std::uint32_t k) { return {a.v * k}; }
/// Divides numbers below 2^31 by a constant. Compilers multiply instead; for even numbers the factor fits into 32 bits.
template <std::uint32_t kBy>
inline Bits quotient(Bits a) {
    return {(a.v << 1) / (2 * kBy)};
}
/// Converts numbers below 2^31 to the nearest float.
inline Floats toFloats(Bits a) { return {__builtin_convertvector(reinterpret_cast<WholeVector>(a.v), FloatVector)}; }
inline Floats asFloats(Bits b) { return {reinterpret_cast<FloatVector>(b.v)}; }
inline Bits asBits(Floats f) { return {reinterpret_cast<WordVector>(f.v)}; }
inline Floats absolute(Floats a) { return asFloats({asBits(a).v & 0x7fffffffu}); }
inline void store(std::uint32_t* to, Bits b) { *reinterpret_cast<WordsInMemory*>(to) = b.v; }
inline Bits load(const std::uint32_t* p) { return {*reinterpret_cast<const WordsInMemory*>(p)}; }

/// Result of a comparison: in each lane, all bits are set or none. Compilers keep it in mask registers if available.
struct Mask {
    WholeVector v;
};
inline Mask operator&(Mask a, Mask b) { return {a.v & b.v}; }
inline Mask operator|(Mask a, Mask b) { return {a.v | b.v}; }
inline Mask operator!(Mask a) { return {~a.v}; }
/// Comparisons with NaN are false.
inline Mask operator>(Floats a, Floats b) { return {a.v > b.v}; }
inline Mask operator<(Floats a, Floats b) { return {a.v < b.v}; }
inline Mask operator==(Floats a, Floats b) { return {a.v == b.v}; }
/// Returns the lanes as bits: bit i is lane i.
inline unsigned bitsOf(Mask m);
inline bool all(Mask m) { return bitsOf(m) == (1u << kWidth) - 1; }
inline Floats select(Mask m, Floats yes, Floats no) { return {m.v ? yes.v : no.v}; }
/// Returns a | bit where the mask is set, otherwise a.
inline Bits orWhere(Bits a, Mask m, std::uint32_t bit) { return {a.v | (reinterpret_cast<WordVector>(m.v) & bit)}; }
inline Bits keepWhere(Bits a, Mask m) { return {a.v & reinterpret_cast<WordVector>(m.v)}; }
/// Returns a shifted left by one, with the mask as its lowest bit.
inline Bits appendBit(Bits a, Mask m) { return {a.v + a.v - reinterpret_cast<WordVector>(m.v)}; }

/// Half of the lanes, as doubles.
struct Doubles {
    DoubleVector v;
};
inline constexpr std::size_t kDoubleParts = 2;
inline constexpr auto kSignBit = static_cast<long long>(1ull << 63);
inline LongVector longsOf(Doubles a) { return reinterpret_cast<LongVector>(a.v); }
inline Doubles doublesOf(LongVector v) { return {reinterpret_cast<DoubleVector>(v)}; }
inline FloatVector pairsOf(Doubles a) { return reinterpret_cast<FloatVector>(a.v); }
inline Doubles broadcastDouble(double x) { return {x - DoubleVector{}}; }
inline Doubles operator+(Doubles a, Doubles b) { return {a.v + b.v}; }
inline Doubles operator-(Doubles a, Doubles b) { return {a.v - b.v}; }
inline Doubles operator*(Doubles a, Doubles b) { return {a.v * b.v}; }
inline Doubles operator/(Doubles a, Doubles b) { return {a.v / b.v}; }
inline Doubles smaller(Doubles a, Doubles b) { return {a.v < b.v ? a.v : b.v}; }
inline Doubles absolute(Doubles a) { return doublesOf(longsOf(a) & ~kSignBit); }
/// Returns a, with inverted sign where b is negative (including -0).
inline Doubles withSignOf(Doubles a, Doubles b) { return doublesOf(longsOf(a) ^ (longsOf(b) & kSignBit)); }
inline void storeDoubles(double* to, Doubles a) { *reinterpret_cast<DoublesInMemory*>(to) = a.v; }
struct DoubleMask {
    LongVector v;
};
inline DoubleMask operator&(DoubleMask a, DoubleMask b) { return {a.v & b.v}; }
inline Doubles select(DoubleMask m, Doubles yes, Doubles no) { return {m.v ? yes.v : no.v}; }
/// Returns a where the mask is set, otherwise +0.
inline Doubles keepWhere(DoubleMask m, Doubles a) { return doublesOf(m.v & longsOf(a)); }
/// Returns a where the mask is set, otherwise -a.
inline Doubles negateUnless(DoubleMask m, Doubles a) { return doublesOf(longsOf(a) ^ (~m.v & kSignBit)); }

// Four floats at any address, independent of the number of lanes.

using Quad = float __attribute__((vector_size(16)));
using TwoDoubles = double __attribute__((vector_size(16)));
// Clang ignores `aligned` after the equals sign.
using QuadInMemory __attribute__((aligned(4), may_alias)) = Quad;
using AlignedQuad = float __attribute__((vector_size(16), may_alias));
inline Quad loadQuad(const void* p) { return *static_cast<const QuadInMemory*>(p); }
inline void storeQuad(void* to, Quad quad) { *static_cast<QuadInMemory*>(to) = quad; }

/// Loads two floats as one double.
inline double loadTwo(const void* p) {
    double d;
    std::memcpy(&d, p, sizeof d);
    return d;
}
inline void storeTwo(void* to, double two) { std::memcpy(to, &two, sizeof two); }
inline Quad twoPairs(const void* a, const void* b) {
    return reinterpret_cast<Quad>(TwoDoubles{loadTwo(a), loadTwo(b)});
}
/// Loads three floats. With `exact`, reads no other memory; otherwise also reads the following four bytes.
inline Quad loadVector(const std::byte* p, bool exact) {
    if (!exact) return loadQuad(p);
    float z;
    std::memcpy(&z, p + 8, sizeof z);
    return __builtin_shufflevector(reinterpret_cast<Quad>(TwoDoubles{loadTwo(p), 0}), Quad{z, 0, 0, 0}, 0, 1, 4, 5);
}

/// Four doubles, independent of the number of lanes.
struct DoubleRow {
    double __attribute__((vector_size(32))) v;
};
using DoubleRowInMemory __attribute__((aligned(16), may_alias)) = decltype(DoubleRow::v);
inline DoubleRow loadDoubleRow(const double* p) { return {*reinterpret_cast<const DoubleRowInMemory*>(p)}; }
/// Performs to[0 .. 4) += k * row.
inline void addDoubleRow(double* to, double k, const DoubleRow& row) {
    *reinterpret_cast<DoubleRowInMemory*>(to) += k * row.v;
}

// Indices of the quads of a vector: it consists of 1, 2 or 4 quads.

inline constexpr std::make_index_sequence<kWidth / 4> kQuads;
template <std::size_t kWhich>
inline Quad quad(FloatVector v) {
    return reinterpret_cast<const AlignedQuad*>(&v)[kWhich];
}
inline Quad joinQuads(Quad a) { return a; }

/// Shuffles within each quad: kFrom and kLane select from the quad of x (0 to 3) and the quad of y (4 to 7).
template <std::size_t... kFrom, std::size_t... kLane>
inline FloatVector inFours(FloatVector x, FloatVector y, std::index_sequence<kFrom...>, std::index_sequence<kLane...>) {
    constexpr std::size_t kPlaces[] = {(kFrom < 4 ? kFrom : kFrom - 4 + kWidth)...};
    return __builtin_shufflevector(x, y, (kPlaces[kLane % 4] + kLane / 4 * 4)...);
}
template <std::size_t... kFrom>
inline FloatVector inFours(FloatVector x, FloatVector y) {
    return inFours(x, y, std::index_sequence<kFrom...>{}, std::make_index_sequence<kWidth>{});
}
