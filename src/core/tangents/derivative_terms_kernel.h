// SPDX-License-Identifier: MIT
// Kernel of derivative_terms.h. Included once per instruction set, after lanes_*.h and with TSPACE_LANES set to its
// namespace. Each lane is one triangle or one vertex.
#pragma once

#include "core/simd/vectors_kernel.h"
#include "core/tangents/derivative_terms.h"

namespace tspace::derivatives::TSPACE_LANES {

using namespace simd::TSPACE_LANES;

namespace {

// limits of determinants and squared lengths, far enough from the limits of float for all following operations
constexpr float kLeast = 1e-30f, kGreatest = 1e30f;
// Minimum difference |a - b|, relative to |a| + |b|, for computing a determinant a - b in single precision. Its terms
// have an error of 3 roundings each, so its error is at most 100 roundings (6e-6) and its sign is certain.
constexpr float kLeastShare = 1.0f / 32;
// Minimum values for single precision: Gram-Schmidt must leave at least a sixteenth of the length, and the volume that
// decides the sign must exceed rounding noise (about 2^-18 of the product of lengths).
constexpr float kLeastRest2 = 1.0f / 256;
constexpr float kLeastVolume = 1.0f / 16384;

inline Mask equal(Vectors a, Vectors b) { return (a.x == b.x) & (a.y == b.y) & (a.z == b.z); }

struct Group {
    Vectors p[3];
    Floats u[3], v[3];
};

/// Loads kWidth triangles. With kTight, strides are constants, so that addresses need no multiplication.
template <bool kTight>
inline Group load(const TriangleSource& source, const std::uint32_t* vertices, bool exact) {
    const std::size_t position_stride = kTight ? 12 : source.position_stride, uv_stride = kTight ? 8 : source.uv_stride;
    Group g;
#pragma GCC unroll 3  // keeps the arrays in registers
    for (std::size_t k = 0; k < 3; ++k) {
        g.p[k] = gatherVectors(source.positions, position_stride, vertices + k, exact);
        gather2(source.uvs, uv_stride, vertices + k, g.u[k], g.v[k]);
    }
    return g;
}

struct GroupBits {
    unsigned safe, mirrored, degenerate;
};

/// Writes the rows of kWidth triangles.
[[gnu::always_inline]] inline GroupBits writeRows(const Group& g, float* rows) {
    const Floats zero = broadcast(0.0f);
    const Floats s1 = g.u[1] - g.u[0], t1 = g.v[1] - g.v[0], s2 = g.u[2] - g.u[0], t2 = g.v[2] - g.v[0];
    const Floats plus = s1 * t2, minus = s2 * t1, determinant = plus - minus;
    const Floats r = broadcast(1.0f) / determinant, size = absolute(determinant);
    Mask safe = (size > broadcast(kLeastShare) * (absolute(plus) + absolute(minus))) & (size > broadcast(kLeast)) &
                (size < broadcast(kGreatest));

    const Vectors e1 = g.p[1] - g.p[0], e2 = g.p[2] - g.p[0];
    // Positions are compared only if two corners have equal x, which is rare.
    unsigned degenerate = 0;
    if (bitsOf((e1.x == zero) | (e2.x == zero) | (g.p[1].x == g.p[2].x)) != 0) [[unlikely]]
        degenerate = bitsOf(equal(g.p[0], g.p[1]) | equal(g.p[0], g.p[2]) | equal(g.p[1], g.p[2]));
    // Divides first: products of edges and UV differences can exceed the range of float, but quotients cannot.
    const Vectors s = (t2 * r) * e1 - (t1 * r) * e2, t = (s1 * r) * e2 - (s2 * r) * e1;
    // 0 * x is 0 unless x is infinite or NaN, so this excludes triangles whose results overflow.
    safe = safe & (zero * ((s.x + s.y + s.z) + (t.x + t.y + t.z)) == zero);
    storeRows<8>(rows, s.x + zero, s.y, s.z, t.x);
    storePairs<8>(rows + 4, t.y, t.z);
    return {bitsOf(safe), bitsOf(safe & (determinant < zero)), degenerate};
}

/// Returns whether any vertex is the last one in memory, after which nothing may be read.
inline bool includesLastVertex(const std::uint32_t* vertices, std::size_t count, std::uint32_t last) {
    std::uint32_t others = ~std::uint32_t{0};  // set to 0 if a vertex is the last one
    for (std::size_t i = 0; i < 3 * count; ++i) others &= vertices[i] == last ? 0 : ~std::uint32_t{0};
    return others == 0;
}

template <bool kTight>
inline void computeBlock(const TriangleSource& source, const std::uint32_t* vertices, std::size_t count, bool exact,
                         DerivativeTerms& terms) {
    std::uint64_t safe = 0, mirrored = 0, degenerate = 0;
    for (std::size_t i = 0; i < count; i += kWidth) {
        const GroupBits bits = writeRows(load<kTight>(source, vertices + 3 * i, exact), terms.rows[i]);
        safe |= std::uint64_t{bits.safe} << i;
        mirrored |= std::uint64_t{bits.mirrored} << i;
        degenerate |= std::uint64_t{bits.degenerate} << i;
    }
    const std::uint64_t known = ~std::uint64_t{0} >> (kTermTriangles - count);
    terms.safe = safe & known;
    terms.mirrored = mirrored & known;
    terms.degenerate = degenerate & known;
}

void compute(const TriangleSource& source, const std::uint32_t* vertices, std::size_t count, DerivativeTerms& terms) {
    const bool exact = includesLastVertex(vertices, (count + kWidth - 1) / kWidth * kWidth, source.last_vertex);
    if (!exact && source.position_stride == 12 && source.uv_stride == 8) {
        computeBlock<true>(source, vertices, count, false, terms);
    } else {
        computeBlock<false>(source, vertices, count, exact, terms);
    }
}

// Unaligned float vectors (their address may be any multiple of 4 bytes) that may alias any type. Clang ignores
// `aligned` after the equals sign.
using Head __attribute__((aligned(4), may_alias)) = float __attribute__((vector_size(16)));
using Tail __attribute__((aligned(4), may_alias)) = float __attribute__((vector_size(8)));

/// Row that a triangle adds to the sums of a vertex.
struct Addend {
    Head head;
    Tail tail;

    explicit Addend(const float* row)
        : head(*reinterpret_cast<const Head*>(row)), tail(*reinterpret_cast<const Tail*>(row + 4)) {}
};

inline void addAt(SumArrays sums, std::size_t v, const Addend& a) {
    *reinterpret_cast<Head*>(sums.heads + 4 * v) += a.head;
    *reinterpret_cast<Tail*>(sums.tails + 2 * v) += a.tail;
}
/// Adds row a, then row b, to the sums of a vertex.
inline void addAt(SumArrays sums, std::size_t v, const Addend& a, const Addend& b) {
    auto* const head = reinterpret_cast<Head*>(sums.heads + 4 * v);
    auto* const tail = reinterpret_cast<Tail*>(sums.tails + 2 * v);
    *head = *head + a.head + b.head;
    *tail = *tail + a.tail + b.tail;
}

/// Adds rows to sums. Writing sums takes most of the time. If two triangles form a quad, in the order in which most
/// programs cut it, their two shared vertices are therefore written once.
void add(const DerivativeTerms& terms, const std::uint32_t* vertices, std::size_t begin, std::size_t end,
         SumArrays sums) {
    for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t* const v = vertices + 3 * i;
        const Addend a(terms.rows[i]);
        if (i + 1 < end && v[3] == v[0] && v[4] == v[2]) {
            const Addend b(terms.rows[i + 1]);
            addAt(sums, v[0], a, b);
            addAt(sums, v[1], a);
            addAt(sums, v[2], a, b);
            addAt(sums, v[5], b);
            ++i;
        } else {
            for (std::size_t k = 0; k < 3; ++k) addAt(sums, v[k], a);
        }
    }
}

void addSome(const DerivativeTerms& terms, const std::uint32_t* vertices, std::size_t begin, std::size_t end,
             SumArrays sums, std::uint32_t first, std::uint32_t past) {
    for (std::size_t i = begin; i < end; ++i) {
        const Addend a(terms.rows[i]);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = vertices[3 * i + k];
            if (v - first < past - first) addAt(sums, v, a);
        }
    }
}

inline Floats size(Vectors a) { return absolute(a.x) + absolute(a.y) + absolute(a.z); }

/// Indices of kWidth consecutive elements, for gather3.
struct Consecutive {
    std::uint32_t index[3 * kWidth];
    constexpr Consecutive() : index() {
        for (std::size_t i = 0; i < kWidth; ++i) index[3 * i] = static_cast<std::uint32_t>(i);
    }
};

/// Computes makeCornerFrame in single precision. Returns the bits of the vertices whose tangents are accurate; the
/// heads of the others are unchanged.
[[gnu::always_inline]] inline unsigned finishGroup(float* heads, const float* tails, Vectors n, float sign_factor) {
    Vectors s, t;
    loadRows<4>(heads, s.x, s.y, s.z, t.x);
    loadPairs(tails, t.y, t.z);
    const Floats along = dot(n, s);
    const Vectors rest = s - along * n;
    const Floats rest2 = dot(rest, rest), length = squareRoot(rest2);
    const Floats volume = dot(cross(n, rest), t);
    const Floats n_size = size(n), lost = along * n_size;
    const Mask safe = (rest2 > broadcast(kLeastRest2) * (lost * lost)) & (rest2 > broadcast(kLeast)) &
                      (rest2 < broadcast(kGreatest)) &
                      (absolute(volume) > broadcast(kLeastVolume) * n_size * length * size(t));
    const Floats sign = select(volume < broadcast(0.0f), broadcast(-sign_factor), broadcast(sign_factor));
    const Vectors unit{rest.x / length, rest.y / length, rest.z / length};
    if (all(safe)) [[likely]] {
        storeRows<4>(heads, unit.x, unit.y, unit.z, sign);
        return bitsOf(safe);
    }
    alignas(64) float rows[4 * kWidth];
    storeRows<4>(rows, unit.x, unit.y, unit.z, sign);
    for (std::size_t i = 0; i < kWidth; ++i) {
        if ((bitsOf(safe) >> i & 1) != 0)
            *reinterpret_cast<Head*>(heads + 4 * i) = *reinterpret_cast<Head*>(rows + 4 * i);
    }
    return bitsOf(safe);
}

std::uint64_t finish(SumArrays sums, const std::byte* normals, std::size_t stride, float sign_factor,
                     std::size_t count) {
    constexpr Consecutive kNext;
    std::uint64_t safe = 0;
    for (std::size_t v = 0; v < count; v += kWidth) {
        Vectors n;
        gather3(normals + v * stride, stride, kNext.index, false, n.x, n.y, n.z);
        safe |= std::uint64_t{finishGroup(sums.heads + 4 * v, sums.tails + 2 * v, n, sign_factor)} << v;
    }
    return safe;
}

}  // namespace

DerivativeKernel derivativeKernel() { return {compute, add, addSome, finish}; }

}  // namespace tspace::derivatives::TSPACE_LANES
