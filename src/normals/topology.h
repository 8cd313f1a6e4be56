// SPDX-License-Identifier: MIT
// What the normals of a mesh are computed from: faces with their normals, and points with the corners around
// them.
#pragma once

#include <cstdint>

#include "core/memory.h"
#include "core/parallel.h"
#include "core/vec_math.h"
#include "tspace/mesh.h"

namespace tspace {

struct FaceNormal {
    DVec3 unit;         ///< zero for a degenerate face
    double length = 0;  ///< of Newell's sum: twice the face's area; 0 for a degenerate face

    [[nodiscard]] bool isDegenerate() const { return length == 0; }
};

struct FaceTable {
    Buffer<std::uint32_t> first_corners;  ///< one per face, and one past the last
    Buffer<std::uint32_t> corner_faces;   ///< one per corner
    Buffer<FaceNormal> normals;           ///< one per face
    std::uint64_t used_count = 0;         ///< faces of 3 corners or more; the others are ignored everywhere
    std::uint64_t degenerate_count = 0;   ///< of the used ones

    [[nodiscard]] std::uint32_t size(std::uint32_t face) const { return first_corners[face + 1] - first_corners[face]; }
    [[nodiscard]] bool isUsed(std::uint32_t face) const { return size(face) >= 3; }
    /// The corner after and before a corner on the border of its face.
    [[nodiscard]] std::uint32_t next(std::uint32_t corner) const {
        const std::uint32_t face = corner_faces[corner];
        return corner + 1 == first_corners[face + 1] ? first_corners[face] : corner + 1;
    }
    [[nodiscard]] std::uint32_t previous(std::uint32_t corner) const {
        const std::uint32_t face = corner_faces[corner];
        return (corner == first_corners[face] ? first_corners[face + 1] : corner) - 1;
    }
};

/// A point is a vertex, or all vertices at one position. It is named by its lowest vertex.
struct PointTable {
    Buffer<std::uint32_t> corner_points;  ///< one per corner
    Buffer<std::uint32_t> begins;         ///< one per vertex, and one past the last: its range of `corners`
    Buffer<std::uint32_t> corners;        ///< the corners of used faces, sorted by point, then by number
};

/// `factor` is normalFactor(convention).
FaceTable makeFaceTable(const MeshView& mesh, double factor, const Allocator* allocator, Parallel& parallel);

PointTable makePointTable(const MeshView& mesh, const FaceTable& faces, bool weld_positions, const Allocator* allocator,
                          Parallel& parallel);

}  // namespace tspace
