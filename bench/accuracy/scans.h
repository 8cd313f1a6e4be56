// SPDX-License-Identifier: MIT
// Meshes like those of scanners and generators, irregular and noisy, of shapes whose normals are known everywhere.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "random.h"
#include "tspace/mesh.h"

namespace tspace::accuracy {

/// A shape, given by its signed distance function: negative inside.
struct Shape {
    const char* name;
    double (*distance)(const DVec3& p);
    bool is_sharp = false;

    [[nodiscard]] DVec3 normalAt(const DVec3& p) const;
    /// Returns the closest surface point for a nearby point.
    [[nodiscard]] DVec3 nearest(DVec3 p) const;
};

/// Blended ellipsoids, a torus, a rounded box; then a part with holes, and a gear.
std::span<const Shape> shapes();
/// A hand, ripples, links; then a nut, steps, a bracket. Not used for tuning.
std::span<const Shape> heldOutShapes();
/// Shapes of drawnMeshes(): a torus and a cylinder with a fillet of 0.16; then a cylinder and a slab.
std::span<const Shape> drawnShapes();

struct Scan {
    const Shape* shape;
    std::vector<Vec3> positions = {};
    std::vector<std::uint32_t> indices = {};  ///< triangles

    [[nodiscard]] MeshView view() const { return {.positions = positions, .indices = {indices}}; }
};

/// Returns surface nets on a grid of cells^3, with the points moved onto the surface and then, in each direction, by a
/// normal distribution whose standard deviation is `noise` of the mean edge.
/// Based on: Gibson, "Constrained Elastic Surface Nets", 1998.
Scan scan(const Shape& shape, int cells, double noise, Random random);

/// Return surface nets, or marching cubes, unmodified: the noise is in the field, in cells.
/// Based on: Lorensen & Cline, "Marching Cubes", 1987; two diagonal corners inside on a face are separated.
Scan surfaceNets(const Shape& shape, int cells, double noise, Random random);
Scan marchingCubes(const Shape& shape, int cells, double noise, Random random);

/// Applies meshoptimizer's simplifier; empty if the bench was built without it. share: of the triangles
Scan decimated(const Scan& scan, double share);

/// Returns meshes as triangulated by CAD kernels: long strips, caps that are fans from one vertex of the rim, fillets
/// with few segments.
std::vector<Scan> drawnMeshes(bool is_sharp);

/// Returns the mean angle, in degrees, between normals as interpolated by shaders and normals of the shape, at points
/// distributed by area. normals: one per corner
double shadedError(const Scan& scan, const std::vector<Vec3>& normals, int points, Random random);

}  // namespace tspace::accuracy
