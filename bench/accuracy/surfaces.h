// SPDX-License-Identifier: MIT
// Surfaces given by formulas, so that frames are known exactly at every point.
#pragma once

#include <span>

#include "core/base/vec_math.h"
#include "dual.h"

namespace tspace::accuracy {

struct SurfacePoint {
    Dual position[3], uv[2];
};

/// Mapping from the unit square, (s, t), to space and to the texture.
struct Surface {
    const char* name;
    /// `side`: -1 or 1, the side of the fold to which a point on the fold is assigned.
    SurfacePoint (*at)(const Dual& s, const Dual& t, int side);
    /// The s of the line along which the UV map is mirrored (the fold), or -1 if there is none.
    double fold = -1;
    bool is_flat = false;
};

/// Returns the surfaces used for the documented results.
std::span<const Surface> surfaces();
/// Returns held-out surfaces, which were not used for tuning and are reported separately.
std::span<const Surface> heldOutSurfaces();

/// Exact frame of a point.
struct ExactFrame {
    DVec3 position = {}, normal = {};
    DVec3 tangent = {}, bitangent = {};  ///< dP/du and dP/dv, not unit
    double u = 0, v = 0;
    double sign = 1;  ///< sign of the UV orientation

    /// Returns the unit tangent after projection onto the plane perpendicular to `n`.
    [[nodiscard]] DVec3 tangentAcross(const DVec3& n) const;
};

ExactFrame exactFrame(const Surface& surface, double s, double t, int side);

/// Moves (s, t) to the point with texture coordinates (u, v), by Newton's method from a nearby start.
void findUv(const Surface& surface, double u, double v, int side, double& s, double& t);

inline DVec3 unit(const DVec3& v) { return (1 / length(v)) * v; }
/// Returns the angle in degrees. Returns 180 if a vector is zero or not finite, so that a missing frame does not count
/// as good.
double angleDeg(const DVec3& a, const DVec3& b);

}  // namespace tspace::accuracy
