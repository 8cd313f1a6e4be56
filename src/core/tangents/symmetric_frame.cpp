// SPDX-License-Identifier: MIT
// The orthonormal frame that is nearest to dP/du and dP/dv, of which neither comes before the other.
// Based on: Löwdin, "On the Non-Orthogonality Problem", 1950 (symmetric orthogonalisation), for two unit
// vectors.
#include "core/tangents/symmetric_frame.h"

#include "core/base/unit.h"

namespace tspace {

Vec3 symmetricTangent(const Vec3& tangent, const Vec3& bitangent, const Vec3& normal) {
    DVec3 n = toDouble(normal);
    if (!normalize(n)) return tangent;
    const auto across = [&](const Vec3& v) { return toDouble(v) - dot(n, toDouble(v)) * n; };
    DVec3 t = across(tangent), b = across(bitangent);
    if (!normalize(t) || !normalize(b)) return tangent;
    // Perpendicular to the bitangent, on the tangent's side: of the two such directions the one that a
    // mirrored UV map, or a turned normal, asks for.
    DVec3 p = cross(b, n);
    if (dot(p, t) < 0) p = -1.0 * p;
    DVec3 sum = t + p;
    return normalize(sum) ? toFloat(sum) : tangent;
}

}  // namespace tspace
