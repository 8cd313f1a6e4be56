// SPDX-License-Identifier: MIT
// Distance of a stored tangent from all results that methods can compute from the triangles around it.
//
// Methods weight triangles differently, but each returns a direction between those of the triangles, projected to the
// plane perpendicular to N: inside their *cone*. So a tangent inside the cone is never reported as wrong, whichever
// method computed it, and a tangent outside is wrong for every method.
#pragma once

#include <span>
#include <vector>

#include "core/mesh/surface/surface.h"

namespace tspace {

/// Arc of directions in a plane, in radians.
struct DirectionCone {
    double begin = 0;
    double width = -1;  ///< negative: no direction; 2 pi: every direction

    [[nodiscard]] bool empty() const { return width < 0; }
    /// Returns the angle in radians between `angle` and the nearest direction in the cone.
    [[nodiscard]] double distanceTo(double angle) const;
};

/// Returns the smallest cone that contains `angles`, which are reordered. It contains every direction if there is no
/// gap of more than half a turn.
DirectionCone coneAround(std::span<double> angles);

/// Distance of a vertex that cannot be tested. Either no triangle around it has a direction, or its N or tangent is
/// unusable. Or its tangent is far from the directions of all its triangles, but these are so thin at the vertex, seen
/// along N, that MikkTSpace does not weight them.
inline constexpr float kUnknownDirection = -1;

/// Returns, per vertex, the angle in degrees between its tangent and the cone of the triangles that use it. If the
/// angle exceeds `tolerance_deg`, the cone also includes the triangles of the same orientation around vertices with
/// equal position, normal and UV, because MikkTSpace averages over them. Expected near-linear time.
std::vector<float> directionDistances(const TangentView& mesh, const Surface& surface, double tolerance_deg);

/// Class of vertices that belong to no class.
inline constexpr std::uint32_t kNoClass = 0xffffffffu;
/// Returns one cone per class. `class_of_vertex`: class of each vertex (kNoClass: none); vertices of one class have
/// equal normals.
std::vector<DirectionCone> conesOfClasses(const TangentView& mesh, const Surface& surface,
                                          std::span<const std::uint32_t> class_of_vertex, std::size_t class_count);

/// Returns the angle of v in the plane perpendicular to N. Sets `found` to false if there is none: N or v is zero or
/// not finite, or v is nearly parallel to N.
double planeAngle(const Vec3& normal, const Vec3& v, bool& found);

/// Returns which UV orientations the triangles at each vertex have. Bit 0: positive, bit 1: negative.
std::vector<std::uint8_t> vertexOrientations(const TangentView& mesh, const Surface& surface);

}  // namespace tspace
