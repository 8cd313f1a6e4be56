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
    /// Returns the surface point closest to p, which must be near the surface.
    [[nodiscard]] DVec3 nearest(DVec3 p) const;
};

/// Returns the shapes that were used for tuning. Smooth: blended ellipsoids, a torus, a rounded box. Sharp: a part with
/// holes, a gear.
std::span<const Shape> shapes();
/// Returns shapes that were not used for tuning. Smooth: a hand, ripples, links. Sharp: a nut, steps, a bracket.
std::span<const Shape> heldOutShapes();
/// Returns the shapes of drawnMeshes(). Smooth: a torus, a cylinder with a fillet of radius 0.16. Sharp: a cylinder, a
/// slab.
std::span<const Shape> drawnShapes();

struct Scan {
    const Shape* shape;
    std::vector<Vec3> positions = {};
    std::vector<std::uint32_t> indices = {};  ///< triangles

    [[nodiscard]] MeshView view() const { return {.positions = positions, .indices = {indices}}; }
};

/// Returns a surface net on a grid of cells^3. Its points are moved onto the surface, and then by noise: the standard
/// deviation per axis is `noise` times the mean edge length.
/// Based on: Gibson, "Constrained Elastic Surface Nets", 1998.
Scan scan(const Shape& shape, int cells, double noise, Random random);

/// Return a surface net, or the result of marching cubes, without moving its points onto the surface. The noise is in
/// the field: its standard deviation is `noise` cells. Marching cubes separates two diagonally opposite inside corners
/// of a face.
/// Based on: Lorensen & Cline, "Marching Cubes", 1987.
Scan surfaceNets(const Shape& shape, int cells, double noise, Random random);
Scan marchingCubes(const Shape& shape, int cells, double noise, Random random);

/// Applies meshoptimizer's simplifier. Returns an empty mesh if the bench was built without meshoptimizer. `share`: the
/// share of triangles to keep.
Scan decimated(const Scan& scan, double share);

/// Returns meshes as CAD kernels triangulate them: long strips, caps that are fans from one vertex of the rim, and
/// fillets with few segments.
std::vector<Scan> drawnMeshes(bool is_sharp);

/// Returns the mean angle, in degrees, between normals as interpolated by shaders and normals of the shape, at points
/// distributed by area. `normals`: one per corner.
double shadedError(const Scan& scan, const std::vector<Vec3>& normals, int points, Random random);

}  // namespace tspace::accuracy
