// SPDX-License-Identifier: MIT
// Meshes as scanners and generators make them, irregular and noisy, of shapes whose normals are known everywhere.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "random.h"
#include "tspace/mesh.h"

namespace tspace::accuracy {

/// A shape by its distance function: negative inside.
struct Shape {
    const char* name;
    double (*distance)(const DVec3& p);
    bool is_sharp = false;

    [[nodiscard]] DVec3 normalAt(const DVec3& p) const;
    /// The point of the surface next to one that is near to it.
    [[nodiscard]] DVec3 nearest(DVec3 p) const;
};

/// Blended ellipsoids, a torus, a rounded box; then a part with holes, and a gear.
std::span<const Shape> shapes();
/// A hand, ripples, links; then a nut, steps, a bracket. Nothing was tried on these.
std::span<const Shape> heldOutShapes();
/// Those of drawnMeshes(): a torus and a cylinder with a fillet of 0.16; then a cylinder and a slab.
std::span<const Shape> drawnShapes();

struct Scan {
    const Shape* shape;
    std::vector<Vec3> positions = {};
    std::vector<std::uint32_t> indices = {};  ///< triangles

    [[nodiscard]] MeshView view() const { return {.positions = positions, .indices = {indices}}; }
};

/// The triangles of surface nets on a grid of cells^3, whose points are moved onto the surface, then in each direction by a
/// normal distribution whose deviation is `noise` of the mean edge.
/// Based on: Gibson, "Constrained Elastic Surface Nets", 1998.
Scan scan(const Shape& shape, int cells, double noise, Random random);

/// Surface nets, and marching cubes, as they come: the noise is on the field, in cells.
/// Based on: Lorensen & Cline, "Marching Cubes", 1987; on a face with two diagonal corners inside, these are apart.
Scan surfaceNets(const Shape& shape, int cells, double noise, Random random);
Scan marchingCubes(const Shape& shape, int cells, double noise, Random random);

/// meshoptimizer's simplifier; empty where the bench is built without it. share: of the triangles
Scan decimated(const Scan& scan, double share);

/// As CAD kernels cut them: long strips, caps that are fans from one vertex of the rim, fillets of few segments.
std::vector<Scan> drawnMeshes(bool is_sharp);

/// At points spread by area, the mean angle in degrees between normals as shaders interpolate them and those of the shape.
/// normals: one per corner
double shadedError(const Scan& scan, const std::vector<Vec3>& normals, int points, Random random);

}  // namespace tspace::accuracy
