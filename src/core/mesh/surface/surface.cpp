// SPDX-License-Identifier: MIT
// Properties of single triangles, votes of UVs, equal vertices, and rotation of a moved surface. position_rounding.cpp
// and joined_pieces.cpp implement the rest of surface.h.
// Based on: Lengyel, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh", 2001 (dP/du of a triangle).
#include "core/mesh/surface/surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/unique_index.h"
#include "core/base/vec_math.h"

namespace tspace {
namespace {

/// Determinants below this value are treated as zero, as in the reference.
constexpr double kSmallestDeterminant = 1.17549435e-38;

/// Returns whether the sign of the determinant survives rounding: of the UVs when stored as floats, and of a reader's
/// float arithmetic. 2^-23 is the maximum relative error of a difference of floats.
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
        // dP/du is proportional to t2 (P1 - P0) - t1 (P2 - P0), which is linear in the positions.
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

std::vector<std::uint8_t> uvVotes(const MeshView& triangles) {
    const StridedSpan<const Vec3>& positions = triangles.positions;
    const StridedSpan<const Vec2>& uvs = triangles.uvs;
    std::vector<std::uint8_t> votes(triangles.cornerCount() / 3, 0);
    for (std::size_t t = 0; t < votes.size() && !uvs.empty(); ++t) {
        const IndexView& v = triangles.indices;
        const std::uint32_t a = v[3 * t], b = v[3 * t + 1], c = v[3 * t + 2];
        const std::array<Vec2, 3> face_uvs{uvs[a], uvs[b], uvs[c]};
        votes[t] = describeFace({positions[a], positions[b], positions[c]}, &face_uvs).orientation != 0;
    }
    return votes;
}

EqualVertices findEqualVertices(const StridedSpan<const Vec3>& positions, const StridedSpan<const Vec3>& normals,
                                const StridedSpan<const Vec2>& uvs) {
    UniqueIndex<std::array<std::uint32_t, 8>> keys(positions.count);
    EqualVertices result;
    result.class_of.resize(positions.count);
    for (std::size_t v = 0; v < positions.count; ++v) {
        const Vec3& p = positions[v];
        const Vec3 n = normals.empty() ? Vec3{} : normals[v];
        const Vec2 uv = uvs.empty() ? Vec2{} : uvs[v];
        result.class_of[v] = keys.indexOf({weldBits(p.x), weldBits(p.y), weldBits(p.z), weldBits(n.x), weldBits(n.y),
                                           weldBits(n.z), weldBits(uv.x), weldBits(uv.y)});
    }
    result.class_count = keys.size();
    return result;
}

EqualVertices findEqualVertices(const TangentView& mesh, bool with_uvs) {
    return findEqualVertices(mesh.positions, mesh.normals, with_uvs ? mesh.uvs : std::span<const Vec2>());
}

// Rotation between two unit vectors. Based on: Moeller & Hughes, "Efficiently Building a Matrix to Rotate One Vector to
// Another", 1999.

namespace {

/// Minimum length of a mean relative to its weights: a shorter mean has no direction, because the triangles cancel out.
constexpr double kVanished = 1e-3;
/// Ratio of areas below which a triangle has collapsed: each of its sides shrank to about a hundredth.
constexpr double kCollapsed = 1e-4;
/// Cosine of 150 degrees. A triangle that rotates further nearly collapses on the way, since vertices move along lines,
/// and may have been flipped. Then interpolating the normal linearly cannot give the triangle's normal at every morph
/// weight.
constexpr double kFlipped = -0.86602540378443865;
/// Ratio of the area to the squared longest edge below which the area is rounding noise.
constexpr double kThin = 1e-6;

struct Fan {
    DVec3 from = {}, to = {};
    double from_weight = 0, to_weight = 0;
    bool is_certain = true;
};

struct Triangle {
    std::array<DVec3, 3> positions;
    DVec3 normal = {};  ///< normal of the triangle: first with twice the area as its length, then unit
    double area = 0;
    bool is_thin = false;

    explicit Triangle(const std::array<DVec3, 3>& p) : positions(p) {
        normal = cross(p[1] - p[0], p[2] - p[0]);
        area = length(normal);
        const auto square = [](const DVec3& edge) { return dot(edge, edge); };
        const double longest = std::max({square(p[1] - p[0]), square(p[2] - p[1]), square(p[0] - p[2])});
        is_thin = !(area > kThin * longest) || !normalize(normal);
    }
    [[nodiscard]] double angleAt(std::size_t k) const {
        DVec3 next = positions[(k + 1) % 3] - positions[k], previous = positions[(k + 2) % 3] - positions[k];
        return normalize(next) && normalize(previous) ? angleBetween(next, previous) : 0;
    }
};

/// Returns whether a normal is near the mean; true for a zero normal.
bool isNear(const Vec3& normal, const DVec3& mean) {
    constexpr double kCosineOf40Degrees = 0.76604444311897801;
    return isZero(normal) || dot(toDouble(normal), mean) >= kCosineOf40Degrees * length(mean);
}

void add(const Triangle& triangle, std::size_t k, DVec3& sum, double& weight) {
    if (triangle.is_thin) return;
    const double angle = triangle.angleAt(k);
    sum = sum + angle * triangle.normal;
    weight += angle;
}

}  // namespace

Vec3 VertexRotation::apply(const Vec3& normal) const {
    const DVec3 a = toDouble(from), b = toDouble(to), n = toDouble(normal), v = cross(a, b);
    const double c = dot(a, b);
    constexpr double kOpposite = 1e-6;  // threshold for opposite vectors, which have no unique rotation axis
    if (!isKnown() || from == to || 1 + c < kOpposite) return normal;
    return toFloat(c * n + cross(v, n) + (dot(v, n) / (1 + c)) * v);
}

SurfaceRotations::SurfaceRotations(std::span<const Vec3> positions, std::span<const Vec3> normals,
                                   std::span<const std::uint32_t> corners)
    : positions_(positions), corners_(corners),
      class_of_(findEqualVertices(StridedSpan<const Vec3>(positions), StridedSpan<const Vec3>(normals), {}).class_of) {}

std::vector<VertexRotation> SurfaceRotations::under(std::span<const Vec3> offsets) const {
    UniqueIndex<std::array<std::uint32_t, 4>> keys(positions_.size());
    std::vector<std::uint32_t> fan_of(positions_.size());
    for (std::size_t v = 0; v < fan_of.size(); ++v) {
        const Vec3& offset = offsets[v];
        fan_of[v] = keys.indexOf({class_of_[v], weldBits(offset.x), weldBits(offset.y), weldBits(offset.z)});
    }
    std::vector<Fan> fans(keys.size());
    std::vector<std::array<Vec3, 2>> normals;  // normals of each triangle, before and after the movement
    for (std::size_t c = 0; c + 2 < corners_.size(); c += 3) {
        const auto old = [&](std::size_t k) { return toDouble(positions_[corners_[c + k]]); };
        const auto moved = [&](std::size_t k) { return old(k) + toDouble(offsets[corners_[c + k]]); };
        const Triangle from({old(0), old(1), old(2)}), to({moved(0), moved(1), moved(2)});
        normals.push_back({from.is_thin ? Vec3{} : toFloat(from.normal), to.is_thin ? Vec3{} : toFloat(to.normal)});
        const bool is_certain =
            !from.is_thin && !to.is_thin && to.area >= kCollapsed * from.area && dot(from.normal, to.normal) > kFlipped;
        for (std::size_t k = 0; k < 3; ++k) {
            Fan& fan = fans[fan_of[corners_[c + k]]];
            add(from, k, fan.from, fan.from_weight);
            add(to, k, fan.to, fan.to_weight);
            // A triangle that is thin before and after does not make the rotation uncertain.
            fan.is_certain = fan.is_certain && (is_certain || (from.is_thin && to.is_thin));
        }
    }
    for (std::size_t t = 0; t < normals.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            Fan& fan = fans[fan_of[corners_[3 * t + k]]];
            fan.is_certain = fan.is_certain && isNear(normals[t][0], fan.from) && isNear(normals[t][1], fan.to);
        }
    }
    std::vector<VertexRotation> turns(fan_of.size());
    for (std::size_t v = 0; v < turns.size(); ++v) {
        Fan fan = fans[fan_of[v]];
        if (!(length(fan.from) > kVanished * fan.from_weight) || !(length(fan.to) > kVanished * fan.to_weight))
            continue;
        if (!normalize(fan.from) || !normalize(fan.to)) continue;
        turns[v] = {toFloat(fan.from), toFloat(fan.to), fan.is_certain};
    }
    return turns;
}

}  // namespace tspace
