// SPDX-License-Identifier: MIT
// The method `fast`: two weighted sums of dP/du, one that is accurate on smooth surfaces and one that is robust,
// blended by the angle between them. On smooth surfaces the angle is small, and decreases with the size of the
// triangles; at kinks, slivers and noise it is large.
//
// With g = |det| dP/du, the same vector at all three corners:
//   a += g / (|e1|^2 |e2|^2)          e1, e2: the edges at the corner
//   b += g / |g| * A^2 / (|e1|^2 + |e2|^2 + |e3|^2)^(3/4)
//   x = unit(a perpendicular to N), y = unit(b perpendicular to N), r = sin^2(angle(x, y)) / sin^2(3.4 degrees)
//   T = unit((1 - m) x + m y), m = r / (1 + r)
// The bitangent is computed in the same way, from dP/dv.
//
// Based on: Max, "Weights for Computing Vertex Normals from Facet Normals", 1999 (the weights of the first sum).
//
// Included once per instruction set, after lanes_*.h and with TSPACE_LANES set to its namespace.
#pragma once

#include "core/tangents/estimators/estimator_lanes.h"

namespace tspace::estimators::TSPACE_LANES {
namespace {

// squared sine of 3.4 degrees, the angle between the two means at which both have equal weights
constexpr float kMixSquare = 0.00351691f;

template <bool kTangentsOnly>
inline void addTwoWeightsOf(const VertexSource& source, const std::uint32_t* vertices, bool exact, float* rows) {
    constexpr std::size_t kRows = kTangentsOnly ? 2 : 4, kStep = 12 * kRows;
    const Triangles t(source, vertices, exact);
    const Floats one = broadcast(1.0f), weight = t.robustWeight();
    const Floats length_u = squareRoot(dot(t.along_u, t.along_u));
    const Vectors robust = quotient(weight, length_u) * t.along_u;
    Vectors robust_v{};
    Floats length_v{}, mean_u{}, mean_v{};
    if constexpr (!kTangentsOnly) {
        length_v = squareRoot(dot(t.along_v, t.along_v));
        robust_v = quotient(weight, length_v) * t.along_v;
        const Floats size = absolute(t.determinant);
        mean_u = weight * quotient(length_u, size);
        mean_v = weight * quotient(length_v, size);
    }
    Floats inverse[3];
    for (std::size_t k = 0; k < 3; ++k) inverse[k] = quotient(one, t.square[k]);
    for (std::size_t k = 0; k < 3; ++k) {
        const Floats raw = inverse[k] * inverse[(k + 2) % 3], w = keep(isFinite(raw), raw);
        float* const at = rows + 4 * kRows * k;
        storeRows<kStep>(at, w * t.along_u.x, w * t.along_u.y, w * t.along_u.z, weight);
        storeRows<kStep>(at + 4, robust.x, robust.y, robust.z, zero());
        if constexpr (!kTangentsOnly) {
            storeRows<kStep>(at + 8, w * t.along_v.x, w * t.along_v.y, w * t.along_v.z, mean_u);
            storeRows<kStep>(at + 12, robust_v.x, robust_v.y, robust_v.z, mean_v);
        }
    }
}

template <bool kTangentsOnly>
void addTwoWeights(const VertexSource& source, const std::uint32_t* vertices, std::size_t count, float* rows) {
    for (std::size_t t = 0; t < count; t += kWidth) {
        const std::uint32_t* const v = vertices + 3 * t;
        addTwoWeightsOf<kTangentsOnly>(source, v, includesLast(v, source.last_vertex),
                                       rows + (kTangentsOnly ? 24 : 48) * t);
    }
}

/// Blends both means. If one of them has no direction, returns the other.
inline Vectors mixed(Vectors n, Vectors accurate, Vectors robust) {
    const Vectors a = unit(accurate - dot(n, accurate) * n), b = unit(robust - dot(n, robust) * n);
    const Vectors across = cross(a, b);
    const Floats one = broadcast(1.0f);
    const Floats square = select(dot(a, b) < zero(), one, dot(across, across)), r = square / broadcast(kMixSquare);
    const Floats m = select(dot(a, a) > zero(), r / (one + r), one);
    return unit((one - m) * a + m * b);
}

template <bool kTangentsOnly>
void finishTwoWeights(float* sums, const float* normals, std::size_t count) {
    constexpr std::size_t kRows = kTangentsOnly ? 2 : 4, kStep = 4 * kRows;
    for (std::size_t g = 0; g < count; g += kWidth) {
        float* const at = sums + kStep * g;
        Floats unused, weight;
        Vectors n, a, b;
        loadRows<4>(normals + 4 * g, n.x, n.y, n.z, unused);
        n = unitNormal(n);
        loadRows<kStep>(at, a.x, a.y, a.z, weight);
        loadRows<kStep>(at + 4, b.x, b.y, b.z, unused);
        const Vectors s = mixed(n, a, b);
        if constexpr (kTangentsOnly) {
            storeRows<kStep>(at, s.x, s.y, s.z, zero());
        } else {
            Floats mean_u, mean_v;
            loadRows<kStep>(at + 8, a.x, a.y, a.z, mean_u);
            loadRows<kStep>(at + 12, b.x, b.y, b.z, mean_v);
            const Vectors t = mixed(n, a, b);
            storeRows<kStep>(at, s.x, s.y, s.z, quotient(mean_u, weight));
            storeRows<kStep>(at + 4, t.x, t.y, t.z, quotient(mean_v, weight));
        }
    }
}

}  // namespace

Estimator twoWeights(bool tangents_only) {
    if (tangents_only) return {2, addTwoWeights<true>, finishTwoWeights<true>};
    return {4, addTwoWeights<false>, finishTwoWeights<false>};
}

}  // namespace tspace::estimators::TSPACE_LANES
