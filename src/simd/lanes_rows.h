// SPDX-License-Identifier: MIT
// Rows of four numbers to and from vectors of 4, 8 or 16 lanes, which lie in registers as rows do: four lanes side by side,
// and what is done to four of them is done to all. Included as lanes_arithmetic.h, behind it and
// behind joinRows, which makes a vector of rowAt(0), rowAt(4) and so on, and rowFrom, which has one of these out again.
// TSPACE_ROWS: what the compiler is told about these functions.

using RowInMemory = float __attribute__((vector_size(16), aligned(4), may_alias));
using TwoDoubles = double __attribute__((vector_size(16)));
inline Row loadRow(const void* p) { return *static_cast<const RowInMemory*>(p); }
inline void storeRow(void* to, Row row) { *static_cast<RowInMemory*>(to) = row; }

/// Two floats as one double.
inline double loadTwo(const void* p) {
    double d;
    std::memcpy(&d, p, sizeof d);
    return d;
}
inline void storeTwo(void* to, double two) { std::memcpy(to, &two, sizeof two); }
/// Three floats. `exact` reads no more; otherwise the four bytes after them are read too.
inline Row loadVector(const std::byte* p, bool exact) {
    if (!exact) return loadRow(p);
    float z;
    std::memcpy(&z, p + 8, sizeof z);
    const Row xy = reinterpret_cast<Row>(TwoDoubles{loadTwo(p), 0}), zz = {z, 0, 0, 0};
    return __builtin_shufflevector(xy, zz, 0, 1, 4, 5);
}

/// Of each four lanes of a and b those with these numbers; b's are 4 to 7.
template <int... kOfFour, std::size_t... kLane>
inline FloatVector mixLanes(FloatVector a, FloatVector b, std::index_sequence<kLane...>) {
    constexpr int kFour[] = {kOfFour...}, kSize = static_cast<int>(kWidth);
    return __builtin_shufflevector(
        a, b, (static_cast<int>(kLane / 4 * 4) + kFour[kLane % 4] % 4 + (kFour[kLane % 4] < 4 ? 0 : kSize))...);
}
template <int... kOfFour>
inline FloatVector mix(FloatVector a, FloatVector b) {
    return mixLanes<kOfFour...>(a, b, std::make_index_sequence<kWidth>());
}

/// body(i, row) of the rows that v joins.
template <std::size_t kFirst = 0, class Body>
inline void forRows(FloatVector v, const Body& body) {
    body(kFirst, rowFrom<kFirst>(v));
    if constexpr (kFirst + 4 < kWidth) forRows<kFirst + 4>(v, body);
}

/// Of each four lanes rows become columns.
inline void transpose(FloatVector (&r)[4]) {
    const FloatVector ab_low = mix<0, 4, 1, 5>(r[0], r[1]), ab_high = mix<2, 6, 3, 7>(r[0], r[1]);
    const FloatVector cd_low = mix<0, 4, 1, 5>(r[2], r[3]), cd_high = mix<2, 6, 3, 7>(r[2], r[3]);
    r[0] = mix<0, 1, 4, 5>(ab_low, cd_low);
    r[1] = mix<2, 3, 6, 7>(ab_low, cd_low);
    r[2] = mix<0, 1, 4, 5>(ab_high, cd_high);
    r[3] = mix<2, 3, 6, 7>(ab_high, cd_high);
}

TSPACE_ROWS inline void gather3(const std::byte* base, std::size_t stride, const std::uint32_t* index, bool exact,
                                Floats& x, Floats& y, Floats& z) {
    const auto column = [&](std::size_t j) {
        return joinRows([&](std::size_t i) { return loadVector(base + stride * index[3 * (i + j)], exact); });
    };
    FloatVector r[4] = {column(0), column(1), column(2), column(3)};
    transpose(r);
    x = {r[0]};
    y = {r[1]};
    z = {r[2]};
}
TSPACE_ROWS inline void gather2(const std::byte* base, std::size_t stride, const std::uint32_t* index, Floats& x,
                                Floats& y) {
    const auto two = [&](std::size_t j) {
        return joinRows([&](std::size_t i) {
            return reinterpret_cast<Row>(TwoDoubles{loadTwo(base + stride * index[3 * (i + j)]),
                                                    loadTwo(base + stride * index[3 * (i + j) + 3])});
        });
    };
    const FloatVector ab = two(0), cd = two(2);
    x = {mix<0, 2, 4, 6>(ab, cd)};
    y = {mix<1, 3, 5, 7>(ab, cd)};
}
TSPACE_ROWS inline void loadPairs(const float* pairs, Floats& x, Floats& y) {
    const FloatVector ab = joinRows([&](std::size_t i) { return loadRow(pairs + 2 * i); });
    const FloatVector cd = joinRows([&](std::size_t i) { return loadRow(pairs + 2 * i + 4); });
    x = {mix<0, 2, 4, 6>(ab, cd)};
    y = {mix<1, 3, 5, 7>(ab, cd)};
}
/// Ascending, for rows of three floats overlap: each is one float too long, and the next one mends that.
template <std::size_t kStep, std::size_t kFirst = 0>
TSPACE_ROWS inline void storeFours(float* rows, const FloatVector (&r)[4]) {
    for (std::size_t j = 0; j < 4; ++j) storeRow(rows + kStep * (kFirst + j), rowFrom<kFirst>(r[j]));
    if constexpr (kFirst + 4 < kWidth) storeFours<kStep, kFirst + 4>(rows, r);
}
template <std::size_t kStep = 12>
TSPACE_ROWS inline void storeRows(float* rows, Floats x, Floats y, Floats z, Floats w) {
    FloatVector r[4] = {x.v, y.v, z.v, w.v};
    transpose(r);
    storeFours<kStep>(rows, r);
}
template <std::size_t kStep>
TSPACE_ROWS inline void loadRows(const float* rows, Floats& x, Floats& y, Floats& z, Floats& w) {
    const auto column = [&](std::size_t j) {
        return joinRows([&](std::size_t i) { return loadRow(rows + kStep * (i + j)); });
    };
    FloatVector r[4] = {column(0), column(1), column(2), column(3)};
    transpose(r);
    x = {r[0]};
    y = {r[1]};
    z = {r[2]};
    w = {r[3]};
}
template <std::size_t kStep>
TSPACE_ROWS inline void storePairs(float* rows, Floats x, Floats y) {
    const auto two = [&](std::size_t j) {
        return [=](std::size_t i, Row row) {
            const auto pairs = reinterpret_cast<TwoDoubles>(row);
            storeTwo(rows + kStep * (i + j), pairs[0]);
            storeTwo(rows + kStep * (i + j + 1), pairs[1]);
        };
    };
    forRows(mix<0, 4, 1, 5>(x.v, y.v), two(0));
    forRows(mix<2, 6, 3, 7>(x.v, y.v), two(2));
}
