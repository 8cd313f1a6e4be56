// SPDX-License-Identifier: MIT
// Which vectors have a direction, and scaling to length 1 that no finite vector defeats.
#pragma once

#include <algorithm>

#include "core/vec_math.h"

namespace tspace {

inline bool isZero(const Vec3& v) { return v.x == 0 && v.y == 0 && v.z == 0; }
inline bool isDirection(const Vec3& v) { return isFinite(v) && !isZero(v); }

/// Scales v to length 1; false, and v unchanged, when it is zero or not finite. The largest component is
/// brought to 1 first: squares of small products of floats would vanish even in double.
inline bool normalize(DVec3& v) {
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) return false;
    const double largest = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
    if (largest == 0) return false;
    const DVec3 scaled{v.x / largest, v.y / largest, v.z / largest};
    v = (1 / length(scaled)) * scaled;
    return true;
}

}  // namespace tspace
