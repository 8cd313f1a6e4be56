// SPDX-License-Identifier: MIT
// Cuts the faces of a mesh into triangles of its corners.
#include "tspace/triangulate.h"

#include "core/border.h"
#include "core/face_walk.h"
#include "core/polygon.h"

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

    PolygonScratch scratch;
    std::vector<Vec3> positions;
    std::vector<Vec2> uvs;
    std::size_t done = 0;
    forEachFace(mesh, [&](std::size_t face, std::size_t first, std::uint32_t size) {
        if (size < 3) return;
        positions.clear();
        uvs.clear();
        for (std::size_t c = first; c < first + size; ++c) {
            const std::uint32_t vertex = mesh.indices[c];
            positions.push_back(mesh.positions[vertex]);
            if (!mesh.uvs.empty()) uvs.push_back(mesh.uvs[vertex]);
        }
        std::uint32_t* corners = result.corners.data() + 3 * done;
        cutPolygon(positions.data(), uvs.empty() ? nullptr : uvs.data(), size, corners, scratch);
        const std::size_t count = size - 2;
        for (std::size_t k = 0; k < 3 * count; ++k) corners[k] += static_cast<std::uint32_t>(first);
        for (std::size_t t = 0; t < count; ++t) result.faces[done + t] = static_cast<std::uint32_t>(face);
        done += count;
    });
    return result;
}

}  // namespace

Result<Triangulation> triangulate(const MeshView& mesh) {
    return atBorder([&] { return cutFaces(mesh); });
}

}  // namespace tspace
