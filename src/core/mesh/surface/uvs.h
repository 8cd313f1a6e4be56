// SPDX-License-Identifier: MIT
// UV maps: their connected pieces, and what a texture transform does to frames.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tspace/span.h"

namespace tspace {

// The connected pieces of a UV map.

struct UvIslands {
    std::vector<std::uint32_t> island_of = {};  ///< one per triangle
    std::uint32_t count = 0;                    ///< numbered in order of their first triangles
};

/// Two triangles belong to one island when they share an edge whose ends are equal in position and in UV, however the
/// vertices are indexed. `corners`: three per triangle, each smaller than positions.size() and uvs.size(). Expected linear
/// time; about 60 bytes per corner.
UvIslands findUvIslands(std::span<const std::uint32_t> corners, std::span<const Vec3> positions,
                        std::span<const Vec2> uvs);

/// Twice the signed area with v upwards. Double, so that no finite float UVs overflow and float differences are exact.
double signedUvArea(const Vec2& a, const Vec2& b, const Vec2& c, bool v_runs_down);

// The effect of a texture transform on frames: a 2x2 matrix on UVs, without factors that leave directions as they are.

/// uv' = matrix * uv.
struct UvMatrix {
    double uu = 1, uv = 0;  ///< u' = uu * u + uv * v
    double vu = 0, vv = 1;  ///< v' = vu * u + vv * v

    friend bool operator==(const UvMatrix&, const UvMatrix&) = default;
    [[nodiscard]] bool isIdentity() const { return *this == UvMatrix{}; }
    [[nodiscard]] bool mirrors() const { return uu * vv - uv * vu < 0; }
};

/// The matrix whose frames are those of rotation * scale (KHR_texture_transform). A positive rotation (radians) turns
/// (1, 0) towards (0, -1), which is counter-clockwise where v runs down.
///
/// Scales that keep directions are left out, so a matrix that need not change a frame is exactly the identity: all of
/// them without a rotation (but for the sign), and what both axes have in common with one. Angles within 1e-6 of a
/// quarter turn are one: the matrix then has only 0, 1 and -1, and changes no digit of a UV. A scale of 0, which shows
/// one row of texels everywhere and has no frame, counts as 1.
UvMatrix uvMatrix(double rotation, double scale_u, double scale_v);

/// Each UV through the matrix, in double, rounded once.
///
/// Triangles whose UVs lie on one line, not parallel to an axis, may get a tiny UV area by the rounding when the matrix
/// is no quarter turn.
std::vector<Vec2> transformUvs(StridedSpan<const Vec2> uvs, const UvMatrix& matrix);

}  // namespace tspace
