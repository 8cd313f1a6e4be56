// SPDX-License-Identifier: MIT
// Triangulation of the faces of a mesh.
#include "core/base/border.h"
#include "core/base/mesh_loops.h"
#include "core/frames/face_cutter.h"
#include "core/frames/one_list.h"
#include "tspace/mesh.h"

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
        // Only the UVs of quads are read; normals are not used.
        return mesh.hasOwnLists() ? withOneList(mesh, {}, cutFaces) : cutFaces(mesh);
    });
}

const char* facesName(Faces faces) {
    switch (faces) {
        case Faces::triangles: return "triangles";
        case Faces::quads: return "quads";
        case Faces::automatic: return "auto";
    }
    return "unknown";
}

}  // namespace tspace
