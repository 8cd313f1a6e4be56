// SPDX-License-Identifier: MIT
// Four lanes. Included as lanes_arithmetic.h, behind lanes_masks.h.

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

// Clang overlooks `aligned` behind the equals sign.
using RowInMemory __attribute__((aligned(4), may_alias)) = FloatVector;
inline FloatVector loadRow(const void* p) { return *static_cast<const RowInMemory*>(p); }
inline void storeRow(void* to, FloatVector row) { *static_cast<RowInMemory*>(to) = row; }

/// Two floats as one double.
inline double loadTwo(const void* p) {
    double d;
    std::memcpy(&d, p, sizeof d);
    return d;
}
inline void storeTwo(void* to, double two) { std::memcpy(to, &two, sizeof two); }
/// Three floats. `exact` reads no more; otherwise the four bytes after them are read too.
inline FloatVector loadVector(const std::byte* p, bool exact) {
    if (!exact) return loadRow(p);
    float z;
    std::memcpy(&z, p + 8, sizeof z);
    const FloatVector xy = reinterpret_cast<FloatVector>(DoubleVector{loadTwo(p), 0}), zz = {z, 0, 0, 0};
    return __builtin_shufflevector(xy, zz, 0, 1, 4, 5);
}

/// Rows become columns.
inline void transpose(FloatVector (&r)[4]) {
    const FloatVector ab_low = __builtin_shufflevector(r[0], r[1], 0, 4, 1, 5);
    const FloatVector ab_high = __builtin_shufflevector(r[0], r[1], 2, 6, 3, 7);
    const FloatVector cd_low = __builtin_shufflevector(r[2], r[3], 0, 4, 1, 5);
    const FloatVector cd_high = __builtin_shufflevector(r[2], r[3], 2, 6, 3, 7);
    r[0] = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
    r[1] = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
    r[2] = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
    r[3] = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

inline void splitPairs(FloatVector ab, FloatVector cd, Floats& x, Floats& y) {
    x = {__builtin_shufflevector(ab, cd, 0, 2, 4, 6)};
    y = {__builtin_shufflevector(ab, cd, 1, 3, 5, 7)};
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
