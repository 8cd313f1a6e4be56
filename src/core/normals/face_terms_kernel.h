// SPDX-License-Identifier: MIT
// Kernel of face_terms.h. Included once per instruction set, after lanes_*.h and with TSPACE_LANES set to its
// namespace. Each lane is one triangle.
#pragma once

#include "core/normals/face_terms.h"
#include "core/simd/vectors_kernel.h"

namespace tspace::smooth::TSPACE_LANES {

using namespace simd::TSPACE_LANES;

namespace {

/// Replaces cotangents by angles in [0, pi], with a relative error of 2e-7. The polynomial is (atan(t) - t) / t^3 in
/// t^2, interpolated at the Chebyshev points of [0, 1]; its error is 2e-9. Computes three at a time, interleaved,
/// because each step depends on the previous one.
inline void anglesOfCotangents(Floats (&c)[3]) {
    constexpr float kPolynomial[] = {1.350777142e-02f, -3.587153898e-02f, 6.250169444e-02f, -8.656880430e-02f,
                                     1.103376412e-01f, -1.427856875e-01f, 1.999973933e-01f, -3.333333173e-01f};
    const Floats one = broadcast(1.0f), half_pi = broadcast(1.57079632679489662f);
    Floats size[3], t[3], q[3], p[3];
    for (std::size_t k = 0; k < 3; ++k) {
        size[k] = absolute(c[k]);
        t[k] = smaller(size[k], one) / larger(size[k], one);
        q[k] = t[k] * t[k];
        p[k] = broadcast(-2.386997316e-03f);
    }
    for (const float coefficient : kPolynomial) {
        const Floats next = broadcast(coefficient);
        for (std::size_t k = 0; k < 3; ++k) p[k] = p[k] * q[k] + next;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const Floats atan = t[k] + t[k] * (q[k] * p[k]);
        const Floats angle = select(size[k] > one, atan, half_pi - atan);
        c[k] = select(c[k] < broadcast(0.0f), broadcast(3.14159265358979324f) - angle, angle);
    }
}

struct DoubleVectors {
    Doubles x, y, z;
};
inline DoubleVectors operator-(DoubleVectors a, DoubleVectors b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Doubles dot(DoubleVectors a, DoubleVectors b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline DoubleVectors cross(DoubleVectors a, DoubleVectors b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Writes normals and computes cotangents; returns the bits of the triangles that have a normal. Uses double precision,
/// in which differences of floats are exact or nearly so, without overflow or underflow.
template <bool kByArea>
inline unsigned faceNormals(DoubleVectors o, DoubleVectors p1, DoubleVectors p2, double factor, double* rows,
                            Doubles (&cotangents)[3]) {
    const DoubleVectors a = p1 - o, b = p2 - o, n = cross(a, b);
    const Doubles length = squareRoot(dot(n, n)), one = broadcastDouble(1.0);
    const DoubleMask sound = (length > broadcastDouble(0.0)) & (broadcastDouble(1e300) > length);
    const Doubles inverse = keepWhere(sound, one / length);
    const Doubles scale = kByArea ? broadcastDouble(factor) : broadcastDouble(factor) * inverse;
    storeDoubleRows(rows, keepWhere(sound, n.x * scale), keepWhere(sound, n.y * scale), keepWhere(sound, n.z * scale),
                    keepWhere(sound, kByArea ? length : one));
    const Doubles aa = dot(a, a), bb = dot(b, b), ab = dot(a, b);
    cotangents[0] = keepWhere(sound, ab * inverse);
    cotangents[1] = keepWhere(sound, (aa - ab) * inverse);
    cotangents[2] = keepWhere(sound, (bb - ab) * inverse);
    return bitsOf(sound);
}

/// Intermediate results of a block. Each step is a separate loop: a single long loop body would be one chain of
/// dependent operations, while a processor overlaps the iterations of short loops.
struct Steps {
    alignas(64) float position[3][3][kTermTriangles];  ///< x, y and z of each corner
    alignas(64) float angle[3][kTermTriangles];        ///< first the cotangent, then the angle at each corner
};

inline void readPositions(const FaceSource& source, const std::uint32_t* vertices, std::size_t t, Steps& steps) {
    const bool exact = includesLast(vertices, source.last_vertex);
#pragma GCC unroll 3  // keeps the arrays in registers
    for (std::size_t k = 0; k < 3; ++k) {
        const Vectors p = gatherVectors(source.positions, source.stride, vertices + k, exact);
        store(steps.position[k][0] + t, p.x);
        store(steps.position[k][1] + t, p.y);
        store(steps.position[k][2] + t, p.z);
    }
}

/// Computes the terms of a block. The angles at a corner are equal for a face and for its reverse, so that the two
/// cancel.
template <bool kByArea>
std::size_t computeTerms(const FaceSource& source, const std::uint32_t* vertices, std::size_t count, FaceTerms& terms) {
    constexpr std::size_t kPart = kWidth / kDoubleParts;
    std::size_t degenerate = 0;
    Steps steps;
    for (std::size_t t = 0; t < count; t += kWidth) readPositions(source, vertices + 3 * t, t, steps);
    for (std::size_t t = 0; t < count; t += kPart) {
        DoubleVectors p[3];
        for (std::size_t k = 0; k < 3; ++k) {
            const auto& [x, y, z] = steps.position[k];
            p[k] = {loadAsDoubles(x + t), loadAsDoubles(y + t), loadAsDoubles(z + t)};
        }
        Doubles cotangents[3];
        const unsigned sound = faceNormals<kByArea>(p[0], p[1], p[2], source.factor, terms.normal[t], cotangents);
        const unsigned asked = (1u << (count - t < kPart ? count - t : kPart)) - 1;
        if ((asked & ~sound) != 0) degenerate += static_cast<unsigned>(__builtin_popcount(asked & ~sound));
        for (std::size_t k = 0; k < 3; ++k) storeAsFloats(steps.angle[k] + t, cotangents[k]);
    }
    for (std::size_t t = 0; t < count; t += kWidth) {
        Floats angles[3];
        for (std::size_t k = 0; k < 3; ++k) angles[k] = source.by_angle ? load(steps.angle[k] + t) : broadcast(1.0f);
        if (source.by_angle) anglesOfCotangents(angles);
        for (std::size_t k = 0; k < 3; ++k) store(steps.angle[k] + t, angles[k]);
    }
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t t = 0; t < count; t += kPart)
            storeDoubles(terms.angle[k] + t, loadAsDoubles(steps.angle[k] + t));
    }
    return degenerate;
}

std::size_t compute(const FaceSource& source, const std::uint32_t* vertices, std::size_t count, FaceTerms& terms) {
    return source.by_area ? computeTerms<true>(source, vertices, count, terms)
                          : computeTerms<false>(source, vertices, count, terms);
}

void add(const FaceTerms& terms, const std::uint32_t* points, std::size_t count, double* sums, std::uint32_t begin,
         std::uint32_t end) {
    for (std::size_t t = 0; t < count; ++t, points += 3) {
        const DoubleRow normal = loadDoubleRow(terms.normal[t]);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t place = points[k] - begin;
            if (place < end - begin) addDoubleRow(sums + std::size_t{4} * place, terms.angle[k][t], normal);
        }
    }
}

std::uint64_t finish(double* sums, std::size_t count, double least) {
    constexpr std::size_t kPart = kWidth / kDoubleParts;
    std::uint64_t doubtful = 0;
    for (double* const end = sums + 4 * count; sums != end; sums += 4 * kWidth) {
        Doubles x[kDoubleParts], y[kDoubleParts], z[kDoubleParts], mark[kDoubleParts];
        for (std::size_t i = 0; i < kDoubleParts; ++i) {
            DoubleVectors sum;
            Doubles weights;
            loadDoubleRows(sums + 4 * kPart * i, sum.x, sum.y, sum.z, weights);
            const Doubles length = squareRoot(dot(sum, sum)), zero = broadcastDouble(0.0);
            const DoubleMask clear = length > broadcastDouble(least) * weights;
            const Doubles inverse = broadcastDouble(1.0) / length;
            x[i] = keepWhere(clear, inverse * sum.x);
            y[i] = keepWhere(clear, inverse * sum.y);
            z[i] = keepWhere(clear, inverse * sum.z);
            mark[i] = negateUnless(clear, zero);
            doubtful += static_cast<unsigned>(__builtin_popcount(bitsOf(weights > zero) & ~bitsOf(clear)));
        }
        storeRows<8>(reinterpret_cast<float*>(sums), join(x), join(y), join(z), join(mark));
    }
    return doubtful;
}

}  // namespace

FaceKernel faceKernel() { return {compute, add, finish}; }

}  // namespace tspace::smooth::TSPACE_LANES
