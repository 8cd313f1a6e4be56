// SPDX-License-Identifier: MIT
// Masks that are vectors: of every CPU but those with registers for masks. Included as lanes_arithmetic.h, behind it.

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
/// a | bit where the mask is set, else a.
inline Bits orWhere(Bits a, Mask m, std::uint32_t bit) { return {a.v | (reinterpret_cast<WordVector>(m.v) & bit)}; }

struct DoubleMask {
    LongVector v;
};
inline DoubleMask operator&(DoubleMask a, DoubleMask b) { return {a.v & b.v}; }
/// a where the mask is set, else +0.
inline Doubles keepWhere(DoubleMask m, Doubles a) { return doublesOf(m.v & longsOf(a)); }
/// a where the mask is set, else -a.
inline Doubles negateUnless(DoubleMask m, Doubles a) { return doublesOf(longsOf(a) ^ (~m.v & kSignBit)); }
