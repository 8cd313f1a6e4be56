// SPDX-License-Identifier: MIT
// Values that a stored tangent must have whatever the UVs are: finite, unit, a sign of +1 or -1, and not along N.
#pragma once

#include <cmath>

#include "core/base/unit.h"
#include "tspace/vec.h"

namespace tspace {

/// Lengths of normals and tangents below cannot be told from zero.
inline constexpr double kShortest = 1e-6;
/// How far lengths may be from 1: what the glTF validator allows.
inline constexpr double kMostFromUnit = 0.00674;
/// A tangent within 5 degrees of N or of its opposite makes no frame: cross(N, T) is next to nothing, and a shader that
/// normalises it gets NaN, or a direction by chance.
inline constexpr double kParallelDeg = 5;
inline constexpr double kParallelCosine = 0.99619469809174555;  ///< of kParallelDeg

/// Finite, with a length, and not along N. A normal without a direction is not looked at.
inline bool hasDirection(const Vec4& tangent, const Vec3& normal) {
    DVec3 n = toDouble(normal), t = toDouble(xyz(tangent));
    if (!isFinite(xyz(tangent)) || length(t) < kShortest) return false;
    return !normalize(n) || !normalize(t) || std::fabs(dot(n, t)) <= kParallelCosine;
}

/// Whether the glTF format allows it.
inline bool hasSoundValues(const Vec4& tangent) {
    return isFinite(xyz(tangent)) && std::fabs(length(toDouble(xyz(tangent))) - 1) <= kMostFromUnit &&
           (tangent.w == 1 || tangent.w == -1);
}

}  // namespace tspace
