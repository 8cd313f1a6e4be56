// SPDX-License-Identifier: MIT
// Kernels of BestKernels: the normal of the quadratic surface through the edges around a point, or, if the edges look
// like noise or a bevel, the mean by angle * area; in between a blend. Uses sums in single precision, so no list of the
// corners around a point is needed. Below, sharp normals are the means by `max`, and robust normals those by angle *
// area.
// Based on: Zhang & Naga, "A New Finite Element Gradient Recovery Method: Superconvergence Property", 2005 (a quadratic
// fit around each point, here of the height above a plane; a ridge keeps it solvable); Max, "Weights for Computing
// Vertex Normals from Facet Normals", 1999 (the plane).
//
// A fit follows noise, and across a bevel it bends flat faces. Both are distinguished from a smooth surface by an edge
// e between normals m and n: on a circle, and nearly on all surfaces that are smooth at the mesh's scale, dot(e, m + n)
// is 0.
//
// Included once per instruction set, after lanes_*.h and with TSPACE_LANES set to its namespace. Each lane is one
// triangle or one point.
#pragma once

#include "core/normals/face_terms.h"
#include "core/simd/vectors_kernel.h"

namespace tspace::smooth::TSPACE_LANES {

using namespace simd::TSPACE_LANES;

namespace {

// Values of each doubt at which both inputs of the blend have equal weights. They were tuned on analytic surfaces with
// and without noise and on bevels (docs/evidence/accuracy.md).
constexpr double kNoise = 0.45;  // share of the edge bend that no normal explains
constexpr double kKink = 1.5;    // ratio of the misfit of the sharp normals to that of the robust ones, for large faces
// Ratio of the bend misfit of the sharp normals to that of the robust ones: as kKink, but dominated by short edges. A
// flat cap that is triangulated as a fan from a vertex of its rim has no edge that distinguishes it from a dome; its
// neighbors, the edges of a fillet, do.
constexpr double kFillet = 1.3;
// Bend, in radians, from which kKink and kFillet have full effect (bend: angle by which the longest edge would bend
// with the curvature of the most bent edge). In fine meshes both misfits are small, and their ratio is random.
constexpr double kBent = 1.25;
// Bend (as for kBent) times the sine of the angle between the sharp and the robust normal.
constexpr double kJump = 2.5;
constexpr double kTurn = 0.8;     // twice the sine of half the angle between the sharp normals at an edge's ends
constexpr double kSpread = 0.42;  // sine of the angle between the fitted normal and the robust mean

// Ridge regularization relative to the quadratic part: enough for rings with too few edges, and negligible elsewhere.
// It weights second derivatives by their Frobenius norm, as the method `best` for tangents does
// (tangents/estimators/quadratic_recovery_kernel.h).
constexpr double kFitRidge = 3e-4, kFitRidgeShare = 0.3;

constexpr double kNoTrust = 1e12;  // maximum doubt, large enough that a blend has exactly the bits of one of its inputs

constexpr std::size_t kFitStep = 12 * kFitRows;  // floats per triangle

// Values at which a refinement step has half of its effect, tuned on the same meshes as kNoise.
constexpr double kStepLeft = 0.5;          // ratio of the unexplained to the explained change of the normal
constexpr double kStepNoise = 1.0 / 30.0;  // ratio of the unexplained change to the bend of the edges

constexpr std::size_t kStepStride = 12 * kStepRows;  // floats per triangle

inline Vectors gatherNormals(const Vec3* normals, const std::uint32_t* points) {
    return gatherVectors(reinterpret_cast<const std::byte*>(normals), sizeof(Vec3), points, false);
}

/// Edges of triangles: edge k goes from corner k to corner k + 1. All values of an ignored triangle are zero.
struct Edges {
    Vectors edge[3];
    Floats square[3];
    Vectors turn;  ///< normal times twice the area

    Edges(const BestSource& source, const std::uint32_t* vertices) {
        const bool exact = includesLast(vertices, source.faces.last_vertex);
        const Floats scale = broadcast(source.scale);
        Vectors p[3];
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = scale * gatherVectors(source.faces.positions, source.faces.stride, vertices + k, exact);
        for (std::size_t k = 0; k < 3; ++k) edge[k] = p[(k + 1) % 3] - p[k];
        turn = cross(edge[0], p[2] - p[0]);
        const Floats area = dot(turn, turn);
        Mask sound = (area > zero()) & isFinite(area);
        for (std::size_t k = 0; k < 3; ++k) {
            square[k] = dot(edge[k], edge[k]);
            sound = sound & isFinite(square[k]);
        }
        if (all(sound)) [[likely]]
            return;
        turn = keep(sound, turn);
        for (std::size_t k = 0; k < 3; ++k) {
            edge[k] = keep(sound, edge[k]);
            square[k] = keep(sound, square[k]);
        }
    }
};

void addSharp(const BestSource& source, const std::uint32_t* vertices, const std::uint32_t*, std::size_t count,
              float* rows) {
    const Floats factor = broadcast(static_cast<float>(source.faces.factor)), one = broadcast(1.0f);
    for (std::size_t t = 0; t < count; t += kWidth) {
        const Edges e(source, vertices + 3 * t);
        const Vectors turn = factor * e.turn;
        Floats inverse[3];
        for (std::size_t k = 0; k < 3; ++k) inverse[k] = quotient(one, e.square[k]);
        for (std::size_t k = 0; k < 3; ++k) {
            const Vectors n = (inverse[k] * inverse[(k + 2) % 3]) * turn;
            const Vectors term = keep(isFinite(dot(n, n)), n);
            storeRows<12>(rows + 12 * t + 4 * k, term.x, term.y, term.z, zero());
        }
    }
}

void finishSharp(float* rows, const float*, const float*, std::size_t count) {
    for (std::size_t i = 0; i < count; i += kWidth) {
        Vectors n;
        Floats unused;
        loadRows<4>(rows + 4 * i, n.x, n.y, n.z, unused);
        n = unit(n);
        storeRows<4>(rows + 4 * i, n.x, n.y, n.z, zero());
    }
}

/// Terms of an edge that are equal at both ends. The edge counts if both ends have a `max` normal.
struct EdgeDoubt {
    Floats misfit;  ///< misfit of the sharp normals along the edge
    Floats bend, count, sharp_misfit, robust_misfit, sharp_bend, robust_bend, square;
    Mask counts;

    EdgeDoubt(Vectors e, Floats length_square, Floats inverse, Floats area_square, const Vectors (&sharp)[2],
              const Vectors (&robust)[2]) {
        counts = (dot(sharp[0], sharp[0]) > zero()) & (dot(sharp[1], sharp[1]) > zero()) & (length_square > zero());
        misfit = keep(counts, inverse * dot(e, sharp[0] + sharp[1]));
        const Floats turned = inverse * dot(e, sharp[1] - sharp[0]),
                     robust_one = inverse * dot(e, robust[0] + robust[1]);
        bend = keep(counts, turned * turned);
        count = keep(counts, broadcast(1.0f));
        const Floats sharp_square = misfit * misfit, robust_square = keep(counts, robust_one * robust_one);
        sharp_misfit = area_square * sharp_square;
        robust_misfit = area_square * robust_square;
        sharp_bend = (inverse * inverse) * sharp_square;
        robust_bend = (inverse * inverse) * robust_square;
        square = keep(counts, length_square);
    }
};

/// An edge projected to the plane perpendicular to the sharp normal of its first end.
struct ProjectedEdge {
    Floats x, y, slope, b0, b1, b2, misfit, curvature;

    ProjectedEdge(const Plane& plane, Vectors robust, Vectors e, Floats inverse, Floats size, Floats facing,
                  const EdgeDoubt& doubt) {
        const Floats scale = facing * inverse, half = broadcast(0.5f);
        x = scale * dot(plane.x, e);
        y = scale * dot(plane.y, e);
        slope = scale * dot(plane.n, e);
        const Floats half_x = half * size * x;
        b0 = half_x * x;
        b1 = size * x * y;
        b2 = half * size * y * y;
        misfit = facing * doubt.misfit;
        curvature = keep(doubt.counts, broadcast(2.0f) * absolute(dot(robust, e)) * (inverse * inverse));
    }
};

inline void storeEdges(float* at, const ProjectedEdge& a, const ProjectedEdge& b, const EdgeDoubt& i,
                       const EdgeDoubt& o) {
    storeRows<kFitStep>(at, a.x * a.x + b.x * b.x, a.x * a.y + b.x * b.y, a.y * a.y + b.y * b.y,
                        a.x * a.slope + b.x * b.slope);
    storeRows<kFitStep>(at + 4, a.y * a.slope + b.y * b.slope, a.x * a.b0 + b.x * b.b0, a.y * a.b0 + b.y * b.b0,
                        a.x * a.b2 + b.x * b.b2);
    storeRows<kFitStep>(at + 8, a.y * a.b2 + b.y * b.b2, a.b0 * a.slope + b.b0 * b.slope,
                        a.b1 * a.slope + b.b1 * b.slope, a.b2 * a.slope + b.b2 * b.slope);
    storeRows<kFitStep>(at + 12, a.b0 * a.b0 + b.b0 * b.b0, a.b0 * a.b1 + b.b0 * b.b1, a.b0 * a.b2 + b.b0 * b.b2,
                        a.b1 * a.b2 + b.b1 * b.b2);
    storeRows<kFitStep>(at + 16, a.b2 * a.b2 + b.b2 * b.b2, a.x * a.misfit + b.x * b.misfit,
                        a.y * a.misfit + b.y * b.misfit, a.misfit * a.misfit + b.misfit * b.misfit);
    storeRows<kFitStep>(at + 20, i.bend + o.bend, i.count + o.count, i.sharp_misfit + o.sharp_misfit,
                        i.robust_misfit + o.robust_misfit);
    storeRows<kFitStep>(at + 24, i.sharp_bend + o.sharp_bend, i.robust_bend + o.robust_bend, zero(), zero());
    storeRows<kFitStep>(at + 28, larger(a.curvature, b.curvature), larger(i.square, o.square), zero(), zero());
}

inline void addFitOf(const BestSource& source, const std::uint32_t* vertices, const std::uint32_t* points,
                     float* rows) {
    const Edges t(source, vertices);
    const Floats area_square = dot(t.turn, t.turn), one = broadcast(1.0f);
    Vectors robust[3], sharp[3];
    for (std::size_t k = 0; k < 3; ++k) {
        robust[k] = gatherNormals(source.robust, points + k);
        sharp[k] = gatherNormals(source.sharp, points + k);
    }
    Floats size[3], inverse[3];
    for (std::size_t k = 0; k < 3; ++k) {
        size[k] = squareRoot(t.square[k]);
        inverse[k] = quotient(one, size[k]);
    }
    const auto doubtOf = [&](std::size_t k) {
        const std::size_t next = (k + 1) % 3;
        return EdgeDoubt(t.edge[k], t.square[k], inverse[k], area_square, {sharp[k], sharp[next]},
                         {robust[k], robust[next]});
    };
    const EdgeDoubt doubts[3] = {doubtOf(0), doubtOf(1), doubtOf(2)};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t previous = (k + 2) % 3;
        const Plane plane(sharp[k]);
        const ProjectedEdge out(plane, robust[k], t.edge[k], inverse[k], size[k], one, doubts[k]);
        const ProjectedEdge in(plane, robust[k], t.edge[previous], inverse[previous], size[previous], minus(one),
                               doubts[previous]);
        storeEdges(rows + 4 * kFitRows * k, out, in, doubts[k], doubts[previous]);
    }
}

void addFit(const BestSource& source, const std::uint32_t* vertices, const std::uint32_t* points, std::size_t count,
            float* rows) {
    for (std::size_t t = 0; t < count; t += kWidth)
        addFitOf(source, vertices + 3 * t, points + 3 * t, rows + kFitStep * t);
}

// -- normal of a point, from its sums --

struct PointSums {
    Floats xx, xy, yy, xs, ys;
    Floats xb[3], yb[3], bs[3];
    Floats bb[6];  ///< symmetric matrix: 00 01 02 11 12 22
    Floats xm, ym, mm, bend, count, sharp_misfit, robust_misfit, sharp_bend, robust_bend, curvature, square;

    explicit PointSums(const float* at) {
        constexpr std::size_t kStep = 4 * kFitRows;
        Floats unused;
        loadRows<kStep>(at, xx, xy, yy, xs);
        loadRows<kStep>(at + 4, ys, xb[0], yb[0], xb[2]);
        loadRows<kStep>(at + 8, yb[2], bs[0], bs[1], bs[2]);
        loadRows<kStep>(at + 12, bb[0], bb[1], bb[2], bb[4]);
        loadRows<kStep>(at + 16, bb[5], xm, ym, mm);
        loadRows<kStep>(at + 20, bend, count, sharp_misfit, robust_misfit);
        loadRows<kStep>(at + 24, sharp_bend, robust_bend, unused, unused);
        loadRows<kStep>(at + 28, curvature, square, unused, unused);
        xb[1] = yb[0] + yb[0];
        yb[1] = xb[2] + xb[2];
        bb[3] = broadcast(4.0f) * bb[2];
    }
};

/// Linear part of the fit, which is shared by other fits to the same edges.
struct Slopes {
    Mask spanned;  ///< lanes whose edges point in more than one direction
    Floats xx, xy, yy;

    /// Inverts the matrix of the linear part: the sums of squares and products of the two coordinates of the edges.
    Slopes(Floats sum_xx, Floats sum_xy, Floats sum_yy) {
        const Floats determinant = sum_xx * sum_yy - sum_xy * sum_xy, all = sum_xx + sum_yy;
        spanned = determinant > broadcast(1e-6f) * (all * all);
        const Floats inverse = keep(spanned, broadcast(1.0f) / determinant);
        xx = sum_yy * inverse;
        xy = minus(sum_xy * inverse);
        yy = sum_xx * inverse;
    }
    [[nodiscard]] Flat solve(Floats x, Floats y) const { return {xx * x + xy * y, xy * x + yy * y}; }
};

/// Solves for the three second derivatives, with ridge regularization.
inline void solveCurvature(const PointSums& s, const Slopes& slopes, Floats (&q)[3]) {
    const Floats ridge = broadcast(static_cast<float>(kFitRidge * kFitRidgeShare)) * (s.bb[0] + s.bb[3] + s.bb[5]);
    Floats m[6], p[3];
    for (std::size_t i = 0, n = 0; i < 3; ++i) {
        const Flat along = slopes.solve(s.xb[i], s.yb[i]);
        for (std::size_t j = i; j < 3; ++j, ++n) m[n] = s.bb[n] - (along.x * s.xb[j] + along.y * s.yb[j]);
        p[i] = s.bs[i] - (along.x * s.xs + along.y * s.ys);
    }
    solveRidged(m, ridge, p, q);
}

/// Returns the fitted normal, or the plane's normal if the edges do not span the plane.
inline Vectors fittedNormal(const Plane& plane, const PointSums& s, const Slopes& slopes) {
    Floats q[3];
    solveCurvature(s, slopes, q);
    Floats x = s.xs, y = s.ys;
    for (std::size_t i = 0; i < 3; ++i) {
        x = x - s.xb[i] * q[i];
        y = y - s.yb[i] * q[i];
    }
    const Flat slope = slopes.solve(x, y);
    const Vectors n = plane.n - plane.raise(slope);
    const Floats square = dot(n, n);  // at least 1; NaN for rings whose sums overflow
    const Mask sound = slopes.spanned & (square < broadcast(1e12f));
    const Floats inverse = broadcast(1.0f) / squareRoot(square);
    return {select(sound, inverse * n.x, plane.n.x), select(sound, inverse * n.y, plane.n.y),
            select(sound, inverse * n.z, plane.n.z)};
}

/// Limits x to kNoTrust; an overflow becomes kNoTrust too. 0/0 becomes 0: it occurs on a plane, where all normals are
/// equal and trust does not matter.
inline Floats bounded(Floats x) {
    const Floats most = broadcast(static_cast<float>(kNoTrust));
    return select(x < most, x, keep(absolute(x) > zero(), most));
}
inline Floats squared(Floats x) { return x * x; }

/// Returns the doubt d in the fitted normal, d >= 0. The blend weights the fit by 1 / (1 + d).
inline Floats doubtIn(const PointSums& s, const Slopes& slopes, Vectors robust, Vectors sharp, Vectors fit) {
    const auto per = [](double limit) { return broadcast(static_cast<float>(1 / (limit * limit))); };
    const Flat turned = slopes.solve(s.xm, s.ym);
    const Floats unexplained = larger(s.mm - (turned.x * s.xm + turned.y * s.ym), zero());
    const Floats noise = per(kNoise) * (unexplained / s.bend);
    const Floats turn = squared(s.curvature) * s.square;
    const Floats bent = smaller(per(kBent) * turn, broadcast(1.0f));
    const Floats kink = per(kKink) * bent * (s.sharp_misfit / s.robust_misfit);
    const Floats fillet = per(kFillet) * bent * (s.sharp_bend / s.robust_bend);
    const Vectors apart = cross(robust, sharp), lean = cross(robust, fit);
    const Floats jump = per(kJump) * turn * dot(apart, apart);
    const Floats coarse = per(kTurn) * (s.bend / s.count);
    const Floats spread = per(kSpread) * dot(lean, lean);
    const Floats sum = bounded(squared(noise)) + bounded(squared(squared(kink))) + bounded(squared(squared(fillet))) +
                       bounded(squared(squared(jump))) + bounded(squared(squared(coarse))) + bounded(squared(spread));
    return select(dot(robust, fit) < zero(), broadcast(static_cast<float>(kNoTrust)), sum);
}

void finishFit(float* sums, const float* robust_rows, const float* sharp_rows, std::size_t count) {
    constexpr std::size_t kStep = 4 * kFitRows;
    const Floats one = broadcast(1.0f);
    for (std::size_t g = 0; g < count; g += kWidth) {
        Vectors robust, sharp;
        Floats unused;
        loadRows<4>(robust_rows + 4 * g, robust.x, robust.y, robust.z, unused);
        loadRows<4>(sharp_rows + 4 * g, sharp.x, sharp.y, sharp.z, unused);
        const PointSums s(sums + kStep * g);
        const Slopes slopes(s.xx, s.xy, s.yy);
        const Vectors fit = fittedNormal(Plane(sharp), s, slopes);
        const Floats share = one / (one + doubtIn(s, slopes, robust, sharp, fit));
        // Both vectors point to the same side, so their sum does not vanish.
        const Vectors mixed = unit(share * fit + (one - share) * robust);
        const Mask has = dot(sharp, sharp) > zero();
        storeRows<kStep>(sums + kStep * g, select(has, mixed.x, robust.x), select(has, mixed.y, robust.y),
                         select(has, mixed.z, robust.z), zero());
    }
}

// -- refinement step: the normal, interpolated along an edge, must be perpendicular to the edge. On any circle dot(e, m
// + n) is 0. --

/// An edge as seen from its first end: projected to the plane perpendicular to the normal there, and divided by its
/// length.
struct StepEdge {
    Floats x, y, misfit, turn;

    StepEdge(const Plane& plane, Vectors e, Floats inverse, Vectors here, Vectors there) {
        const Mask counts = (dot(here, here) > zero()) & (dot(there, there) > zero());
        const Floats scale = keep(counts, inverse);
        x = scale * dot(plane.x, e);
        y = scale * dot(plane.y, e);
        misfit = scale * dot(e, here + there);
        turn = scale * dot(e, there - here);
    }
};

void addStep(const BestSource& source, const std::uint32_t* vertices, const std::uint32_t* points, std::size_t count,
             float* rows) {
    for (std::size_t g = 0; g < count; g += kWidth) {
        const Edges t(source, vertices + 3 * g);
        const Floats weight = squareRoot(squareRoot(dot(t.turn, t.turn))), one = broadcast(1.0f);
        Vectors normal[3];
        Floats inverse[3];
        for (std::size_t k = 0; k < 3; ++k) {
            normal[k] = gatherNormals(source.robust, points + 3 * g + k);
            inverse[k] = quotient(one, squareRoot(t.square[k]));
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3, previous = (k + 2) % 3;
            const Plane plane(normal[k]);
            const StepEdge a(plane, t.edge[k], inverse[k], normal[k], normal[next]);
            const StepEdge b(plane, t.edge[previous], minus(inverse[previous]), normal[k], normal[previous]);
            float* const at = rows + kStepStride * g + 4 * kStepRows * k;
            storeRows<kStepStride>(at, weight * (a.x * a.x + b.x * b.x), weight * (a.x * a.y + b.x * b.y),
                                   weight * (a.y * a.y + b.y * b.y), weight * (a.x * a.misfit + b.x * b.misfit));
            storeRows<kStepStride>(at + 4, weight * (a.y * a.misfit + b.y * b.misfit),
                                   weight * (a.misfit * a.misfit + b.misfit * b.misfit),
                                   weight * (a.turn * a.turn + b.turn * b.turn), zero());
        }
    }
}

/// Finishes a refinement step. It rotates the normal by at most 14 degrees, even if the edges barely span the plane:
/// the tangent of the rotation is at most x / (1 + x^2) / 2, where x is the length of `lean`.
void finishStep(float* sums, const float* normals, const float*, std::size_t count) {
    constexpr std::size_t kStep = 4 * kStepRows;
    const Floats one = broadcast(1.0f), half = broadcast(0.5f);
    const auto trust = [&](double limit, Floats doubt) {
        return one + squared(broadcast(static_cast<float>(1 / limit)) * doubt);
    };
    for (std::size_t g = 0; g < count; g += kWidth) {
        Vectors n;
        Floats xx, xy, yy, xm, ym, mm, turn, unused;
        loadRows<4>(normals + 4 * g, n.x, n.y, n.z, unused);
        loadRows<kStep>(sums + kStep * g, xx, xy, yy, xm);
        loadRows<kStep>(sums + kStep * g + 4, ym, mm, turn, unused);
        const Slopes slopes(xx, xy, yy);
        const Flat lean = minus(one) * slopes.solve(xm, ym);
        const Floats explained = minus(lean.x * xm + lean.y * ym), left = larger(mm - explained, zero());
        // NaN if the edges leave no residual to explain; the normal is then unchanged.
        const Floats share =
            half / (trust(kStepLeft, left / explained) * trust(kStepNoise, left / turn) * (one + dot(lean, lean)));
        const Plane plane(n);
        const Vectors moved = unit(plane.n + keep(slopes.spanned & (share > zero()), share) * plane.raise(lean));
        const Vectors result = keep(dot(n, n) > zero(), moved);
        storeRows<kStep>(sums + kStep * g, result.x, result.y, result.z, zero());
    }
}

}  // namespace

BestKernels bestKernels() {
    return {{1, addSharp, finishSharp}, {kFitRows, addFit, finishFit}, {kStepRows, addStep, finishStep}};
}

}  // namespace tspace::smooth::TSPACE_LANES
