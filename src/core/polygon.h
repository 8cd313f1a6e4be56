// SPDX-License-Identifier: MIT
// Cutting one polygon into triangles: the rule that triangulate.h states, shared by every part that cuts
// faces.
#pragma once

#include <cstdint>
#include <vector>

#include "core/vec_math.h"
#include "tspace/mesh.h"

namespace tspace {

/// True when the quad is cut along 1-3, false for 0-2 (also when a comparison meets a NaN). `uvs` may be
/// null. MikkTSpace's rule: the shorter diagonal in UV space; if equal, 1-3 only when strictly shorter in
/// space.
inline bool quadCutsAlong13(const Vec3 positions[4], const Vec2* uvs) {
    if (uvs != nullptr) {
        const Vec2 d02 = uvs[2] - uvs[0];
        const Vec2 d13 = uvs[3] - uvs[1];
        const float length2_02 = d02.x * d02.x + d02.y * d02.y;
        const float length2_13 = d13.x * d13.x + d13.y * d13.y;
        if (length2_02 < length2_13) return false;
        if (length2_13 < length2_02) return true;
    }
    const Vec3 d02 = positions[2] - positions[0];
    const Vec3 d13 = positions[3] - positions[1];
    return dot(d13, d13) < dot(d02, d02);
}

/// Writes the corners of two triangles, of which the quad's first one is `first`.
inline void cutQuad(const Vec3 positions[4], const Vec2* uvs, std::uint32_t first, std::uint32_t* to) {
    const std::uint32_t b = quadCutsAlong13(positions, uvs) ? 1 : 0;  // (0,1,2),(0,2,3) or (0,1,3),(1,2,3)
    const std::uint32_t cut[6] = {0, 1, 2 + b, b, 2, 3};
    for (std::size_t i = 0; i < 6; ++i) to[i] = first + cut[i];
}

/// Coordinates in the plane of a polygon.
struct PlanePoint {
    double x, y;
};

/// A vertex of a polygon while it is cut. Numbered in canonical order: from a start that geometry alone decides.
struct PolygonVertex {
    DVec3 position;
    PlanePoint point;
    std::uint64_t order;  ///< when it is cut off
    std::uint32_t previous, next;
    bool is_reflex;
};

/// Memory that is used again from face to face: lists that only grow.
struct PolygonScratch {
    std::vector<PolygonVertex> vertices;
    std::vector<std::uint32_t> reflex;  ///< vertices that may lie in an ear: those that are not convex
    std::vector<std::uint32_t> tree;    ///< a tournament of them
};

/// Cuts the faces of a mesh, one after the other, with the same memory.
class FaceCutter {
  public:
    explicit FaceCutter(const MeshView& mesh) : mesh_(mesh) {}
    /// The face of `size` >= 3 corners from `first` on: writes 3 * (size - 2) corners of the mesh, winding kept.
    void cut(std::size_t first, std::uint32_t size, std::uint32_t* corners) {
        if (size != 4) return cutOther(first, size, corners);
        Vec3 positions[4];
        Vec2 uvs[4];
        const bool has_uvs = !mesh_.uvs.empty();
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t vertex = mesh_.indices[first + k];
            positions[k] = mesh_.positions[vertex];
            if (has_uvs) uvs[k] = mesh_.uvs[vertex];
        }
        cutQuad(positions, has_uvs ? uvs : nullptr, static_cast<std::uint32_t>(first), corners);
    }

  private:
    void cutOther(std::size_t first, std::uint32_t size, std::uint32_t* corners);

    const MeshView& mesh_;
    std::vector<Vec3> positions_;
    std::vector<Vec2> uvs_;
    PolygonScratch scratch_;
};

}  // namespace tspace
