// SPDX-License-Identifier: MIT
// The effect of a texture transform on frames: a 2x2 matrix on UVs, without factors that leave directions as they are.
#pragma once

#include <span>
#include <vector>

#include "tspace/span.h"
#include "tspace/vec.h"

namespace tspace {

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
