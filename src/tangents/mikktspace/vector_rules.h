// SPDX-License-Identifier: MIT
// The reference's rules for "not zero" and for normalising, which decide bits for tiny, zero and non-finite
// vectors.
#pragma once

#include <cfloat>
#include <cmath>

#include "core/vec_math.h"

namespace tspace::mikk {

/// Subnormal numbers, zero and NaN count as zero; infinity does not.
inline bool notZero(float x) { return std::fabs(x) > FLT_MIN; }
inline bool notZero(const Vec3& v) { return notZero(v.x) || notZero(v.y) || notZero(v.z); }

/// v divided by its length; a vector that counts as zero comes back as it is.
inline Vec3 unit(const Vec3& v) { return notZero(v) ? (1.0f / length(v)) * v : v; }

/// The unit vector of v without its part along n. n is used as given, never normalised.
inline Vec3 flatten(const Vec3& n, const Vec3& v) { return unit(v - dot(n, v) * n); }

}  // namespace tspace::mikk
