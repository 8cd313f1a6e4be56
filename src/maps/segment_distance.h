// SPDX-License-Identifier: MIT
// How far a point is from a segment.
#pragma once

#include <algorithm>

#include "core/base/vec_math.h"

namespace tspace {

/// Where on the segment from a (0) to b (1) it is nearest to the point.
inline double nearestPart(const DVec3& point, const DVec3& a, const DVec3& b) {
    const DVec3 edge = b - a;
    const double squared = dot(edge, edge);
    return squared > 0 ? std::clamp(dot(point - a, edge) / squared, 0.0, 1.0) : 0.0;
}

/// The square of the distance.
inline double squaredDistanceTo(const DVec3& point, const DVec3& a, const DVec3& b) {
    const DVec3 away = point - a - nearestPart(point, a, b) * (b - a);
    return dot(away, away);
}

}  // namespace tspace
