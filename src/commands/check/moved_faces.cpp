// SPDX-License-Identifier: MIT
#include "commands/check/moved_faces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/unique_index.h"

namespace tspace {
namespace {

constexpr std::uint32_t kNoPoint = 0xffffffffu;
/// Maximum number of examined triangles per polygon, and of directions around a point. The limits keep the time linear.
constexpr std::size_t kMaxOfPolygon = 64, kMaxFaces = 64;

/// A primitive and the offsets of one of its targets.
struct MovedPrimitive {
    const ScenePrimitive& primitive;
    std::span<const Vec3> offsets;

    [[nodiscard]] std::size_t triangleCount() const { return primitive.corners.size() / 3; }
    [[nodiscard]] std::uint32_t vertexAt(std::size_t corner) const { return primitive.corners[corner]; }
    [[nodiscard]] DVec3 positionAt(std::uint32_t vertex, bool is_moved) const {
        const DVec3 base = toDouble(primitive.positions[vertex]);
        return is_moved ? base + toDouble(offsets[vertex]) : base;
    }
    /// Returns the normal of a triangle with twice its area as length.
    [[nodiscard]] DVec3 crossOf(std::size_t triangle, bool is_moved) const {
        const auto at = [&](std::size_t k) { return positionAt(vertexAt(3 * triangle + k), is_moved); };
        return cross(at(1) - at(0), at(2) - at(0));
    }
};

/// Returns the key of a vertex. Vertices with equal positions and equal offsets have equal keys and are one point.
std::array<std::uint32_t, 6> pointKey(const MovedPrimitive& moved, std::uint32_t vertex) {
    const Vec3 &p = moved.primitive.positions[vertex], &o = moved.offsets[vertex];
    return {weldBits(p.x), weldBits(p.y), weldBits(p.z), weldBits(o.x), weldBits(o.y), weldBits(o.z)};
}

struct Box {
    Vec3 least = {HUGE_VALF, HUGE_VALF, HUGE_VALF}, most = {-HUGE_VALF, -HUGE_VALF, -HUGE_VALF};

    void add(const Vec3& p) {
        least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
        most = {std::max(most.x, p.x), std::max(most.y, p.y), std::max(most.z, p.z)};
    }
    [[nodiscard]] bool has(const Vec3& p) const {
        return p.x >= least.x && p.x <= most.x && p.y >= least.y && p.y <= most.y && p.z >= least.z && p.z <= most.z;
    }
};

/// Returns whether two triangles that are consecutive in the file belong to one flat polygon: exporters write the
/// triangles of a polygon consecutively.
bool isOnePolygon(const MovedPrimitive& moved, std::size_t a, std::size_t b) {
    constexpr double kFlat = 0.9998;  // cosine of about 1 degree
    int common = 0;
    for (std::size_t k = 0; k < 9; ++k)
        common += moved.vertexAt(3 * a + k / 3) == moved.vertexAt(3 * b + k % 3) ? 1 : 0;
    DVec3 of_a = moved.crossOf(a, false), of_b = moved.crossOf(b, false);
    return common == 2 && normalize(of_a) && normalize(of_b) && dot(of_a, of_b) >= kFlat;
}

}  // namespace

MovedFaces::MovedFaces(const ScenePrimitive& primitive, std::span<const ScenePrimitive> all, std::size_t number,
                       std::span<const std::uint32_t> vertices) {
    const MovedPrimitive own{primitive, primitive.morph_targets[number].positions.span()};
    UniqueIndex<std::array<std::uint32_t, 6>> points(vertices.size());
    Box box;
    for (const std::uint32_t vertex : vertices) {
        point_of_.push_back(points.indexOf(pointKey(own, vertex)));
        box.add(primitive.positions[vertex]);
    }
    faces_.resize(points.size());
    // Directions that are equal are added once, so that the mean does not depend on the triangulation.
    const auto addFace = [&](const MovedPrimitive& moved, std::size_t triangle, std::uint32_t point) {
        constexpr double kSame = 0.9998, kCollapsed = 1e-4;
        Face face{moved.crossOf(triangle, false), moved.crossOf(triangle, true)};
        const double before = length(face.base), after = length(face.moved);
        if (before == 0 && after == 0) return;
        if (!(after >= kCollapsed * before && before >= kCollapsed * after)) faces_[point].is_degenerate = true;
        if (!normalize(face.base) || !normalize(face.moved)) return;
        std::vector<Face>& faces = faces_[point].list;
        const bool is_known = std::any_of(faces.begin(), faces.end(), [&](const Face& other) {
            return dot(other.moved, face.moved) >= kSame && dot(other.base, face.base) >= kSame;
        });
        if (!is_known && faces.size() < kMaxFaces) faces.push_back(face);
    };
    const auto addFaces = [&](const MovedPrimitive& moved) {
        for (std::size_t first = 0, end = 0; first < moved.triangleCount(); first = end) {
            end = first + 1;
            while (end < std::min(moved.triangleCount(), first + kMaxOfPolygon) && isOnePolygon(moved, end - 1, end))
                ++end;
            for (std::size_t corner = 3 * first; corner < 3 * end; ++corner) {
                const std::uint32_t vertex = moved.vertexAt(corner);
                if (!box.has(moved.primitive.positions[vertex])) continue;
                const std::uint32_t point = points.find(pointKey(moved, vertex));
                if (point == kNoPoint) continue;
                for (std::size_t triangle = first; triangle < end; ++triangle) addFace(moved, triangle, point);
            }
        }
    };
    addFaces(own);
    for (const ScenePrimitive& other : all) {
        if (&other == &primitive || other.mesh != primitive.mesh || number >= other.morph_targets.size()) continue;
        const SharedArray<Vec3>& offsets = other.morph_targets[number].positions;
        if (offsets.size() == other.positions.size()) addFaces({other, offsets.span()});
    }
}

bool MovedFaces::admit(std::size_t i, const DVec3& normal, const VertexRotation& turn, bool is_hard,
                       double slack) const {
    constexpr double kHard = 0.17364817766693034;  // cosine of 80 degrees
    if (faces_[point_of_[i]].is_degenerate) return true;
    const DVec3 from = toDouble(turn.from), to = toDouble(turn.to);
    const auto forFaces = [&](const auto& visit) {
        for (const Face& face : faces_[point_of_[i]].list) {
            if (!is_hard || dot(face.moved, to) >= kHard || dot(face.base, from) >= kHard) visit(face.moved);
        }
    };
    DVec3 mean{};
    forFaces([&](const DVec3& face) { mean = mean + face; });
    if (!normalize(mean)) return true;
    double widest = angleBetween(mean, to);
    forFaces([&](const DVec3& face) { widest = std::max(widest, angleBetween(mean, face)); });
    return angleBetween(mean, normal) <= widest + slack;
}

}  // namespace tspace
