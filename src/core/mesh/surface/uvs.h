// SPDX-License-Identifier: MIT
// UV maps: connected components, and the effect of a texture transform on frames.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tspace/span.h"

namespace tspace {

// Islands of a UV map: its connected components.

struct UvIslands {
    std::vector<std::uint32_t> island_of = {};  ///< island of each triangle
    std::uint32_t count = 0;                    ///< number of islands, in order of their first triangles
};

/// Finds UV islands. Two triangles are connected if they share an edge whose ends are equal in position and in UV,
/// whatever their vertex indices. `corners`: three per triangle, each less than positions.size() and uvs.size().
/// Expected time O(n log n); about 60 bytes per corner.
UvIslands findUvIslands(std::span<const std::uint32_t> corners, std::span<const Vec3> positions,
                        std::span<const Vec2> uvs);

/// Returns twice the signed area, with v upward. In double precision, finite float UVs never overflow, and differences
/// of floats are exact.
double signedUvArea(const Vec2& a, const Vec2& b, const Vec2& c, bool v_runs_down);

// Effect of a texture transform on frames: a 2x2 matrix for UVs, without factors that do not change directions.

/// Matrix for UVs: uv' = matrix * uv.
struct UvMatrix {
    double uu = 1, uv = 0;  ///< row of u: u' = uu * u + uv * v
    double vu = 0, vv = 1;  ///< row of v: v' = vu * u + vv * v

    friend bool operator==(const UvMatrix&, const UvMatrix&) = default;
    [[nodiscard]] bool isIdentity() const { return *this == UvMatrix{}; }
    [[nodiscard]] bool mirrors() const { return uu * vv - uv * vu < 0; }
};

/// Returns the matrix whose frames are those of rotation * scale (KHR_texture_transform). A positive rotation (radians)
/// rotates (1, 0) toward (0, -1), which is counter-clockwise if v increases downward.
///
/// Factors that do not change directions are removed: for multiples of a quarter turn, the magnitudes of both scales;
/// for other rotations, the larger of the two, by which both are divided. A transform that does not change frames
/// therefore gives exactly the identity. Angles within 1e-6 of a quarter turn are snapped to it: the matrix then only
/// contains 0, 1 and -1, and does not round UVs. A scale of 0, which shows one row of texels everywhere and has no
/// frame, counts as 1.
UvMatrix uvMatrix(double rotation, double scale_u, double scale_v);

/// Multiplies each UV by the matrix, in double precision, and rounds the result once.
///
/// Triangles with collinear UVs, not parallel to an axis, may get a tiny UV area from rounding if the matrix is not a
/// quarter turn.
std::vector<Vec2> transformUvs(StridedSpan<const Vec2> uvs, const UvMatrix& matrix);

}  // namespace tspace
