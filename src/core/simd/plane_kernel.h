// SPDX-License-Identifier: MIT
// Directions and planes on lanes. Included after lanes_*.h, with TSPACE_LANES set to its namespace.
#pragma once

#include "core/simd/vectors_kernel.h"

namespace tspace::simd::TSPACE_LANES {

inline Mask isFinite(Floats a) { return absolute(a) < broadcast(__builtin_huge_valf()); }
inline Floats keep(Mask m, Floats a) { return select(m, a, zero()); }
inline Vectors keep(Mask m, Vectors v) { return {keep(m, v.x), keep(m, v.y), keep(m, v.z)}; }
/// a / b, and 0 where b is not above zero or the quotient is not finite.
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

/// Zero where a vector has no direction.
template <class Vector>
inline Vector unit(Vector v) {
    const Floats square = dot(v, v), scale = broadcast(1.0f) / squareRoot(square);
    return keep((square > zero()) & isFinite(square) & isFinite(scale), scale * v);
}

/// The unit normal, with -0 as +0; the z axis where a normal has no direction.
inline Vectors unitNormal(Vectors n) {
    const Vectors u = unit(n);
    const Mask none = !(dot(u, u) > zero());
    return {u.x + zero(), u.y + zero(), select(none, broadcast(1.0f), u.z) + zero()};
}

/// A normal with two axes in the plane across it.
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

/// Solves three equations by Cholesky's way (L D L^T). m: 00 01 02 11 12 22, to whose diagonal `ridge`, twice that, and
/// `ridge` are added: this keeps the pivots positive, but for rounding.
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

}  // namespace tspace::simd::TSPACE_LANES
