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
    /// Collects faces around these vertices of a primitive under the target `number`. `all`: primitives of the scene,
    /// of which those of the same mesh are used. Linear in the triangles of the primitives whose bounding boxes overlap
    /// the vertices.
    MovedFaces(const ScenePrimitive& primitive, std::span<const ScenePrimitive> all, std::size_t number,
               std::span<const std::uint32_t> vertices);

    /// Returns whether smoothing of faces around vertices[i] can result in this unit normal, within `slack` radians.
    /// `turn`: rotation of the faces that share its normal on the base. `is_hard`: the base normal smooths over no
    /// other face, so faces at more than 80 degrees from these, both on the base and moved, are ignored.
    [[nodiscard]] bool admit(std::size_t i, const DVec3& normal, const VertexRotation& turn, bool is_hard,
                             double slack) const;

  private:
    /// Unit normals of a face before and after the morph.
    struct Face {
        DVec3 base = {}, moved = {};
    };
    struct Point {
        std::vector<Face> list = {};
        bool is_open = false;  ///< a face collapses or opens here: the mean depends on the weights
    };
    std::vector<Point> faces_ = {};
    std::vector<std::uint32_t> point_of_ = {};  ///< one per entry of `vertices`
};

}  // namespace tspace
