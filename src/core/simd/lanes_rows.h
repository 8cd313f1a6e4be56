// SPDX-License-Identifier: MIT
// Conversion between rows of four numbers and lanes. Included like lanes_arithmetic.h, after all definitions except
// operators. TSPACE_ROWS: attributes of these functions. Quad q contains the rows from 4 * q on.

#ifndef TSPACE_ROWS
#define TSPACE_ROWS
#endif

/// Returns a vector that consists of the quads at(i), at(4 + i), ...: row i of each quad.
template <class At, std::size_t... kQuad>
inline FloatVector quadsAt(const At& at, std::size_t i, std::index_sequence<kQuad...>) {
    return joinQuads(at(4 * kQuad + i)...);
}
inline FloatVector lowPairs(FloatVector a, FloatVector b) { return inFours<0, 1, 4, 5>(a, b); }
inline FloatVector highPairs(FloatVector a, FloatVector b) { return inFours<2, 3, 6, 7>(a, b); }
inline FloatVector mixLow(FloatVector a, FloatVector b) { return inFours<0, 4, 1, 5>(a, b); }
inline FloatVector mixHigh(FloatVector a, FloatVector b) { return inFours<2, 6, 3, 7>(a, b); }

/// Transposes the 4 x 4 matrix in each quad.
inline void transpose(FloatVector (&r)[4]) {
    const FloatVector ab_low = mixLow(r[0], r[1]), ab_high = mixHigh(r[0], r[1]);
    const FloatVector cd_low = mixLow(r[2], r[3]), cd_high = mixHigh(r[2], r[3]);
    r[0] = lowPairs(ab_low, cd_low);
    r[1] = highPairs(ab_low, cd_low);
    r[2] = lowPairs(ab_high, cd_high);
    r[3] = highPairs(ab_high, cd_high);
}
/// Returns the columns of the rows at(0), at(1), ...
template <class At>
inline void columnsAt(const At& at, Floats& x, Floats& y, Floats& z, Floats& w) {
    FloatVector r[4];
    for (std::size_t i = 0; i < 4; ++i) r[i] = quadsAt(at, i, kQuads);
    transpose(r);
    x = {r[0]};
    y = {r[1]};
    z = {r[2]};
    w = {r[3]};
}
/// Returns the first and the second floats of pairs; each of at(0), at(2), ... has two pairs.
template <class At>
inline void splitPairsAt(const At& at, Floats& x, Floats& y) {
    const FloatVector ab = quadsAt(at, 0, kQuads), cd = quadsAt(at, 2, kQuads);
    x = {inFours<0, 2, 4, 6>(ab, cd)};
    y = {inFours<1, 3, 5, 7>(ab, cd)};
}
template <std::size_t kStep, std::size_t... kQuad>
inline void storeQuads(float* rows, const FloatVector (&r)[4], std::index_sequence<kQuad...>) {
    const auto store = [&](float* to, Quad a, Quad b, Quad c, Quad d) {
        storeQuad(to, a);
        storeQuad(to + kStep, b);
        storeQuad(to + 2 * kStep, c);
        storeQuad(to + 3 * kStep, d);
    };
    (store(rows + 4 * kStep * kQuad, quad<kQuad>(r[0]), quad<kQuad>(r[1]), quad<kQuad>(r[2]), quad<kQuad>(r[3])), ...);
}
template <std::size_t kStep, std::size_t... kQuad>
inline void storeQuadPairs(float* rows, FloatVector low, FloatVector high, std::index_sequence<kQuad...>) {
    const auto store = [](float* to, Quad pairs) {
        storeTwo(to, reinterpret_cast<TwoDoubles>(pairs)[0]);
        storeTwo(to + kStep, reinterpret_cast<TwoDoubles>(pairs)[1]);
    };
    ((store(rows + 4 * kStep * kQuad, quad<kQuad>(low)), store(rows + (4 * kQuad + 2) * kStep, quad<kQuad>(high))),
     ...);
}

/// Reads the elements with the numbers index[0], index[3], index[6], ... (one corner of consecutive triangles) of an
/// array of vectors. With `exact`, only the 12 bytes of each vector are read; otherwise also the following 4 bytes.
TSPACE_ROWS inline void gather3(const std::byte* base, std::size_t stride, const std::uint32_t* index, bool exact,
                                Floats& x, Floats& y, Floats& z) {
    Floats none;
    columnsAt([&](std::size_t i) { return loadVector(base + stride * index[3 * i], exact); }, x, y, z, none);
}
TSPACE_ROWS inline void gather2(const std::byte* base, std::size_t stride, const std::uint32_t* index, Floats& x,
                                Floats& y) {
    const auto two = [&](std::size_t i) {
        return twoPairs(base + stride * index[3 * i], base + stride * index[3 * i + 3]);
    };
    splitPairsAt(two, x, y);
}
/// Reads kWidth contiguous pairs of floats.
TSPACE_ROWS inline void loadPairs(const float* pairs, Floats& x, Floats& y) {
    splitPairsAt([&](std::size_t i) { return loadQuad(pairs + 2 * i); }, x, y);
}
/// Writes lane i's four values to rows[kStep * i ...], by default row 3 * i of an array of rows of four floats. `rows`
/// may be any address that is valid for floats. Rows are written in order: with a step of 3, all but the last row
/// contain three values, and one more value is written after them.
template <std::size_t kStep = 12>
TSPACE_ROWS inline void storeRows(float* rows, Floats x, Floats y, Floats z, Floats w) {
    FloatVector r[4] = {x.v, y.v, z.v, w.v};
    transpose(r);
    storeQuads<kStep>(rows, r, kQuads);
}
/// Loads the rows that storeRows wrote.
template <std::size_t kStep>
TSPACE_ROWS inline void loadRows(const float* rows, Floats& x, Floats& y, Floats& z, Floats& w) {
    columnsAt([&](std::size_t i) { return loadQuad(rows + kStep * i); }, x, y, z, w);
}
/// Writes rows of two values, otherwise like storeRows.
template <std::size_t kStep>
TSPACE_ROWS inline void storePairs(float* rows, Floats x, Floats y) {
    storeQuadPairs<kStep>(rows, mixLow(x.v, y.v), mixHigh(x.v, y.v), kQuads);
}

/// Writes lane i's four values to row i of an array of rows of four doubles, for half of the lanes.
inline void storeDoubleRows(double* rows, Doubles x, Doubles y, Doubles z, Doubles w) {
    const FloatVector r[4] = {lowPairs(pairsOf(x), pairsOf(y)), lowPairs(pairsOf(z), pairsOf(w)),
                              highPairs(pairsOf(x), pairsOf(y)), highPairs(pairsOf(z), pairsOf(w))};
    storeQuads<4>(reinterpret_cast<float*>(rows), r, kQuads);
}
/// Loads the rows that storeDoubleRows wrote.
inline void loadDoubleRows(const double* rows, Doubles& x, Doubles& y, Doubles& z, Doubles& w) {
    const auto at = [&](std::size_t i) { return reinterpret_cast<const AlignedQuad*>(rows)[i]; };
    FloatVector r[4];
    for (std::size_t i = 0; i < 4; ++i) r[i] = quadsAt(at, i, kQuads);
    x = {reinterpret_cast<DoubleVector>(lowPairs(r[0], r[2]))};
    y = {reinterpret_cast<DoubleVector>(highPairs(r[0], r[2]))};
    z = {reinterpret_cast<DoubleVector>(lowPairs(r[1], r[3]))};
    w = {reinterpret_cast<DoubleVector>(highPairs(r[1], r[3]))};
}

#undef TSPACE_ROWS
