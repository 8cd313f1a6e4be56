// SPDX-License-Identifier: MIT
// Based on: Lengyel, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh", 2001 (dP/du of a triangle).
#include "core/mesh/surface/surface.h"

#include <algorithm>
#include <cmath>

#include "core/base/unit.h"
#include "core/base/uv_frame.h"

namespace tspace {

namespace {

/// The reference takes smaller determinants for zero.
constexpr double kSmallestDeterminant = 1.17549435e-38;

/// Whether the sign of the determinant survives rounding: of the UVs when they were stored as floats, and of a reader's
/// float arithmetic. 2^-23 is the largest relative error of a difference of floats.
bool isReliable(double determinant, const Vec2& a, const Vec2& b, const Vec2& c) {
    constexpr double kStep = 1.0 / (1 << 23);
    const double s1 = std::fabs(double{b.x} - double{a.x}), t1 = std::fabs(double{b.y} - double{a.y});
    const double s2 = std::fabs(double{c.x} - double{a.x}), t2 = std::fabs(double{c.y} - double{a.y});
    const double size =
        std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(b.x), std::fabs(b.y), std::fabs(c.x), std::fabs(c.y)});
    const double stored = kStep * size * (s1 + t1 + s2 + t2);
    const double computed = 4 * kStep * (s1 * t2 + s2 * t1);
    return std::fabs(determinant) > stored + computed;
}

}  // namespace

bool facesNormal(const SurfaceFrame& face, const Vec3& normal) {
    constexpr double kLeastFacing = 0.05;
    DVec3 n = toDouble(normal);
    return normalize(n) && dot(n, toDouble(face.normal)) >= kLeastFacing;
}

SurfaceFrame describeFace(const std::array<Vec3, 3>& positions, const std::array<Vec2, 3>* uvs, double position_error) {
    SurfaceFrame face;
    const auto& [a, b, c] = positions;
    DVec3 normal = cross(toDouble(b) - toDouble(a), toDouble(c) - toDouble(a));
    const double area = 0.5 * length(normal);
    if (!std::isfinite(area) || a == b || b == c || c == a) return face;
    face.area = static_cast<float>(area);
    if (normalize(normal)) face.normal = toFloat(normal);
    if (uvs == nullptr) return face;
    const auto& [ua, ub, uc] = *uvs;
    const UvFrame frame = uvFrame(a, b, c, ua, ub, uc);
    if (!(std::fabs(frame.determinant) > kSmallestDeterminant) || !hasUvArea(frame.determinant)) return face;
    DVec3 tangent = (frame.determinant < 0 ? -1.0 : 1.0) * frame.tangent;
    if (position_error > 0) {
        // t2 (P1 - P0) - t1 (P2 - P0) is linear in the positions.
        const double t1 = double{ub.y} - ua.y, t2 = double{uc.y} - ua.y;
        const double off = position_error * (std::fabs(t2 - t1) + std::fabs(t2) + std::fabs(t1));
        const double size = length(tangent);
        face.tangent_error = static_cast<float>(off < size ? off / size : 1.0);
    }
    if (!normalize(tangent)) return face;
    face.tangent = toFloat(tangent);
    if (isReliable(frame.determinant, ua, ub, uc)) face.orientation = frame.determinant < 0 ? -1 : 1;
    return face;
}

Surface describeSurface(const TangentView& mesh) {
    Surface surface;
    const std::span<const std::uint32_t> corners = mesh.corners;
    surface.rounding = roundingOf(mesh.positions, mesh.uvs, {&corners, 1}, mesh.position_step);
    const double off = surface.rounding.error;
    surface.faces.reserve(mesh.corners.size() / 3);
    surface.vertex_areas.assign(mesh.positions.size(), 0.0);
    surface.known_areas.assign(mesh.positions.size(), 0.0);
    for (std::size_t c = 0; c + 2 < mesh.corners.size(); c += 3) {
        const std::uint32_t* const v = mesh.corners.data() + c;
        const std::array<Vec3, 3> positions{mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]]};
        if (mesh.uvs.empty()) {
            surface.faces.push_back(describeFace(positions, nullptr, off));
        } else {
            const std::array<Vec2, 3> uvs{mesh.uvs[v[0]], mesh.uvs[v[1]], mesh.uvs[v[2]]};
            surface.faces.push_back(describeFace(positions, &uvs, off));
        }
        const double area = surface.faces.back().area;
        const double known = surface.faces.back().orientation == 0 ? 0 : area;
        surface.area += area;
        surface.known_area += known;
        for (std::size_t k = 0; k < 3; ++k) {
            surface.vertex_areas[mesh.corners[c + k]] += area / 3;
            surface.known_areas[mesh.corners[c + k]] += known / 3;
        }
    }
    return surface;
}

}  // namespace tspace
