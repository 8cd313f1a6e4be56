// SPDX-License-Identifier: MIT
#include "core/mesh/pools/mend_bitangents.h"

#include <cmath>

#include "core/base/unit.h"
#include "core/base/vec_math.h"

namespace tspace {

namespace {

constexpr double kUnitTolerance = 5e-4;  // that of sanitize
constexpr double kOffPlane = 0.05;       // sine; normals of few bits are not unit, and tangents lean by a degree there
constexpr double kSameDirection = 0.99;  // cosine of 8 degrees
// Of the triple product: UVs that are sheared by 89.9 degrees have 0.0017.
constexpr double kSide = 1e-4;

/// Zero where it has no direction.
DVec3 unitOrZero(const DVec3& v) {
    const double size = length(v);
    return size > 0 && std::isfinite(size) ? (1 / size) * v : DVec3{};
}

// Written so that NaN is not sound.
bool isSound(const DVec3& b, const DVec3& n, const Vec4& computed, const Vec4& mended) {
    const DVec3 t = toDouble(xyz(mended));
    if (!(std::fabs(length(b) - 1) <= kUnitTolerance)) return false;
    if (!(dot(toDouble(xyz(computed)), t) >= kSameDirection) || computed.w != mended.w) return false;
    if (dot(n, n) == 0) return true;
    return std::fabs(dot(n, b)) <= kOffPlane && double{mended.w} * dot(cross(n, t), b) >= kSide;
}

}  // namespace

Vec3 bitangentOf(const Vec4& tangent, const Vec3& normal) {
    const DVec3 t = unitOrZero(toDouble(xyz(tangent)));
    const DVec3 b = unitOrZero(cross(unitOrZero(toDouble(normal)), t));
    if (dot(b, b) == 0) return toFloat(planeAxes(dot(t, t) == 0 ? DVec3{0, 0, 1} : t).x);
    return toFloat((tangent.w < 0 ? -1.0 : 1.0) * b);
}

void mendBitangents(StridedSpan<const Vec3> normals, std::span<const std::uint32_t> indices,
                    std::span<const Vec4> computed, std::span<const Vec4> mended, std::span<Vec3> bitangents) {
    for (std::size_t c = 0; c < indices.size(); ++c) {
        const Vec3& normal = normals[indices[c]];
        if (isSound(toDouble(bitangents[c]), unitOrZero(toDouble(normal)), computed[c], mended[c])) continue;
        bitangents[c] = bitangentOf(mended[c], normal);
    }
}

}  // namespace tspace
