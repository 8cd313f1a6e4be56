// SPDX-License-Identifier: MIT
// Cuts the faces of a mesh into triangles of its corners.
#include "tspace/triangulate.h"

#include "core/base/border.h"
#include "core/base/mesh_loops.h"
#include "core/base/polygon.h"
#include "core/frames/one_list.h"

namespace tspace {

namespace {

Result<Triangulation> cutFaces(const MeshView& mesh) {
    if (Result<Done> valid = validate(mesh); !valid) return std::move(valid).error();
    std::size_t triangle_count = 0;
    forEachFace(mesh, [&](std::size_t, std::size_t, std::uint32_t size) {
        if (size >= 3) triangle_count += size - 2;
    });
    Triangulation result;
    result.corners.resize(3 * triangle_count);
    result.faces.resize(triangle_count);

    FaceCutter cutter(mesh);
    std::size_t done = 0;
    forEachFace(mesh, [&](std::size_t face, std::size_t first, std::uint32_t size) {
        if (size < 3) return;
        cutter.cut(first, size, result.corners.data() + 3 * done);
        for (std::size_t t = 0; t < size - 2; ++t) result.faces[done++] = static_cast<std::uint32_t>(face);
    });
    return result;
}

}  // namespace

Result<Triangulation> triangulate(const MeshView& mesh) {
    return atBorder([&] {
        // Only the UVs of quads are read, and the normals never.
        return mesh.hasOwnLists() ? withOneList(mesh, {}, cutFaces) : cutFaces(mesh);
    });
}

}  // namespace tspace
