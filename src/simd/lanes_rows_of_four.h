// SPDX-License-Identifier: MIT
// Rows of four numbers to and from four lanes. Included as lanes_arithmetic.h, behind lanes_of_four.h. TSPACE_ROWS: what
// the compiler is told about these functions.

/// Reads the elements numbered index[0], index[3], index[6], ... (one corner of consecutive triangles) of an
/// array of vectors. `exact` reads their 12 bytes and no more; otherwise the 4 bytes after them are read too.
TSPACE_ROWS inline void gather3(const std::byte* base, std::size_t stride, const std::uint32_t* index, bool exact,
                                Floats& x, Floats& y, Floats& z) {
    FloatVector r[4];
    for (std::size_t i = 0; i < 4; ++i) r[i] = loadVector(base + stride * index[3 * i], exact);
    transpose(r);
    x = {r[0]};
    y = {r[1]};
    z = {r[2]};
}
TSPACE_ROWS inline void gather2(const std::byte* base, std::size_t stride, const std::uint32_t* index, Floats& x,
                                Floats& y) {
    const auto two = [&](std::size_t i) {
        return reinterpret_cast<FloatVector>(
            DoubleVector{loadTwo(base + stride * index[3 * i]), loadTwo(base + stride * index[3 * i + 3])});
    };
    splitPairs(two(0), two(2), x, y);
}
/// Reads kWidth pairs of floats that lie side by side.
TSPACE_ROWS inline void loadPairs(const float* pairs, Floats& x, Floats& y) {
    splitPairs(loadRow(pairs), loadRow(pairs + 4), x, y);
}
/// Writes lane i's four values to rows[kStep * i ...], by default row 3 * i of an array of rows of four floats. At any
/// address that floats may have. Rows are written one after the other: with a step of 3, all but the last row hold three
/// values, and one more is written after them.
template <std::size_t kStep = 12>
TSPACE_ROWS inline void storeRows(float* rows, Floats x, Floats y, Floats z, Floats w) {
    FloatVector r[4] = {x.v, y.v, z.v, w.v};
    transpose(r);
    for (std::size_t i = 0; i < 4; ++i) storeRow(rows + kStep * i, r[i]);
}
/// The opposite of storeRows.
template <std::size_t kStep>
TSPACE_ROWS inline void loadRows(const float* rows, Floats& x, Floats& y, Floats& z, Floats& w) {
    FloatVector r[4];
    for (std::size_t i = 0; i < 4; ++i) r[i] = loadRow(rows + kStep * i);
    transpose(r);
    x = {r[0]};
    y = {r[1]};
    z = {r[2]};
    w = {r[3]};
}
/// As storeRows, for two values.
template <std::size_t kStep>
TSPACE_ROWS inline void storePairs(float* rows, Floats x, Floats y) {
    const auto low = reinterpret_cast<DoubleVector>(__builtin_shufflevector(x.v, y.v, 0, 4, 1, 5));
    const auto high = reinterpret_cast<DoubleVector>(__builtin_shufflevector(x.v, y.v, 2, 6, 3, 7));
    for (std::size_t i = 0; i < 2; ++i) {
        storeTwo(rows + kStep * i, low[i]);
        storeTwo(rows + kStep * (2 + i), high[i]);
    }
}
