// SPDX-License-Identifier: MIT
// How far a stored tangent is from anything that the triangles around it could give.
//
// Methods differ in how they weight triangles, but every one of them gives a direction between those of the triangles,
// seen in the plane that is perpendicular to N: inside their *cone*. So a tangent inside is never called wrong, whoever
// made it, and one outside is wrong for every method.
#pragma once

#include <span>
#include <vector>

#include "core/mesh/surface/surface.h"

namespace tspace {

/// An arc of directions in a plane, in radians.
struct DirectionCone {
    double begin = 0;
    double width = -1;  ///< below 0: no direction at all; 2 pi: every direction

    [[nodiscard]] bool empty() const { return width < 0; }
    /// Radians from `angle` to the nearest direction inside.
    [[nodiscard]] double distanceTo(double angle) const;
};

/// The smallest cone around `angles` (any order, which is changed); every direction where they leave no gap of half a
/// turn.
DirectionCone coneAround(std::span<double> angles);

/// No triangle around the vertex has a direction, or its N or tangent cannot be used; or the tangent is far
/// from the directions of triangles that are all so thin there, seen along N, that MikkTSpace gives them no weight.
inline constexpr float kUnknownDirection = -1;

/// Per vertex the distance in degrees between its tangent and the cone of the triangles that use it; where that is more
/// than `tolerance_deg`, the cone of all triangles of the same orientation around vertices with equal position, normal
/// and UV, which is how MikkTSpace averages. Expected near-linear time.
std::vector<float> directionDistances(const TangentView& mesh, const Surface& surface, double tolerance_deg);

/// Cones by class: `class_of_vertex` names the class of each vertex (kNoClass: none); vertices of one class have equal
/// normals.
inline constexpr std::uint32_t kNoClass = 0xffffffffu;
std::vector<DirectionCone> conesOfClasses(const TangentView& mesh, const Surface& surface,
                                          std::span<const std::uint32_t> class_of_vertex, std::size_t class_count);

/// The direction of v in the plane perpendicular to N, or nothing in `found` when there is none: N or v is zero or not
/// finite, or v is nearly parallel to N.
double planeAngle(const Vec3& normal, const Vec3& v, bool& found);

/// Orientations of the UVs of the triangles at each vertex. Bit 0: positive, bit 1: negative.
std::vector<std::uint8_t> vertexOrientations(const TangentView& mesh, const Surface& surface);

}  // namespace tspace
