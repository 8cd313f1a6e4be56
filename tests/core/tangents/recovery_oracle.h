// SPDX-License-Identifier: MIT
// The formulas of `fast` and `best` for the group at vertex 0, in double precision and implemented differently from the
// library: lists of equations, and Gaussian elimination.
#pragma once

#include <array>
#include <vector>

#include "core/base/vec_math.h"
#include "core/tangents/shapes.h"

namespace tspace::test {

struct ExpectedFrame {
    Vec3 tangent, bitangent;
    double length_s = 0, length_t = 0;
};

inline DVec3 unitOf(const DVec3& v) { return (1 / length(v)) * v; }
inline DVec3 across(const DVec3& n, const DVec3& v) { return v - dot(n, v) * n; }

/// Quantities of one triangle whose first corner is at vertex 0.
struct RingTriangle {
    DVec3 e1, e2, e3;
    double u1, v1, u2, v2;
    DVec3 normal1, normal2;
    double area, squares;

    RingTriangle(const SimpleMesh& shape, std::size_t t) {
        const std::uint32_t* i = shape.indices.data() + 3 * t;
        const DVec3 p0 = toDouble(shape.positions[i[0]]), p1 = toDouble(shape.positions[i[1]]),
                    p2 = toDouble(shape.positions[i[2]]);
        e1 = p1 - p0;
        e2 = p2 - p0;
        e3 = p2 - p1;
        u1 = double{shape.uvs[i[1]].x} - shape.uvs[i[0]].x;
        v1 = double{shape.uvs[i[1]].y} - shape.uvs[i[0]].y;
        u2 = double{shape.uvs[i[2]].x} - shape.uvs[i[0]].x;
        v2 = double{shape.uvs[i[2]].y} - shape.uvs[i[0]].y;
        normal1 = unitOf(toDouble(shape.normals[i[1]]));
        normal2 = unitOf(toDouble(shape.normals[i[2]]));
        area = length(cross(e1, e2)) / 2;
        squares = dot(e1, e1) + dot(e2, e2) + dot(e3, e3);
    }
    [[nodiscard]] double determinant() const { return u1 * v2 - u2 * v1; }
    [[nodiscard]] DVec3 alongU() const { return (1 / determinant()) * (v2 * e1 - v1 * e2); }
    [[nodiscard]] DVec3 alongV() const { return (1 / determinant()) * (u1 * e2 - u2 * e1); }
    [[nodiscard]] double robustWeight() const { return 4 * area * area / std::pow(squares, 0.75); }
};

inline ExpectedFrame twoWeightsAtFirst(const SimpleMesh& shape) {
    const DVec3 n = unitOf(toDouble(shape.normals[0]));
    DVec3 a[2], b[2];
    double lengths[2] = {0, 0}, weight = 0;
    for (std::size_t t = 0; t < shape.indices.size() / 3; ++t) {
        const RingTriangle r(shape, t);
        const DVec3 along[2] = {r.alongU(), r.alongV()};
        const double w = std::fabs(r.determinant()) / (dot(r.e1, r.e1) * dot(r.e2, r.e2));
        for (int k = 0; k < 2; ++k) {
            a[k] = a[k] + w * along[k];
            b[k] = b[k] + r.robustWeight() * unitOf(along[k]);
            lengths[k] += r.robustWeight() * length(along[k]);
        }
        weight += r.robustWeight();
    }
    Vec3 result[2];
    for (int k = 0; k < 2; ++k) {
        const DVec3 x = unitOf(across(n, a[k])), y = unitOf(across(n, b[k]));
        const double sine = std::sin(3.4 * std::numbers::pi / 180), r = dot(cross(x, y), cross(x, y)) / (sine * sine);
        result[k] = toFloat(unitOf((1 / (1 + r)) * x + (r / (1 + r)) * y));
    }
    return {result[0], result[1], lengths[0] / weight, lengths[1] / weight};
}

/// An equation for the five coefficients d and f from one edge of a triangle: l = J d + q f.
struct EdgeEquation {
    double weight;
    std::array<double, 5> x;  ///< u, v, u^2/2, u v, v^2/2
    DVec3 l;
};

inline EdgeEquation equationOf(const DVec3& n, const DVec3& other, const DVec3& e, double u, double v, double area) {
    const DVec3 p = across(n, e);
    const double size = length(e), turn = dot(other - n, e) / size;
    return {std::sqrt(area) / (size * size),
            {u, v, u * u / 2, u * v, v * v / 2},
            (size / length(p) * (1 + turn * turn / 24)) * p};
}

/// Returns the coefficients c that minimize the sum of weight * |l - sum x c|^2, plus k * diagonal * c^2 for the last
/// three coefficients.
inline std::array<DVec3, 5> solveFit(const std::vector<EdgeEquation>& equations, const std::array<double, 3>& diagonal,
                                     double k) {
    double m[5][5] = {};
    DVec3 right[5];
    for (const EdgeEquation& e : equations) {
        for (int i = 0; i < 5; ++i) {
            for (int j = 0; j < 5; ++j) m[i][j] += e.weight * e.x[i] * e.x[j];
            right[i] = right[i] + (e.weight * e.x[i]) * e.l;
        }
    }
    for (int i = 0; i < 3; ++i) m[i + 2][i + 2] += k * diagonal[i];
    for (int i = 0; i < 5; ++i) {
        for (int j = i + 1; j < 5; ++j) {
            const double factor = m[j][i] / m[i][i];
            for (int c = i; c < 5; ++c) m[j][c] -= factor * m[i][c];
            right[j] = right[j] - factor * right[i];
        }
    }
    std::array<DVec3, 5> c;
    for (int i = 4; i >= 0; --i) {
        DVec3 sum = right[i];
        for (int j = i + 1; j < 5; ++j) sum = sum - m[i][j] * c[j];
        c[i] = (1 / m[i][i]) * sum;
    }
    return c;
}

/// Returns the weighted sum of the squared residuals |l - sum x c|^2.
inline double unexplained(const std::vector<EdgeEquation>& equations, const std::array<DVec3, 5>& c) {
    double sum = 0;
    for (const EdgeEquation& e : equations) {
        DVec3 rest = e.l;
        for (int i = 0; i < 5; ++i) rest = rest - e.x[i] * c[i];
        sum += e.weight * dot(rest, rest);
    }
    return sum;
}

inline ExpectedFrame recoveryAtFirst(const SimpleMesh& shape) {
    const DVec3 n = unitOf(toDouble(shape.normals[0]));
    std::vector<EdgeEquation> equations;
    DVec3 robust[2];
    for (std::size_t t = 0; t < shape.indices.size() / 3; ++t) {
        const RingTriangle r(shape, t);
        equations.push_back(equationOf(n, r.normal1, r.e1, r.u1, r.v1, r.area));
        equations.push_back(equationOf(n, r.normal2, r.e2, r.u2, r.v2, r.area));
        robust[0] = robust[0] + r.robustWeight() * unitOf(r.alongU());
        robust[1] = robust[1] + r.robustWeight() * unitOf(r.alongV());
    }
    double scale[2] = {0, 0};
    for (const EdgeEquation& e : equations) {
        for (int k = 0; k < 2; ++k) scale[k] += e.weight * e.x[k] * e.x[k];
    }
    for (double& s : scale) s = 1 / std::sqrt(s);
    std::array<double, 3> q{};
    for (EdgeEquation& e : equations) {
        const double u = e.x[0] * scale[0], v = e.x[1] * scale[1];
        e.x = {u, v, u * u / 2, u * v, v * v / 2};
        for (int k = 0; k < 3; ++k) q[k] += e.weight * e.x[k + 2] * e.x[k + 2];
    }
    const double trace = q[0] + q[1] + q[2];
    const std::array<double, 3> diagonal{0.3 * trace, 0.6 * trace, 0.3 * trace};

    const double k0 = 3e-4;
    const std::array<DVec3, 5> first = solveFit(equations, diagonal, k0),
                               straight = solveFit(equations, diagonal, 1e12);
    double bent = 0, linear = 0;
    for (int k = 0; k < 3; ++k) bent += q[k] * dot(first[k + 2], first[k + 2]);
    for (const EdgeEquation& e : equations) {
        const DVec3 l = e.x[0] * first[0] + e.x[1] * first[1];
        linear += e.weight * dot(l, l);
    }
    const double bend = bent / linear, left = unexplained(equations, first);
    const double miss = std::min(3.0, left / (unexplained(equations, straight) - left));
    const double doubt = 512 * bend * bend + 5 * miss * bend / (bend + 1e-3);
    const std::array<DVec3, 5> final = solveFit(equations, diagonal, k0 + doubt);
    Vec3 result[2];
    const double share = doubt / (doubt + 2);
    for (int k = 0; k < 2; ++k)
        result[k] = toFloat(unitOf((1 - share) * unitOf(final[k]) + share * unitOf(across(n, robust[k]))));
    return {result[0], result[1], length(final[0]) * scale[0], length(final[1]) * scale[1]};
}

}  // namespace tspace::test
