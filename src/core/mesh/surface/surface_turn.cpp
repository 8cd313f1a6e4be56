// SPDX-License-Identifier: MIT
// Rotation between two unit vectors: Moeller & Hughes, "Efficiently Building a Matrix to Rotate One Vector to Another", 1999.
#include "core/mesh/surface/surface_turn.h"

#include <algorithm>
#include <array>

#include "core/base/angle.h"
#include "core/base/unique_index.h"
#include "core/base/unit.h"
#include "core/mesh/surface/equal_vertices.h"

namespace tspace {

namespace {

/// A mean below this part of its weights has no direction: the triangles cancel out.
constexpr double kVanished = 1e-3;
/// Ratio of areas below which a triangle has collapsed: a hundredth of each side.
constexpr double kCollapsed = 1e-4;
/// Beside the square of the longest edge: what rounding leaves of a triangle without area.
constexpr double kThin = 1e-6;

struct Fan {
    DVec3 from = {}, to = {};
    double from_weight = 0, to_weight = 0;
    bool is_certain = true;
};

struct Triangle {
    std::array<DVec3, 3> positions;
    DVec3 normal = {};  ///< twice the area long, then unit
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

/// A normal of zero is near everything.
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

Vec3 VertexTurn::apply(const Vec3& normal) const {
    const DVec3 a = toDouble(from), b = toDouble(to), n = toDouble(normal), v = cross(a, b);
    const double c = dot(a, b);
    constexpr double kOpposite = 1e-6;  // any axis would do
    if (!isKnown() || from == to || 1 + c < kOpposite) return normal;
    return toFloat(c * n + cross(v, n) + (dot(v, n) / (1 + c)) * v);
}

SurfaceTurns::SurfaceTurns(std::span<const Vec3> positions, std::span<const Vec3> normals,
                           std::span<const std::uint32_t> corners)
    : positions_(positions),
      corners_(corners),
      class_of_(findEqualVertices(StridedSpan<const Vec3>(positions), StridedSpan<const Vec3>(normals), {}).class_of) {}

std::vector<VertexTurn> SurfaceTurns::under(std::span<const Vec3> offsets) const {
    UniqueIndex<std::array<std::uint32_t, 4>> keys(positions_.size());
    std::vector<std::uint32_t> fan_of(positions_.size());
    for (std::size_t v = 0; v < fan_of.size(); ++v) {
        const Vec3& offset = offsets[v];
        fan_of[v] = keys.indexOf({class_of_[v], weldBits(offset.x), weldBits(offset.y), weldBits(offset.z)});
    }
    std::vector<Fan> fans(keys.size());
    std::vector<std::array<Vec3, 2>> normals;  // of each triangle, before and after
    for (std::size_t c = 0; c + 2 < corners_.size(); c += 3) {
        const auto old = [&](std::size_t k) { return toDouble(positions_[corners_[c + k]]); };
        const auto moved = [&](std::size_t k) { return old(k) + toDouble(offsets[corners_[c + k]]); };
        const Triangle from({old(0), old(1), old(2)}), to({moved(0), moved(1), moved(2)});
        normals.push_back({from.is_thin ? Vec3{} : toFloat(from.normal), to.is_thin ? Vec3{} : toFloat(to.normal)});
        const bool is_certain = !from.is_thin && !to.is_thin && to.area >= kCollapsed * from.area;
        for (std::size_t k = 0; k < 3; ++k) {
            Fan& fan = fans[fan_of[corners_[c + k]]];
            add(from, k, fan.from, fan.from_weight);
            add(to, k, fan.to, fan.to_weight);
            // A triangle that is thin before and after does not make the turn uncertain.
            fan.is_certain = fan.is_certain && (is_certain || (from.is_thin && to.is_thin));
        }
    }
    for (std::size_t t = 0; t < normals.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            Fan& fan = fans[fan_of[corners_[3 * t + k]]];
            fan.is_certain = fan.is_certain && isNear(normals[t][0], fan.from) && isNear(normals[t][1], fan.to);
        }
    }
    std::vector<VertexTurn> turns(fan_of.size());
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
