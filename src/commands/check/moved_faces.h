// SPDX-License-Identifier: MIT
// Directions of faces after a morph target, over all primitives of a mesh. Exporters split meshes at material borders
// and triangulate polygons, but compute normals from the whole mesh.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/vec_math.h"
#include "core/mesh/surface/surface.h"
#include "model/scene/scene.h"

namespace tspace {

class MovedFaces {
  public:
    /// Collects the faces around `vertices` of a primitive, before and after morph target `number`. `all`: primitives
    /// of the scene; faces of all primitives of the same mesh are collected. Time: linear in the triangles of the
    /// primitives whose bounding boxes overlap the vertices.
    MovedFaces(const ScenePrimitive& primitive, std::span<const ScenePrimitive> all, std::size_t number,
               std::span<const std::uint32_t> vertices);

    /// Returns whether smoothing of faces around vertices[i] can result in the unit normal `normal`, within `slack`
    /// radians. `turn`: rotation, by the morph, of the faces that share the vertex's normal on the base mesh.
    /// `is_hard`: the base normal averages only those faces, so a face at more than 80 degrees to them on both the base
    /// and the morphed mesh is ignored.
    [[nodiscard]] bool admit(std::size_t i, const DVec3& normal, const VertexRotation& turn, bool is_hard,
                             double slack) const;

  private:
    /// Unit normals of a face before and after the morph.
    struct Face {
        DVec3 base = {}, moved = {};
    };
    struct Point {
        std::vector<Face> list = {};
        /// A face at this point is degenerate before or after the morph, so the mean normal depends on the face
        /// weights, and any normal is admitted.
        bool is_degenerate = false;
    };
    std::vector<Point> faces_ = {};
    std::vector<std::uint32_t> point_of_ = {};  ///< one per entry of `vertices`
};

}  // namespace tspace
