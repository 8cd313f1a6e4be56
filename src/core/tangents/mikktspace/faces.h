// SPDX-License-Identifier: MIT
// Faces cut into triangles.
#pragma once

#include "core/base/memory.h"
#include "core/base/mesh_loops.h"
#include "tspace/tangents.h"

namespace tspace::mikk {

/// All triangles, degenerate ones too, in face order.
struct TriangleList {
    std::size_t count = 0;
    Buffer<std::uint32_t> corners;  ///< three corners of the mesh per triangle; empty: 3t, 3t+1, 3t+2
    Buffer<std::uint32_t> faces;    ///< one per triangle; empty: triangle t is face t
    Buffer<std::uint32_t> skipped_corners;
    std::uint64_t skipped_face_count = 0;

    [[nodiscard]] std::uint32_t corner(std::size_t i) const {
        return corners.empty() ? static_cast<std::uint32_t>(i) : corners[i];
    }
    [[nodiscard]] std::uint32_t face(std::size_t t) const {
        return faces.empty() ? static_cast<std::uint32_t>(t) : faces[t];
    }
};

TriangleList cutFaces(const MeshView& mesh, Ngons ngons, const Allocator* allocator);

/// readTriangles where faces were cut.
const std::uint32_t* readCutTriangles(const MeshView& mesh, const TriangleList& triangles, std::size_t first,
                                      std::size_t count, std::uint32_t* buffer);

/// The vertices of the triangles [first, first + count), three each: a pointer into the indices where they can be read in
/// place, else `buffer`.
inline const std::uint32_t* readTriangles(const MeshView& mesh, const TriangleList& triangles, std::size_t first,
                                          std::size_t count, std::uint32_t* buffer) {
    if (triangles.corners.empty()) return readIndices(mesh.indices, 3 * first, 3 * count, buffer);
    return readCutTriangles(mesh, triangles, first, count, buffer);
}

}  // namespace tspace::mikk
