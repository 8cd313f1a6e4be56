// SPDX-License-Identifier: MIT
#include "core/mesh/pools/primitive.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/vec_math.h"
#include "core/mesh/surface/surface.h"
#include "tspace/frame.h"
#include "tspace/tangents.h"

namespace tspace {
namespace {

/// Cosine of 10 degrees, the direction tolerance of `check`.
constexpr double kSameTangent = 0.98480775301220802;

bool isNear(const Vec4& a, const Vec4& b) {
    DVec3 ta = toDouble(xyz(a)), tb = toDouble(xyz(b));
    return normalize(ta) && normalize(tb) && dot(ta, tb) >= kSameTangent;
}

/// Returns whether the triangle of a corner determines the correct sign.
bool determinesSign(const PoolView& pool, std::span<const std::uint32_t> corners, std::size_t corner) {
    const std::uint32_t* const v = corners.data() + corner / 3 * 3;
    const std::array<Vec2, 3> uvs{pool.uvs[v[0]], pool.uvs[v[1]], pool.uvs[v[2]]};
    return describeFace({pool.positions[v[0]], pool.positions[v[1]], pool.positions[v[2]]}, &uvs).orientation != 0;
}

std::uint8_t partsOf(const Repairs& repairs, std::uint32_t vertex) {
    const auto found =
        std::lower_bound(repairs.vertices.begin(), repairs.vertices.end(), vertex,
                         [](const VertexRepair& repair, std::uint32_t wanted) { return repair.vertex < wanted; });
    return found != repairs.vertices.end() && found->vertex == vertex ? found->parts : std::uint8_t{0};
}

Vec4 withDirection(const DVec3& direction, float sign) {
    const Vec3 t = toFloat(direction);
    return {t.x, t.y, t.z, sign};
}

/// Returns the tangent made perpendicular to N; unchanged if it is parallel to N.
Vec4 orthogonalToNormal(const Vec4& tangent, const Vec3& normal) {
    DVec3 n = toDouble(normal), t = toDouble(xyz(tangent));
    if (!normalize(n)) return tangent;
    t = t - dot(n, t) * n;
    return normalize(t) ? withDirection(t, tangent.w) : tangent;
}

/// Returns the kept tangent, repaired independently of the triangles around it.
Vec4 repairedAlone(const Vec4& kept, const Vec4& computed, const Vec3& normal, std::uint8_t parts) {
    Vec4 tangent = withValidValues(kept, computed, normal);
    if ((parts & repair::kStraighten) != 0) tangent = orthogonalToNormal(tangent, normal);
    if ((parts & repair::kTurnSign) != 0) tangent.w = -tangent.w;
    return tangent;
}

constexpr double kUnitTolerance = 5e-4;  // tolerance for unit length, as in sanitize.cpp
// Sine of the maximum angle between a bitangent and the plane perpendicular to N. Normals with few bits are not unit,
// which rotates tangents out of this plane by up to a degree.
constexpr double kOffPlane = 0.05;
constexpr double kSameDirection = 0.99;  // cosine of 8 degrees
// Minimum triple product of a frame; the frame of UVs sheared by 89.9 degrees has 0.0017.
constexpr double kSide = 1e-4;

/// Returns the unit vector of v, or zero if v has no direction.
DVec3 unitOrZero(const DVec3& v) {
    const double size = length(v);
    return size > 0 && std::isfinite(size) ? (1 / size) * v : DVec3{};
}

// Returns whether a bitangent is valid. The comparisons are written so that NaN is invalid.
bool isValidBitangent(const DVec3& b, const DVec3& n, const Vec4& computed, const Vec4& repaired) {
    const DVec3 t = toDouble(xyz(repaired));
    if (!(std::fabs(length(b) - 1) <= kUnitTolerance)) return false;
    if (!(dot(toDouble(xyz(computed)), t) >= kSameDirection) || computed.w != repaired.w) return false;
    if (dot(n, n) == 0) return true;
    return std::fabs(dot(n, b)) <= kOffPlane && double{repaired.w} * dot(cross(n, t), b) >= kSide;
}

}  // namespace

Vec4 withValidValues(const Vec4& kept, const Vec4& instead, const Vec3& normal) {
    const bool has_sign = std::isfinite(kept.w) && kept.w != 0;
    const float sign = (has_sign ? kept.w : instead.w) < 0 ? -1.0f : 1.0f;
    if (!hasDirection(kept, normal)) return {instead.x, instead.y, instead.z, sign};
    if (hasValidValues(kept)) return kept;
    DVec3 t = toDouble(xyz(kept));
    if (std::fabs(length(t) - 1) <= kMostFromUnit) return {kept.x, kept.y, kept.z, sign};
    normalize(t);
    return withDirection(t, sign);
}

Vec4 tangentFromNormal(const Vec3& normal, float sign) {
    const Vec3 t = orthonormalize({.tangent = {}, .bitangent = {}, .normal = normal}).tangent;
    return {t.x, t.y, t.z, sign};
}

Result<Done> repairValues(const TangentView& mesh, bool along_normals, std::span<Vec4> tangents) {
    const auto normalAt = [&](std::size_t v) { return mesh.normals.empty() ? Vec3{} : mesh.normals[v]; };
    const auto normalFor = [&](std::size_t v) { return along_normals ? Vec3{} : normalAt(v); };
    std::vector<bool> is_broken(tangents.size(), false);
    for (std::size_t v = 0; v < tangents.size(); ++v) {
        is_broken[v] = !hasDirection(tangents[v], normalFor(v));
        if (!is_broken[v]) tangents[v] = withValidValues(tangents[v], {}, normalFor(v));
    }
    // Invalid tangents get the tangent of other corners of their triangles, or else a basis from N.
    std::vector<Vec4> of_corners;
    for (const std::uint32_t v : mesh.corners) of_corners.push_back(is_broken[v] ? Vec4{} : tangents[v]);
    if (!mesh.normals.empty() && !mesh.corners.empty()) {
        const Result<SanitizeReport> repaired = sanitizeTangents(mesh.triangles(), {}, std::span(of_corners));
        if (!repaired) return repaired.error();
    }
    std::vector<Vec4> found(tangents.size(), Vec4{});
    for (std::size_t c = of_corners.size(); c-- > 0;) found[mesh.corners[c]] = of_corners[c];
    for (std::size_t v = 0; v < tangents.size(); ++v) {
        if (!is_broken[v]) continue;
        const bool is_found = hasValidValues(found[v]) && hasDirection(found[v], normalAt(v));
        tangents[v] =
            withValidValues(tangents[v], is_found ? found[v] : tangentFromNormal(normalAt(v), 1), normalFor(v));
    }
    return Done{};
}

std::vector<bool> repairCorners(const PoolView& pool, std::span<const std::uint32_t> corners, const Repairs& repairs,
                                std::span<Vec4> tangents) {
    std::vector<bool> has_new_deltas(corners.size(), false);
    for (std::size_t c = 0; c < corners.size(); ++c) {
        const std::uint8_t parts = partsOf(repairs, corners[c]);
        Vec4 computed = tangents[c];
        if (repairs.inverted_signs) computed.w = -computed.w;
        const Vec4 stays = repairedAlone(pool.kept_tangents[corners[c]], computed, pool.normals[corners[c]], parts);
        const bool needs_deltas = (parts & repair::kDeltas) != 0;
        bool is_new =
            (parts & repair::kWhole) != 0 || !hasDirection(pool.kept_tangents[corners[c]], pool.normals[corners[c]]);
        if ((parts & repair::kSides) != 0 && determinesSign(pool, corners, c))
            is_new = is_new || (stays.w > 0) != (computed.w > 0) || !isNear(stays, computed);
        // Deltas are valid only for the direction that they were computed for.
        is_new = is_new || (needs_deltas && !isNear(stays, computed));
        tangents[c] = is_new ? computed : stays;
        has_new_deltas[c] = is_new || needs_deltas;
    }
    return has_new_deltas;
}

Vec3 bitangentOf(const Vec4& tangent, const Vec3& normal) {
    const DVec3 t = unitOrZero(toDouble(xyz(tangent)));
    const DVec3 b = unitOrZero(cross(unitOrZero(toDouble(normal)), t));
    if (dot(b, b) == 0) return toFloat(planeAxes(dot(t, t) == 0 ? DVec3{0, 0, 1} : t).x);
    return toFloat((tangent.w < 0 ? -1.0 : 1.0) * b);
}

void repairBitangents(StridedSpan<const Vec3> normals, std::span<const std::uint32_t> indices,
                      std::span<const Vec4> computed, std::span<const Vec4> repaired, std::span<Vec3> bitangents) {
    for (std::size_t c = 0; c < indices.size(); ++c) {
        const Vec3& normal = normals[indices[c]];
        if (isValidBitangent(toDouble(bitangents[c]), unitOrZero(toDouble(normal)), computed[c], repaired[c])) continue;
        bitangents[c] = bitangentOf(repaired[c], normal);
    }
}

}  // namespace tspace
