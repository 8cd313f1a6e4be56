// SPDX-License-Identifier: MIT
// The method `best`: around each vertex the surface is modeled as a quadratic map of the UVs,
//   P = P0 + J d + H(d, d) / 2,
// fitted to the edges at the vertex; J contains dP/du and dP/dv. The fit estimates its own reliability: the larger its
// quadratic part is, or the less of the edges it explains, the more that part is damped (a ridge), and the more of a
// robust mean of the triangles' tangents is blended in.
//
// For both edges of each corner, with d = (u, v) and e the differences in UVs and in space, N and N' the unit normals
// of its two ends, and A the area of the triangle:
//   p = e projected perpendicular to N,  l = p |e|/|p| (1 + c^2/24),  c = (N' - N).e/|e|
//                                            l: the edge as an arc, mapped to the tangent plane
//   w = sqrt(A) / |e|^2,  f = (u^2/2, u v, v^2/2)
//   M += w d d^T,  C += w d f^T,  Q += w f f^T,  R += w d l^T,  P += w f l^T,  L += w l.l
//   b += g/|g| A^2 / (|e1|^2 + |e2|^2 + |e3|^2)^(3/4)
//                                            g: dP/du, or dP/dv, of the triangle
// Then per group, with UVs scaled so that the diagonal of M is 1:
//   q(k) = (Q - C^T M^-1 C + k D)^-1 (P - C^T M^-1 R),  J(k) = M^-1 (R - C q(k)),  D = 0.3 trace(Q) diag(1, 2, 1)
//   from k0 = 0.0003:  bend = (energy of the quadratic part) / (energy of the linear part)
//                      miss = (what the fit leaves unexplained) / (what its quadratic part explains)
//   k = k0 + 512 bend^2 + 5 miss bend / (bend + 0.001),  m = (k - k0) / (k - k0 + 2)
//   T = unit((1 - m) unit(J(k)_u) + m unit(b))
//
// Normals are used twice: for the tangent plane, and for the ratio of arc to chord length.
//
// Based on: Zhang and Naga, "A New Finite Element Gradient Recovery Method: Superconvergence Property", 2005
// (polynomial preserving recovery), here on a surface, with sums over triangles instead of lists of
// neighbors. The ridge, the two tests and the blending are tspace's own; docs/concepts/methods/best.md has the
// measurements.
//
// The optional refinement steps are at the end of the file. Included once per instruction set, after lanes_*.h and
// with TSPACE_LANES set to its namespace.
#pragma once

#include "core/tangents/estimators/estimator_lanes.h"

namespace tspace::estimators::TSPACE_LANES {
namespace {

// maximum factor by which a vector in the tangent plane is lengthened: an edge at more than 60 degrees to the plane is
// not an arc in it
constexpr float kLongestArc = 2.0f;
constexpr float kSmallestDeterminant = 1e-6f;
constexpr float kLeftWeight = 2.0f;  // the factor 2 of `left`, which was tuned (docs/evidence/accuracy.md)

/// Returns the ratio of arc length to edge length, given the normals at the ends; symmetric in the ends.
inline Floats arcLengthOf(Vectors a, Vectors b, Vectors e, Floats square) {
    const Floats turn = dot(b, e) - dot(a, e);
    return broadcast(1.0f) + quotient(turn * turn, square) * broadcast(1.0f / 24);
}

/// Returns edge `e`, from the viewpoint of the end with this plane, as an arc in the plane. Reversing the edge reverses
/// the result.
inline Flat arcOf(const Plane& here, Vectors e, Floats square, Floats arc_length) {
    const Flat p = here.flatten(e);
    const Floats flat = dot(p, p);
    const Floats factor = smaller(squareRoot(square / flat), broadcast(kLongestArc)) * arc_length;
    return keep(isFinite(factor), factor) * p;
}

/// Returns a vector rotated into the plane, with its length unchanged.
inline Flat rotatedInto(const Plane& here, Vectors v) {
    const Flat p = here.flatten(v);
    const Floats stretch = smaller(squareRoot(dot(v, v) / dot(p, p)), broadcast(kLongestArc));
    return keep(isFinite(stretch), stretch) * p;
}

inline Floats lengthOf(Flat v, Floats factor) {
    const Floats length = squareRoot(dot(v, v)) * factor;
    return keep(isFinite(length), length);
}

constexpr float kRidge = 3e-4f;  // k0: small enough to have no effect on smooth surfaces
constexpr float kBendWeight = 512.0f;
constexpr float kMissWeight = 5.0f, kMissLimit = 3.0f, kSmallBend = 1e-3f;
constexpr float kMixAt = 2.0f;  // ridge at which the fit and the mean have equal weights
constexpr float kMostRidge = 1e6f;
// Share of the energy that rounding may explain. Sums have rounding errors of about 1e-7. If the edges do not determine
// the quadratic part (few triangles), such errors alone explain 1e-7^2 / k0, or 3e-11, of the energy. On a smooth
// surface of 512 x 512 cells, the quadratic part explains 1e-7 of it.
constexpr float kRoundingShare = 1e-9f;
// The ridge weights second derivatives like their Frobenius norm: uu, uv, vv as 1, 2, 1. kRidgeShare is the share that
// Q's entries for uu and vv have in trace(Q) if edges point in all directions. Q's own diagonal is unsuitable: if four
// edges form a cross, which leaves uv undetermined, it hardly damps uv, and u^2 v^2 would explain too much.
constexpr float kRidgeShare = 0.3f;

constexpr std::size_t kFitRows = 7;

// -- contributions of a triangle --

/// Terms that an edge adds to the sums of both its ends, except for signs.
struct EdgeMoments {
    Floats weight;
    Floats du, dv;              ///< w d
    Floats uu, uv, vv;          ///< w d d^T
    Floats f0, f1, f2;          ///< w u^2/2, w u v, w v^2/2
    Floats c0, c1, c2, c3;      ///< w u^3/2, w u^2 v/2, w u v^2/2, w v^3/2
    Floats q0, q1, q2, q3, q4;  ///< w u^4/4, w u^3 v/2, w u^2 v^2/4, w u v^3/2, w v^4/4

    EdgeMoments(Floats w, Floats u, Floats v) : weight(w) {
        const Floats half = broadcast(0.5f);
        du = w * u;
        dv = w * v;
        uu = du * u;
        uv = du * v;
        vv = dv * v;
        f0 = half * uu;
        f1 = uv;
        f2 = half * vv;
        c0 = f0 * u;
        c1 = f0 * v;
        c2 = f2 * u;
        c3 = f2 * v;
        const Floats half_u = half * u, half_v = half * v;
        q0 = c0 * half_u;
        q1 = c0 * v;
        q2 = c1 * half_v;
        q3 = c3 * u;
        q4 = c3 * half_v;
    }
};

inline void storeCorner(float* at, const EdgeMoments& leaving, const EdgeMoments& arriving, Flat out, Flat in,
                        Flat robust_u, Flat robust_v, Floats robust_weight) {
    constexpr std::size_t kStep = 12 * kFitRows;
    const EdgeMoments &a = leaving, &b = arriving;
    storeRows<kStep>(at, a.uu + b.uu, a.uv + b.uv, a.vv + b.vv, a.c0 - b.c0);
    storeRows<kStep>(at + 4, a.c1 - b.c1, a.c2 - b.c2, a.c3 - b.c3, a.q0 + b.q0);
    storeRows<kStep>(at + 8, a.q1 + b.q1, a.q2 + b.q2, a.q3 + b.q3, a.q4 + b.q4);
    const Flat r0 = a.du * out + b.du * in, r1 = a.dv * out + b.dv * in;
    storeRows<kStep>(at + 12, r0.x, r0.y, r1.x, r1.y);
    const Flat p0 = a.f0 * out - b.f0 * in, p1 = a.f1 * out - b.f1 * in, p2 = a.f2 * out - b.f2 * in;
    storeRows<kStep>(at + 16, p0.x, p0.y, p1.x, p1.y);
    storeRows<kStep>(at + 20, p2.x, p2.y, robust_u.x, robust_u.y);
    const Floats energy = a.weight * dot(out, out) + b.weight * dot(in, in);
    storeRows<kStep>(at + 24, robust_v.x, robust_v.y, energy, robust_weight);
}

inline void addRecoveryOf(const VertexSource& source, const std::uint32_t* vertices, bool exact, float* rows) {
    const Triangles t(source, vertices, exact);
    Vectors normals[3];
    for (std::size_t k = 0; k < 3; ++k)
        normals[k] = gatherVectors(source.normals, source.normal_stride, vertices + k, exact);
    const Plane planes[3] = {Plane(normals[0]), Plane(normals[1]), Plane(normals[2])};
    const Floats size = squareRoot(broadcast(0.5f) * t.double_area), robust = t.robustWeight();
    const EdgeMoments moments[3] = {{quotient(size, t.square[0]), t.u[0], t.v[0]},
                                    {quotient(size, t.square[1]), t.u[1], t.v[1]},
                                    {quotient(size, t.square[2]), t.u[2], t.v[2]}};
    const Floats arc_lengths[3] = {arcLengthOf(planes[0].n, planes[1].n, t.edge[0], t.square[0]),
                                   arcLengthOf(planes[1].n, planes[2].n, t.edge[1], t.square[1]),
                                   arcLengthOf(planes[2].n, planes[0].n, t.edge[2], t.square[2])};
    const Vectors mean_u = quotient(robust, squareRoot(dot(t.along_u, t.along_u))) * t.along_u;
    const Vectors mean_v = quotient(robust, squareRoot(dot(t.along_v, t.along_v))) * t.along_v;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t previous = (k + 2) % 3;
        const Plane& here = planes[k];
        const Flat out = arcOf(here, t.edge[k], t.square[k], arc_lengths[k]);
        const Flat in = arcOf(here, t.edge[previous], t.square[previous], arc_lengths[previous]);
        storeCorner(rows + 4 * kFitRows * k, moments[k], moments[previous], out, in, here.flatten(mean_u),
                    here.flatten(mean_v), robust);
    }
}

void addRecovery(const VertexSource& source, const std::uint32_t* vertices, std::size_t count, float* rows) {
    for (std::size_t t = 0; t < count; t += kWidth) {
        const std::uint32_t* const v = vertices + 3 * t;
        addRecoveryOf(source, v, includesLast(v, source.last_vertex), rows + 12 * kFitRows * t);
    }
}

// -- results of a group --

/// Sums of kWidth groups, with UVs scaled so that the diagonal of M is 1.
struct Fit {
    Floats scale_u, scale_v;
    Floats m0, m1, m2;  ///< matrix M
    Floats c[2][3];     ///< matrix C
    Floats q[6];        ///< matrix Q: 00 01 02 11 12 22
    Flat r[2], p[3];    ///< R and P
    Flat robust_u, robust_v;
    Floats energy;  ///< L

    explicit Fit(const float* at) {
        constexpr std::size_t kStep = 4 * kFitRows;
        Floats c0, c1, c2, c3, q0, q1, q2, q3, q4, unused;
        loadRows<kStep>(at, m0, m1, m2, c0);
        loadRows<kStep>(at + 4, c1, c2, c3, q0);
        loadRows<kStep>(at + 8, q1, q2, q3, q4);
        loadRows<kStep>(at + 12, r[0].x, r[0].y, r[1].x, r[1].y);
        loadRows<kStep>(at + 16, p[0].x, p[0].y, p[1].x, p[1].y);
        loadRows<kStep>(at + 20, p[2].x, p[2].y, robust_u.x, robust_u.y);
        loadRows<kStep>(at + 24, robust_v.x, robust_v.y, energy, unused);
        // Limits the scale factors: a missing UV direction must not be scaled up to pure noise.
        const Floats least = broadcast(kSmallestDeterminant) * larger(m0, m2), one = broadcast(1.0f);
        const Floats s = one / squareRoot(larger(m0, least)), t = one / squareRoot(larger(m2, least));
        const Floats ss = s * s, st = s * t, tt = t * t;
        scale_u = s;
        scale_v = t;
        m0 = m0 * ss;
        m1 = m1 * st;
        m2 = m2 * tt;
        c0 = c0 * ss * s;
        c1 = c1 * ss * t;
        c2 = c2 * s * tt;
        c3 = c3 * tt * t;
        c[0][0] = c0;
        c[0][1] = c1 + c1;
        c[0][2] = c2;
        c[1][0] = c1;
        c[1][1] = c2 + c2;
        c[1][2] = c3;
        q2 = q2 * ss * tt;
        q[0] = q0 * ss * ss;
        q[1] = q1 * ss * st;
        q[2] = q2;
        q[3] = broadcast(4.0f) * q2;
        q[4] = q3 * st * tt;
        q[5] = q4 * tt * tt;
        r[0] = s * r[0];
        r[1] = t * r[1];
        p[0] = ss * p[0];
        p[1] = st * p[1];
        p[2] = tt * p[2];
    }
};

/// Normal equations after J was eliminated.
struct Reduced {
    Floats i0, i1, i2;  ///< M^-1
    Flat linear[2];     ///< M^-1 R, which is J of a fit without quadratic part
    Floats s[6];        ///< Q - C^T M^-1 C
    Floats ridge;       ///< factor of k on the diagonal of s, and half of the factor for its middle entry
    Flat p[3];          ///< P - C^T M^-1 R

    explicit Reduced(const Fit& f) {
        const Floats product = f.m0 * f.m2;
        const Floats determinant = larger(product - f.m1 * f.m1, broadcast(kSmallestDeterminant) * product);
        const Floats inverse = broadcast(1.0f) / determinant;
        i0 = f.m2 * inverse;
        i1 = minus(f.m1 * inverse);
        i2 = f.m0 * inverse;
        linear[0] = i0 * f.r[0] + i1 * f.r[1];
        linear[1] = i1 * f.r[0] + i2 * f.r[1];
        ridge = broadcast(kRidgeShare) * (f.q[0] + f.q[3] + f.q[5]);
        std::size_t n = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const Floats a = i0 * f.c[0][i] + i1 * f.c[1][i], b = i1 * f.c[0][i] + i2 * f.c[1][i];
            for (std::size_t j = i; j < 3; ++j, ++n) s[n] = f.q[n] - (a * f.c[0][j] + b * f.c[1][j]);
            p[i] = f.p[i] - (f.c[0][i] * linear[0] + f.c[1][i] * linear[1]);
        }
    }
};

struct Solution {
    Flat q[3], j[2];

    Solution(const Fit& f, const Reduced& m, Floats k) {
        solveRidged(m.s, k * m.ridge, m.p, q);
        Flat r0 = f.r[0], r1 = f.r[1];
        for (std::size_t i = 0; i < 3; ++i) {
            r0 = r0 - f.c[0][i] * q[i];
            r1 = r1 - f.c[1][i] * q[i];
        }
        j[0] = m.i0 * r0 + m.i1 * r1;
        j[1] = m.i1 * r0 + m.i2 * r1;
    }
};

/// Doubt about the quadratic part, by cause.
struct Doubt {
    Floats shape;     ///< doubt because the quadratic part is large, or explains little
    Floats rounding;  ///< doubt because the quadratic part is so small that it may be rounding noise
};

inline Doubt doubtIn(const Fit& f, const Reduced& m, const Solution& s) {
    const Floats two = broadcast(2.0f);
    const Floats bent = f.q[0] * dot(s.q[0], s.q[0]) + f.q[3] * dot(s.q[1], s.q[1]) + f.q[5] * dot(s.q[2], s.q[2]);
    const Floats straight = f.m0 * dot(s.j[0], s.j[0]) + two * f.m1 * dot(s.j[0], s.j[1]) + f.m2 * dot(s.j[1], s.j[1]);
    const Floats bend = bent / straight;
    const Floats held =
        m.ridge * dot(s.q[0], s.q[0]) + (m.ridge + m.ridge) * dot(s.q[1], s.q[1]) + m.ridge * dot(s.q[2], s.q[2]);
    const Floats explained = dot(s.q[0], m.p[0]) + dot(s.q[1], m.p[1]) + dot(s.q[2], m.p[2]) + broadcast(kRidge) * held;
    const Floats left = f.energy - dot(f.r[0], m.linear[0]) - dot(f.r[1], m.linear[1]) - explained;
    // smaller() turns a NaN into kMissLimit; the doubt due to rounding then dominates.
    const Floats miss = smaller(larger(left, zero()) / explained, broadcast(kMissLimit));
    const Floats doubt = broadcast(kBendWeight) * (bend * bend) +
                         broadcast(kMissWeight) * miss * (bend / (bend + broadcast(kSmallBend)));
    const Floats noise = broadcast(kRoundingShare) * (f.energy / explained), most = broadcast(kMostRidge);
    return {smaller(doubt, most), smaller(noise * noise, most)};
}

/// Returns the direction of a fitted derivative, blended with the robust mean. If one of them has no direction, the
/// other is used.
inline Vectors directionOf(const Plane& plane, Flat fitted, Flat robust, Floats share) {
    const Flat a = unit(fitted), b = unit(robust);
    const Floats one = broadcast(1.0f);
    const Floats m = select(dot(b, b) > zero(), select(dot(a, a) > zero(), share, one), zero());
    return unit(plane.raise(unit((one - m) * a + m * b)));
}

void finishRecovery(float* sums, const float* normals, std::size_t count) {
    constexpr std::size_t kStep = 4 * kFitRows;
    for (std::size_t g = 0; g < count; g += kWidth) {
        float* const at = sums + kStep * g;
        Floats unused;
        Vectors n;
        loadRows<4>(normals + 4 * g, n.x, n.y, n.z, unused);
        const Plane plane(n);
        const Fit fit(at);
        const Reduced reduced(fit);
        const Doubt doubt = doubtIn(fit, reduced, Solution(fit, reduced, broadcast(kRidge)));
        const Solution best(fit, reduced, broadcast(kRidge) + doubt.shape + doubt.rounding);
        const Floats share = doubt.shape / (doubt.shape + broadcast(kMixAt));
        const Vectors s = directionOf(plane, best.j[0], fit.robust_u, share);
        const Vectors t = directionOf(plane, best.j[1], fit.robust_v, share);
        storeRows<kStep>(at, s.x, s.y, s.z, lengthOf(best.j[0], fit.scale_u));
        storeRows<kStep>(at + 4, t.x, t.y, t.z, lengthOf(best.j[1], fit.scale_v));
        // the share of the robust mean, for the refinement steps
        storeRows<kStep>(at + 8, share, zero(), zero(), zero());
    }
}

// -- refinement step --
//
// Trapezoid rule: the interpolated derivative along an edge, integrated, must equal that edge,
//   (J_i + J_j) d / 2 = e,
// as far as a single change of J can explain that. J = (dP/du, dP/dv) of each group before the step, so the order of
// groups does not matter. For both edges of each corner, with l, d and w as above:
//   r = 2 l - flat(J_j d) - J_i d        flat: rotated into the plane perpendicular to N_i, with the same length
//   M += w d d^T,  R += w d r^T,  E += w r.r
// Then per group, where m is the share of the robust mean in its tangent:
//   dJ = M^-1 R,  explained = R : dJ,  left = E - explained
//   f = 1/2 (1 - m) / ((1 + (2 left / explained)^2) (1 + |dJ_u|^2 / |J_u|^2 + |dJ_v|^2 / |J_v|^2))
//   J' = J + f dJ
// The factor 1/2 accounts for the change at the other end. A residual that no change of J explains is noise or a kink.
// The last factor limits the effect of edges that barely span the plane: T rotates by at most atan(1/4), 14 degrees.

/// Edges, and their predictions by J at both ends.
struct Edge {
    Vectors e;
    Floats square, arc_length, u, v, weight;
    Vectors along[2];  ///< J d at the first and at the second end
    Mask counts;

    Edge(const TriangleEdges& t, std::size_t k, const Plane& first, const Plane& second, const Vectors (&first_j)[2],
         const Vectors (&second_j)[2], Floats size, Mask is_known)
        : e(t.edge[k]), square(t.square[k]), arc_length(arcLengthOf(first.n, second.n, e, square)), u(t.u[k]),
          v(t.v[k]),
          weight(quotient(size, square)), along{u * first_j[0] + v * first_j[1], u * second_j[0] + v * second_j[1]},
          counts(is_known) {}
};

/// Terms that an edge adds at one of its ends; they are equal for both directions of the edge.
struct Residual {
    Floats weight;
    Flat r;

    Residual(const Edge& edge, const Plane& here, std::size_t end) {
        const Flat arc = arcOf(here, edge.e, edge.square, edge.arc_length);
        const Flat there = rotatedInto(here, edge.along[1 - end]), twice = arc + arc;
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
        const bool exact = includesLast(v, source.last_vertex);
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
        // Scales UVs as for the fit, so that the diagonal of M is 1.
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
        // NaN if the edges leave no residual to explain; the group is then unchanged.
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

Estimator quadraticRecovery() { return {kFitRows, addRecovery, finishRecovery, addEdgeStep, finishEdgeStep}; }

}  // namespace tspace::estimators::TSPACE_LANES