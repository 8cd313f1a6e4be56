// SPDX-License-Identifier: MIT
// A step of the method `best`: what is interpolated along an edge, integrated, must be that edge,
//   (J_i + J_j) d / 2 = e,
// as far as one change of J explains that. J = (dP/du, dP/dv) is that of each group before the step, so the order of
// groups does not matter. For both edges of each corner, with l, d and w as in quadratic_recovery_kernel.h:
//   r = 2 l - flat(J_j d) - J_i d        flat: laid into the plane across N_i, its length kept
//   M += w d d^T,  R += w d r^T,  E += w r.r
// Then per group, m being the share that the robust mean has in it already:
//   dJ = M^-1 R,  explained = R : dJ,  left = E - explained
//   f = 1/2 (1 - m) / ((1 + (2 left / explained)^2) (1 + |dJ_u|^2 / |J_u|^2 + |dJ_v|^2 / |J_v|^2))
//   J' = J + f dJ
// 1/2, since the other end moves too. What is left is noise or a kink: nothing to follow. The last factor is for edges
// that hardly span the plane: T turns by atan(1/4), 14 degrees, at most.
//
// Based on: the trapezoid rule. Included once per CPU, after lanes_*.h and with TSPACE_LANES set to its namespace.
#pragma once

#include "core/tangents/estimators/estimator_lanes.h"

namespace tspace::estimators::TSPACE_LANES {

namespace {

constexpr float kLongestArc = 2.0f;  // an edge that climbs more than 60 degrees from the tangent plane is no arc in it
constexpr float kSmallestDeterminant = 1e-6f;
constexpr float kLeftWeight = 2.0f;  // the 2 before left: found by trying values (docs/accuracy.md)

/// How much longer than the edge `e` the arc is between ends with these normals; the same from either end.
inline Floats arcLengthOf(Vectors a, Vectors b, Vectors e, Floats square) {
    const Floats turn = dot(b, e) - dot(a, e);
    return broadcast(1.0f) + quotient(turn * turn, square) * broadcast(1.0f / 24);
}

/// Edge `e`, seen from the end with this plane, as an arc in the plane. Turning the edge over turns the
/// result over.
inline Flat arcOf(const Plane& here, Vectors e, Floats square, Floats arc_length) {
    const Flat p = here.flatten(e);
    const Floats flat = dot(p, p);
    const Floats factor = smaller(squareRoot(square / flat), broadcast(kLongestArc)) * arc_length;
    return keep(isFinite(factor), factor) * p;
}

/// A vector laid into the plane, its length kept.
inline Flat laidInto(const Plane& here, Vectors v) {
    const Flat p = here.flatten(v);
    const Floats stretch = smaller(squareRoot(dot(v, v) / dot(p, p)), broadcast(kLongestArc));
    return keep(isFinite(stretch), stretch) * p;
}

inline Floats lengthOf(Flat v, Floats factor) {
    const Floats length = squareRoot(dot(v, v)) * factor;
    return keep(isFinite(length), length);
}

/// An edge, and what J at both its ends gives for it.
struct Edge {
    Vectors e;
    Floats square, arc_length, u, v, weight;
    Vectors along[2];  ///< J d at its first and second end
    Mask counts;

    Edge(const TriangleEdges& t, std::size_t k, const Plane& first, const Plane& second, const Vectors (&first_j)[2],
         const Vectors (&second_j)[2], Floats size, Mask is_known)
        : e(t.edge[k]),
          square(t.square[k]),
          arc_length(arcLengthOf(first.n, second.n, e, square)),
          u(t.u[k]),
          v(t.v[k]),
          weight(quotient(size, square)),
          along{u * first_j[0] + v * first_j[1], u * second_j[0] + v * second_j[1]},
          counts(is_known) {}
};

/// What an edge adds at one of its ends: turning the edge over changes nothing.
struct Residual {
    Floats weight;
    Flat r;

    Residual(const Edge& edge, const Plane& here, std::size_t end) {
        const Flat arc = arcOf(here, edge.e, edge.square, edge.arc_length);
        const Flat there = laidInto(here, edge.along[1 - end]), twice = arc + arc;
        r = twice - there - here.flatten(edge.along[end]);
        const Mask sound = edge.counts & isFinite(dot(r, r));
        r = {keep(sound, r.x), keep(sound, r.y)};
        weight = keep(sound, edge.weight);
    }
};

void addEdgeStep(const VertexSource& source, const std::uint32_t* vertices, const std::uint32_t* groups,
                 const float* from, std::size_t count, float* rows) {
    constexpr std::size_t kStep = 12 * kStepRows, kStride = kStepFloats * sizeof(float);
    const auto* const bytes = reinterpret_cast<const std::byte*>(from);
    for (std::size_t g = 0; g < count; g += kWidth) {
        const std::uint32_t* const v = vertices + 3 * g;
        const bool exact = namesLast(v, source.last_vertex);
        const TriangleEdges t(source, v, exact);
        Vectors normal[3], j[3][2];
        Mask has[3];
        for (std::size_t k = 0; k < 3; ++k) {
            normal[k] = gatherVectors(source.normals, source.normal_stride, v + k, exact);
            j[k][0] = gatherVectors(bytes, kStride, groups + 3 * g + k, false);
            j[k][1] = gatherVectors(bytes + kStride / 2, kStride, groups + 3 * g + k, false);
            has[k] = (dot(j[k][0], j[k][0]) > zero()) & (dot(j[k][1], j[k][1]) > zero());
        }
        const Plane planes[3] = {Plane(normal[0]), Plane(normal[1]), Plane(normal[2])};
        const Floats size = squareRoot(broadcast(0.5f) * t.double_area);
        const auto edgeOf = [&](std::size_t k) {
            const std::size_t next = (k + 1) % 3;
            return Edge(t, k, planes[k], planes[next], j[k], j[next], size, has[k] & has[next]);
        };
        const Edge edges[3] = {edgeOf(0), edgeOf(1), edgeOf(2)};
        for (std::size_t k = 0; k < 3; ++k) {
            const Edge &from_here = edges[k], &to_here = edges[(k + 2) % 3];
            const Residual a(from_here, planes[k], 0), b(to_here, planes[k], 1);
            const Floats au = a.weight * from_here.u, av = a.weight * from_here.v;
            const Floats bu = b.weight * to_here.u, bv = b.weight * to_here.v;
            float* const at = rows + kStep * g + 4 * kStepRows * k;
            storeRows<kStep>(at, au * from_here.u + bu * to_here.u, au * from_here.v + bu * to_here.v,
                             av * from_here.v + bv * to_here.v, a.weight * dot(a.r, a.r) + b.weight * dot(b.r, b.r));
            const Flat r0 = au * a.r + bu * b.r, r1 = av * a.r + bv * b.r;
            storeRows<kStep>(at + 4, r0.x, r0.y, r1.x, r1.y);
        }
    }
}

void finishEdgeStep(float* sums, const float* normals, const float* from, std::size_t count) {
    constexpr std::size_t kStep = 4 * kStepRows;
    const Floats one = broadcast(1.0f), half = broadcast(0.5f);
    for (std::size_t g = 0; g < count; g += kWidth) {
        float* const at = sums + kStep * g;
        Floats uu, uv, vv, energy, m, unused;
        Flat r0, r1;
        Vectors n, ju, jv;
        loadRows<4>(normals + 4 * g, n.x, n.y, n.z, unused);
        loadRows<kStep>(at, uu, uv, vv, energy);
        loadRows<kStep>(at + 4, r0.x, r0.y, r1.x, r1.y);
        loadRows<kStepFloats>(from + kStepFloats * g, ju.x, ju.y, ju.z, m);
        loadRows<kStepFloats>(from + kStepFloats * g + 4, jv.x, jv.y, jv.z, unused);
        const Plane plane(n);
        // UVs scaled as for the fit: M has ones on its diagonal.
        const Floats least = broadcast(kSmallestDeterminant) * larger(uu, vv);
        const Floats s = one / squareRoot(larger(uu, least)), t = one / squareRoot(larger(vv, least));
        const Floats m0 = uu * s * s, m1 = uv * s * t, m2 = vv * t * t, product = m0 * m2;
        const Floats inverse = one / larger(product - m1 * m1, broadcast(kSmallestDeterminant) * product);
        const Flat p0 = s * r0, p1 = t * r1;
        const Flat a0 = inverse * (m2 * p0 - m1 * p1), a1 = inverse * (m0 * p1 - m1 * p0);
        const Floats explained = dot(p0, a0) + dot(p1, a1), left = larger(energy - explained, zero());
        const Flat u = plane.flatten(ju), v = plane.flatten(jv), du = s * a0, dv = t * a1;
        const Floats turn = dot(du, du) / dot(u, u) + dot(dv, dv) / dot(v, v);
        const Floats doubt = broadcast(kLeftWeight) * (left / explained);
        // Not a number where there is nothing to explain.
        const Floats f = half * (one - m) / ((one + doubt * doubt) * (one + turn));
        const Flat new_u = u + f * du, new_v = v + f * dv;
        const Vectors x = unit(plane.raise(unit(new_u))), y = unit(plane.raise(unit(new_v)));
        const Mask sound = (f > zero()) & (dot(x, x) > zero()) & (dot(y, y) > zero());
        storeRows<kStep>(at, keep(sound, x.x), keep(sound, x.y), keep(sound, x.z), keep(sound, lengthOf(new_u, one)));
        storeRows<kStep>(at + 4, keep(sound, y.x), keep(sound, y.y), keep(sound, y.z),
                         keep(sound, lengthOf(new_v, one)));
    }
}

}  // namespace

}  // namespace tspace::estimators::TSPACE_LANES
