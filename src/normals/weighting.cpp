// SPDX-License-Identifier: MIT
// The weights of NormalWeighting.
// Based on: Gouraud 1971 (uniform); Thuermer & Wuethrich, "Computing Vertex Normals from Polygonal Facets",
// 1998 (angle); Max, "Weights for Computing Vertex Normals from Facet Normals", 1999 (max).
#include "normals/weighting.h"

#include "core/angle.h"

namespace tspace {

namespace {

/// The interior angle, so that a polygon weighs the same however it is cut: above pi where the corner is
/// reflex.
double interiorAngle(const DVec3& e1, const DVec3& e2, const DVec3& outward) {
    const DVec3 turn = cross(e1, e2);
    const double angle = polarAngle(dot(e1, e2), length(turn));
    return dot(turn, outward) < 0 ? 2 * kPi - angle : angle;
}

double maxWeight(const DVec3& e1, const DVec3& e2) {
    const double lengths = dot(e1, e1) * dot(e2, e2);
    return lengths > 0 ? length(cross(e1, e2)) / lengths : 0;
}

}  // namespace

double cornerWeight(const MeshView& mesh, const FaceTable& faces, const PointTable& points, NormalWeighting weighting,
                    double factor, std::uint32_t corner) {
    const std::uint32_t point = points.corner_points[corner];
    const std::uint32_t previous = faces.previous(corner);
    if (points.corner_points[previous] == point) return 0;
    std::uint32_t next = faces.next(corner);
    while (points.corner_points[next] == point) next = faces.next(next);  // ends: `previous` is another point

    const FaceNormal& normal = faces.normals[faces.corner_faces[corner]];
    if (weighting == NormalWeighting::uniform || weighting == NormalWeighting::flat) return 1;
    if (weighting == NormalWeighting::area) return normal.length;

    const DVec3 here = toDouble(mesh.positions[mesh.indices[corner]]);
    const DVec3 e1 = toDouble(mesh.positions[mesh.indices[next]]) - here;
    const DVec3 e2 = toDouble(mesh.positions[mesh.indices[previous]]) - here;
    if (weighting == NormalWeighting::max) return maxWeight(e1, e2);
    const double angle = interiorAngle(e1, e2, factor * normal.unit);
    return weighting == NormalWeighting::angle ? angle : angle * normal.length;
}

}  // namespace tspace
