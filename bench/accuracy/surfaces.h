// SPDX-License-Identifier: MIT
// Surfaces with a formula, so that frames are known exactly at every point.
#pragma once

#include <span>

#include "core/base/vec_math.h"
#include "dual.h"

namespace tspace::accuracy {

struct SurfacePoint {
    Dual position[3], uv[2];
};

/// A map of the unit square, (s, t), to space and to the texture.
struct Surface {
    const char* name;
    /// `side`: -1 or 1, the side of the fold that a point on it is taken for.
    SurfacePoint (*at)(const Dual& s, const Dual& t, int side);
    /// The line of constant s along which the UV map turns round, or none.
    double fold = -1;
    bool is_flat = false;
};

/// The ones that the figures of the documentation are taken from.
std::span<const Surface> surfaces();
/// Others, which nothing was tuned on: printed apart.
std::span<const Surface> heldOutSurfaces();

/// The exact frame of a point.
struct ExactFrame {
    DVec3 position = {}, normal = {};
    DVec3 tangent = {}, bitangent = {};  ///< dP/du and dP/dv, not unit
    double u = 0, v = 0;
    double sign = 1;  ///< of the UV map's orientation

    /// The unit tangent at right angles to `n`.
    [[nodiscard]] DVec3 tangentAcross(const DVec3& n) const;
};

ExactFrame exactFrame(const Surface& surface, double s, double t, int side);

/// Moves (s, t) to where the surface has the texture coordinates (u, v), by Newton's method from a near place.
void findUv(const Surface& surface, double u, double v, int side, double& s, double& t);

inline DVec3 unit(const DVec3& v) { return (1 / length(v)) * v; }
/// In degrees; 180 where one is not finite or is zero, as no frame is worse than none.
double angleDeg(const DVec3& a, const DVec3& b);

}  // namespace tspace::accuracy
