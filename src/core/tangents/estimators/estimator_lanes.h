// SPDX-License-Identifier: MIT
// Code shared by both estimators, on lanes. Included after lanes_*.h, with TSPACE_LANES set to its namespace. Each lane
// is one triangle or one group.
#pragma once

#include "core/simd/vectors_kernel.h"
#include "core/tangents/estimators/estimator.h"

namespace tspace::estimators::TSPACE_LANES {

using namespace simd::TSPACE_LANES;

namespace {

/// Edges of kWidth triangles. Edge k goes from corner k to corner k + 1. If a value is not finite, all edges are zero.
struct TriangleEdges {
    Vectors edge[3];
    Floats u[3], v[3];   ///< UV edges
    Floats square[3];    ///< squared lengths of the edges
    Floats double_area;  ///< twice the area of the triangle in space

    TriangleEdges(const VertexSource& source, const std::uint32_t* vertices, bool exact) {
        const Floats scale = broadcast(source.position_scale), uv_scale = broadcast(source.uv_scale);
        Vectors p[3];
        Floats s[3], t[3];
        for (std::size_t k = 0; k < 3; ++k) {
            p[k] = scale * gatherVectors(source.positions, source.position_stride, vertices + k, exact);
            gather2(source.uvs, source.uv_stride, vertices + k, s[k], t[k]);
            s[k] = uv_scale * s[k];
            t[k] = uv_scale * t[k];
        }
        Mask sound = isFinite(s[0] + t[0]);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            edge[k] = p[next] - p[k];
            u[k] = s[next] - s[k];
            v[k] = t[next] - t[k];
            square[k] = dot(edge[k], edge[k]);
            sound = sound & isFinite(square[k]) & isFinite(u[k]) & isFinite(v[k]);
        }
        if (!all(sound)) [[unlikely]] {
            for (std::size_t k = 0; k < 3; ++k) {
                edge[k] = keep(sound, edge[k]);
                u[k] = keep(sound, u[k]);
                v[k] = keep(sound, v[k]);
                square[k] = keep(sound, square[k]);
            }
        }
        const Vectors c = cross(edge[0], edge[2]);
        double_area = squareRoot(dot(c, c));
    }
};

struct Triangles : TriangleEdges {
    Floats determinant;        ///< twice the signed UV area
    Vectors along_u, along_v;  ///< dP/du and dP/dv times |determinant|

    Triangles(const VertexSource& source, const std::uint32_t* vertices, bool exact)
        : TriangleEdges(source, vertices, exact) {
        // Edges relative to corner 0 are edge 0 and the negative of edge 2.
        determinant = u[2] * v[0] - u[0] * v[2];
        const Floats facing = select(determinant < zero(), broadcast(-1.0f), broadcast(1.0f));
        const Floats v2 = minus(facing * v[2]), v0 = facing * v[0], u2 = minus(facing * u[2]), u0 = facing * u[0];
        const Vectors back{minus(edge[2].x), minus(edge[2].y), minus(edge[2].z)};
        along_u = v2 * edge[0] - v0 * back;
        along_v = u0 * back - u2 * edge[0];
    }

    /// Returns the weight of a triangle in the robust mean: A^2 / (sum of squared edges)^(3/4). For triangles of equal
    /// size, errors of positions and UVs suggest A^2 / (sum of squares), the inverse of the variance of their tangents;
    /// of two triangles, the larger one gets more weight than that.
    [[nodiscard]] Floats robustWeight() const {
        const Floats sum = square[0] + square[1] + square[2], root = squareRoot(sum);
        return quotient(double_area * double_area, root * squareRoot(root));
    }
};

}  // namespace

}  // namespace tspace::estimators::TSPACE_LANES
