// SPDX-License-Identifier: MIT
// Triangulation of a single polygon by the rule of triangulate(), shared by all code that cuts faces.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/vec_math.h"
#include "tspace/mesh.h"

namespace tspace {

/// Coordinates in the plane of a polygon.
struct PlanePoint {
    double x = 0, y = 0;
};

/// Vertex of a polygon during triangulation. Numbered in canonical order, whose start depends only on geometry.
struct PolygonVertex {
    float values[5];  ///< position and UV (zeros without UVs), which determine the order of corners
    std::uint32_t corner;
    DVec3 position;
    PlanePoint point = {};
    std::uint64_t order = 0;  ///< sort key of the cutting order (orderOf in face_cutter.cpp)
    std::uint32_t previous = 0, next = 0;
    bool is_reflex = false;
};

/// Scratch memory that is reused from face to face.
struct PolygonScratch {
    std::vector<PolygonVertex> vertices;
    std::vector<std::uint32_t> reflex;  ///< vertices that may be inside an ear: those that are not convex
    std::vector<std::uint32_t> tree;    ///< tournament tree
};

/// Triangulates the faces of a mesh one by one, reusing its scratch memory.
class FaceCutter {
  public:
    explicit FaceCutter(const MeshView& mesh) : mesh_(mesh) {}
    /// Triangulates the face of `size` >= 3 corners starting at `first`: writes 3 * (size - 2) corners of the mesh,
    /// with the same winding.
    void cut(std::size_t first, std::uint32_t size, std::uint32_t* corners) {
        if (size != 4) return cutOther(first, size, corners);
        const std::uint32_t b = quadIsCutAlong13(first) ? 1 : 0;  // cuts into (0,1,2),(0,2,3) or (0,1,3),(1,2,3)
        const std::uint32_t cut[6] = {0, 1, 2 + b, b, 2, 3};
        for (std::size_t i = 0; i < 6; ++i) corners[i] = static_cast<std::uint32_t>(first) + cut[i];
    }

  private:
    /// Applies MikkTSpace's rule: the shorter diagonal in UV space; if equal, 1-3 only if it is strictly shorter in
    /// space. Returns false also for comparisons with NaN.
    [[nodiscard]] bool quadIsCutAlong13(std::size_t first) const {
        std::uint32_t v[4];
        for (std::size_t k = 0; k < 4; ++k) v[k] = mesh_.indices[first + k];
        if (!mesh_.uvs.empty()) {
            const Vec2 d02 = mesh_.uvs[v[2]] - mesh_.uvs[v[0]], d13 = mesh_.uvs[v[3]] - mesh_.uvs[v[1]];
            const float length2_02 = d02.x * d02.x + d02.y * d02.y;
            const float length2_13 = d13.x * d13.x + d13.y * d13.y;
            if (length2_02 < length2_13) return false;
            if (length2_13 < length2_02) return true;
        }
        const Vec3 d02 = mesh_.positions[v[2]] - mesh_.positions[v[0]];
        const Vec3 d13 = mesh_.positions[v[3]] - mesh_.positions[v[1]];
        return dot(d13, d13) < dot(d02, d02);
    }
    void cutOther(std::size_t first, std::uint32_t size, std::uint32_t* corners);

    const MeshView& mesh_;
    PolygonScratch scratch_;
};

}  // namespace tspace
