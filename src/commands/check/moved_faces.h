// SPDX-License-Identifier: MIT
// The directions that faces have where a morph target moved them, over all primitives of a mesh: exporters cut a mesh at the
// borders of materials and polygons into triangles, but their normals are those of the whole.
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
    /// Faces around these vertices of a primitive under the target `number`. `all`: primitives of the scene; those of the
    /// same mesh count. Linear in the triangles of those whose bounding boxes meet that of the vertices.
    MovedFaces(const ScenePrimitive& primitive, std::span<const ScenePrimitive> all, std::size_t number,
               std::span<const std::uint32_t> vertices);

    /// Whether a smoothing of faces around vertices[i] can have this unit normal, within `slack` radians. `turn`: of the faces
    /// that share its normal on the base. is_hard: no other face takes part in that, so that faces at more than 80 degrees
    /// from these, both on the base and moved, count for none.
    [[nodiscard]] bool admit(std::size_t i, const DVec3& normal, const VertexTurn& turn, bool is_hard,
                             double slack) const;

  private:
    /// Unit normals.
    struct Face {
        DVec3 base = {}, moved = {};
    };
    struct Point {
        std::vector<Face> list = {};
        bool is_open = false;  ///< a face collapses or opens there: the mean is a matter of weights
    };
    std::vector<Point> faces_ = {};
    std::vector<std::uint32_t> point_of_ = {};  ///< one per entry of `vertices`
};

}  // namespace tspace
