// SPDX-License-Identifier: MIT
// Four lanes. Included as lanes_arithmetic.h, behind lanes_masks.h and lanes_loads.h.

inline Floats select(Mask m, Floats yes, Floats no) {
    return {reinterpret_cast<FloatVector>((m.v & reinterpret_cast<WholeVector>(yes.v)) |
                                          (~m.v & reinterpret_cast<WholeVector>(no.v)))};
}
inline Doubles select(DoubleMask m, Doubles yes, Doubles no) {
    return doublesOf((m.v & longsOf(yes)) | (~m.v & longsOf(no)));
}
/// Of numbers below 2^31.
inline Bits smaller(Bits a, Bits b) {
    const Mask m{reinterpret_cast<WholeVector>(a.v) < reinterpret_cast<WholeVector>(b.v)};
    return asBits(select(m, asFloats(a), asFloats(b)));
}

/// Of each quad of x (0 to 3) and the same of y (4 to 7) four floats.
template <int kA, int kB, int kC, int kD>
inline FloatVector inFours(FloatVector x, FloatVector y) {
    return __builtin_shufflevector(x, y, kA, kB, kC, kD);
}
inline constexpr Quads<0> kQuads;
inline FloatVector joinQuads(Quad a) { return a; }
template <std::size_t>
inline Quad quad(FloatVector v) {
    return v;
}

/// Writes lane i's four values to row i of an array of rows of four doubles.
inline void storeDoubleRows(double* rows, Doubles x, Doubles y, Doubles z, Doubles w) {
    storeDoubles(rows, {__builtin_shufflevector(x.v, y.v, 0, 2)});
    storeDoubles(rows + 2, {__builtin_shufflevector(z.v, w.v, 0, 2)});
    storeDoubles(rows + 4, {__builtin_shufflevector(x.v, y.v, 1, 3)});
    storeDoubles(rows + 6, {__builtin_shufflevector(z.v, w.v, 1, 3)});
}
inline DoubleVector loadTwoDoubles(const double* p) { return *reinterpret_cast<const DoublesInMemory*>(p); }
/// The opposite of storeDoubleRows.
inline void loadDoubleRows(const double* rows, Doubles& x, Doubles& y, Doubles& z, Doubles& w) {
    x = {__builtin_shufflevector(loadTwoDoubles(rows), loadTwoDoubles(rows + 4), 0, 2)};
    y = {__builtin_shufflevector(loadTwoDoubles(rows), loadTwoDoubles(rows + 4), 1, 3)};
    z = {__builtin_shufflevector(loadTwoDoubles(rows + 2), loadTwoDoubles(rows + 6), 0, 2)};
    w = {__builtin_shufflevector(loadTwoDoubles(rows + 2), loadTwoDoubles(rows + 6), 1, 3)};
}

/// Four doubles, whatever the number of lanes.
struct DoubleRow {
    DoubleVector low, high;
};
inline DoubleRow loadDoubleRow(const double* p) { return {loadTwoDoubles(p), loadTwoDoubles(p + 2)}; }
/// to[0 .. 4) += k * row
inline void addDoubleRow(double* to, double k, DoubleRow row) {
    const DoubleVector low = k * row.low, high = k * row.high;
    storeDoubles(to, {loadTwoDoubles(to) + low});
    storeDoubles(to + 2, {loadTwoDoubles(to + 2) + high});
}
