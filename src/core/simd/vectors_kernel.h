// SPDX-License-Identifier: MIT
// Three-component vectors on lanes and their loading, directions and planes, the arc cosine. Included after lanes_*.h,
// with TSPACE_LANES set to its namespace.
#pragma once

namespace tspace::simd::TSPACE_LANES {

inline Floats zero() { return broadcast(0.0f); }
inline Floats minus(Floats a) { return broadcast(-0.0f) - a; }

struct Vectors {
    Floats x, y, z;
};
inline Vectors operator-(Vectors a, Vectors b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vectors operator+(Vectors a, Vectors b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vectors operator*(Floats k, Vectors v) { return {k * v.x, k * v.y, k * v.z}; }
inline Floats dot(Vectors a, Vectors b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vectors cross(Vectors a, Vectors b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// true: reading past the end of an array is forbidden. With TSPACE_SMALL, arrays are copies with padding, so reading
/// past the end is allowed.
#ifdef TSPACE_SMALL
inline constexpr bool kIsEndProtected = false;
#else
inline constexpr bool kIsEndProtected = true;
#endif

/// Gathers vectors without reading past the end of the array. Kept out of line, because it is long and rarely called.
[[gnu::noinline]] inline Vectors gatherExactly(const std::byte* base, std::size_t stride, const std::uint32_t* index) {
    Vectors v;
    gather3(base, stride, index, true, v.x, v.y, v.z);
    return v;
}

/// Gathers vectors. With `exact`, the bytes after a vector are not read.
[[gnu::always_inline]] inline Vectors gatherVectors(const std::byte* base, std::size_t stride,
                                                    const std::uint32_t* index, bool exact) {
    if (kIsEndProtected && exact) [[unlikely]]
        return gatherExactly(base, stride, index);
    Vectors v;
    if (stride == 12) {  // addresses need no multiplication
        gather3(base, 12, index, false, v.x, v.y, v.z);
    } else {
        gather3(base, stride, index, false, v.x, v.y, v.z);
    }
    return v;
}

/// Returns whether any vertex is the last one in memory, after which nothing may be read.
inline bool includesLast(const std::uint32_t* vertices, std::uint32_t last) {
    if (!kIsEndProtected) return false;
    std::uint32_t named = 0;
    for (std::size_t i = 0; i < 3 * kWidth; ++i) named |= vertices[i] == last ? 1u : 0u;
    return named != 0;
}

// Directions and planes on SIMD lanes. Included after lanes_*.h, with TSPACE_LANES set to their namespace.

inline Mask isFinite(Floats a) { return absolute(a) < broadcast(__builtin_huge_valf()); }
inline Floats keep(Mask m, Floats a) { return select(m, a, zero()); }
inline Vectors keep(Mask m, Vectors v) { return {keep(m, v.x), keep(m, v.y), keep(m, v.z)}; }
/// Returns a / b, or 0 if b is not positive or the quotient is not finite.
inline Floats quotient(Floats a, Floats b) {
    const Floats q = a / b;
    return keep((b > zero()) & isFinite(q), q);
}

/// A vector in the tangent plane.
struct Flat {
    Floats x, y;
};
inline Flat operator+(Flat a, Flat b) { return {a.x + b.x, a.y + b.y}; }
inline Flat operator-(Flat a, Flat b) { return {a.x - b.x, a.y - b.y}; }
inline Flat operator*(Floats k, Flat a) { return {k * a.x, k * a.y}; }
inline Floats dot(Flat a, Flat b) { return a.x * b.x + a.y * b.y; }

inline Flat keep(Mask m, Flat a) { return {keep(m, a.x), keep(m, a.y)}; }

/// Returns the unit vectors; a vector without a direction becomes zero.
template <class Vector>
inline Vector unit(Vector v) {
    const Floats square = dot(v, v), scale = broadcast(1.0f) / squareRoot(square);
    return keep((square > zero()) & isFinite(square) & isFinite(scale), scale * v);
}

/// Returns the unit normals, with -0 replaced by +0; a normal without a direction becomes the z axis.
inline Vectors unitNormal(Vectors n) {
    const Vectors u = unit(n);
    const Mask none = !(dot(u, u) > zero());
    return {u.x + zero(), u.y + zero(), select(none, broadcast(1.0f), u.z) + zero()};
}

/// A normal with two axes in the plane perpendicular to it.
/// Based on: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
struct Plane {
    Vectors n, x, y;

    explicit Plane(Vectors normal) : n(unitNormal(normal)) {
        const Floats one = broadcast(1.0f), s = select(n.z < zero(), broadcast(-1.0f), one);
        const Floats a = broadcast(-1.0f) / (s + n.z), b = n.x * n.y * a;
        x = {one + s * n.x * n.x * a, s * b, minus(s * n.x)};
        y = {b, s + n.y * n.y * a, minus(n.y)};
    }
    [[nodiscard]] Flat flatten(Vectors v) const { return {dot(x, v), dot(y, v)}; }
    [[nodiscard]] Vectors raise(Flat f) const { return f.x * x + f.y * y; }
};

/// Solves three equations by LDL^T decomposition. m: 00 01 02 11 12 22. `ridge`, twice `ridge`, and `ridge` are added
/// to its diagonal, which keeps the pivots positive, except for rounding.
template <class Right>
inline void solveRidged(const Floats (&m)[6], Floats ridge, const Right (&p)[3], Right (&q)[3]) {
    const Floats one = broadcast(1.0f), least = broadcast(0.5f) * ridge, two = ridge + ridge;
    const Floats i0 = one / larger(m[0] + ridge, least);
    const Floats l1 = m[1] * i0, l2 = m[2] * i0;
    const Floats i1 = one / larger(m[3] + two - l1 * m[1], ridge);
    const Floats rest = m[4] - l1 * m[2], l3 = rest * i1;
    const Floats i2 = one / larger(m[5] + ridge - l2 * m[2] - l3 * rest, least);
    const Right y1 = p[1] - l1 * p[0], y2 = p[2] - l2 * p[0] - l3 * y1;
    q[2] = i2 * y2;
    q[1] = i1 * y1 - l3 * q[2];
    q[0] = i0 * p[0] - l1 * q[1] - l2 * q[2];
}

// Arc cosine on SIMD lanes. Included after lanes_*.h, with TSPACE_LANES set to their namespace.

/// Computes acos of three cosines, rounded to float: the bits of the C library's double acos rounded to float (compared
/// for every float). Three at a time, interleaved, because each step depends on the previous one.
///
/// y = min(c^2, (1 - |c|) / 2), which is at most 1/4, and s = sqrt(y) is |c| or, from 1/2 on, the sine of half the
/// angle. asin(s) = s + s y P(y). Then acos(c) is pi/2 -+ asin(s), or 2 asin(s), or pi - 2 asin(s).
inline void arcCosines(const Floats (&cosines)[3], Floats (&angles)[3]) {
    // Minimax, of degree 11: the error of y P(y) is below 2^-55.
    constexpr double kHighest = 0x1.030c9deb668f4p-5;
    constexpr double kCoefficients[] = {-0x1.026fe5933eb78p-6, 0x1.3aea7222cb789p-6, 0x1.b3bf2c44e47e8p-8,
                                        0x1.8dc3f723da505p-7,  0x1.c728512876979p-7, 0x1.1c697e5b02bbap-6,
                                        0x1.6e8a21d60a180p-6,  0x1.f1c72a0b08729p-6, 0x1.6db6db4a71a6fp-5,
                                        0x1.333333335f5c3p-4,  0x1.555555555543cp-3};
    constexpr std::size_t kParts = 3 * kDoubleParts;
    const Doubles half = broadcastDouble(0.5);
    Doubles x[kParts], y[kParts], p[kParts];
    for (std::size_t i = 0; i < kParts; ++i) {
        const Floats c = larger(broadcast(-1.0f), smaller(broadcast(1.0f), cosines[i / kDoubleParts]));
        x[i] = part(c, i % kDoubleParts);
        const Doubles a = absolute(x[i]);
        y[i] = smaller(a * a, half - half * a);
        p[i] = broadcastDouble(kHighest);
    }
    for (const double coefficient : kCoefficients) {
        const Doubles k = broadcastDouble(coefficient);
        for (std::size_t i = 0; i < kParts; ++i) p[i] = p[i] * y[i] + k;
    }
    const Doubles quarter = broadcastDouble(0x1.921fb54442d18p+0);
    for (std::size_t i = 0; i < kParts; ++i) {
        const DoubleMask steep = absolute(x[i]) > half;
        const Doubles s = squareRoot(y[i]);
        const Doubles arc = s + s * y[i] * p[i];
        const Doubles turned = withSignOf(negateUnless(steep, arc + keepWhere(steep, arc)), x[i]);
        x[i] = quarter - keepWhere(steep, withSignOf(quarter, x[i])) + turned;
    }
    for (std::size_t k = 0; k < 3; ++k) angles[k] = join(x + k * kDoubleParts);
}

}  // namespace tspace::simd::TSPACE_LANES
