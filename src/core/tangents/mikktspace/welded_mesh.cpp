// SPDX-License-Identifier: MIT
// Reading of triangulated faces.
#include "core/tangents/mikktspace/welded_mesh.h"

namespace tspace::mikk {

const std::uint32_t* readCutTriangles(const MeshView& mesh, const TriangleList& triangles, std::size_t first,
                                      std::size_t count, std::uint32_t* buffer) {
    const std::uint32_t* corners = triangles.corners.data() + 3 * first;
    withIndices(mesh.indices, [&](auto vertexOf) {
        for (std::size_t i = 0; i < 3 * count; ++i) buffer[i] = vertexOf(corners[i]);
    });
    return buffer;
}

}  // namespace tspace::mikk
