// SPDX-License-Identifier: MIT
// dP/du and dP/dv of a triangle before the division by its UV determinant.
// Based on: Lengyel, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh", 2001.
#pragma once

#include "core/base/vec_math.h"

namespace tspace {

/// `tangent / determinant` is dP/du, `bitangent / determinant` is dP/dv. The sum over a fan of triangles does
/// not depend on how a polygon is cut: by Green's theorem it is the integral of P dv (and of -P du) along the
/// border.
struct UvFrame {
    DVec3 tangent;           ///< t2 E1 - t1 E2
    DVec3 bitangent;         ///< s1 E2 - s2 E1
    double determinant = 0;  ///< s1 t2 - s2 t1
};

/// From two edges and their UV differences: (s1, t1) belongs to e1, (s2, t2) to e2.
inline UvFrame uvFrame(const DVec3& e1, const DVec3& e2, double s1, double t1, double s2, double t2) {
    return {t2 * e1 - t1 * e2, s1 * e2 - s2 * e1, s1 * t2 - s2 * t1};
}

/// From the edges P1-P0 and P2-P0. Differences of floats in double are exact or nearly so, and their products
/// do not overflow, so collinear UVs of ordinary size give exactly zero.
inline UvFrame uvFrame(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec2& uv0, const Vec2& uv1,
                       const Vec2& uv2) {
    return uvFrame(toDouble(p1) - toDouble(p0), toDouble(p2) - toDouble(p0), double{uv1.x} - double{uv0.x},
                   double{uv1.y} - double{uv0.y}, double{uv2.x} - double{uv0.x}, double{uv2.y} - double{uv0.y});
}

/// True when the determinant can be divided by.
inline bool hasUvArea(double determinant) { return determinant != 0 && std::isfinite(determinant); }

}  // namespace tspace
