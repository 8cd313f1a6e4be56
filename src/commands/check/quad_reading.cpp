// SPDX-License-Identifier: MIT
#include "commands/check/quad_reading.h"

#include <cmath>
#include <utility>

#include "core/mesh/quads/quads.h"

namespace tspace {

namespace {

/// Whether there are findings that another cut of quads could explain.
bool hasFaults(const FrameHealth& health) {
    for (const Tally* tally : {&health.signs_mixed, &health.signs_wrong, &health.mirrored_seams, &health.uv_seams,
                               &health.directions_wrong, &health.frames_differ}) {
        if (tally->count != 0) return true;
    }
    return false;
}

double uvArea(const TangentView& mesh, std::size_t triangle) {
    const auto uv = [&](std::size_t k) { return mesh.uvs[mesh.corners[3 * triangle + k]]; };
    const Vec2 a = uv(0), b = uv(1), c = uv(2);
    return std::fabs((double{b.x} - a.x) * (double{c.y} - a.y) - (double{b.y} - a.y) * (double{c.x} - a.x));
}

/// The orientation of a quad, as in the reference: where it is folded in the UV map, its larger half decides.
void giveFacesOneOrientation(const TangentView& mesh, std::span<const std::uint32_t> faces, Surface& surface) {
    for (std::size_t t = 0; t + 1 < faces.size(); ++t) {
        SurfaceFrame &first = surface.faces[t], &second = surface.faces[t + 1];
        if (faces[t] != faces[t + 1] || first.orientation * second.orientation != -1) continue;
        if (uvArea(mesh, t) >= uvArea(mesh, t + 1)) {
            second.orientation = first.orientation;
        } else {
            first.orientation = second.orientation;
        }
    }
}

Result<QuadReading> cutQuads(const TangentView& mesh, const QuadFaces& faces) {
    std::vector<std::uint32_t> vertices;
    vertices.reserve(faces.corners.size());
    for (const std::uint32_t corner : faces.corners) vertices.push_back(mesh.corners[corner]);
    MeshView polygons;
    polygons.positions = mesh.positions;
    polygons.uvs = mesh.uvs;
    polygons.indices = IndexView(std::span<const std::uint32_t>(vertices));
    polygons.face_sizes = faces.sizes;
    const Result<Triangulation> cut = triangulate(polygons);
    if (!cut) return cut.error();
    QuadReading reading;
    reading.corners.reserve(cut->corners.size());
    for (const std::uint32_t corner : cut->corners) reading.corners.push_back(vertices[corner]);
    TangentView other = mesh;
    other.corners = reading.corners;
    reading.surface = describeSurface(other);
    giveFacesOneOrientation(other, cut->faces, reading.surface);
    return reading;
}

}  // namespace

Result<std::optional<QuadReading>> findQuads(const TangentView& mesh, const FrameHealth& health,
                                             const CheckOptions& options) {
    const std::optional<QuadReading> none;
    const bool is_asked = options.faces == Faces::quads || (options.faces == Faces::automatic && hasFaults(health));
    if (!is_asked || mesh.normals.empty() || mesh.uvs.empty()) return none;
    const Result<QuadFaces> faces =
        chooseFaces(mesh.triangles(), mesh.tangents, false, options.faces, {.thread_count = 1});
    if (!faces) return faces.error();
    if (faces->quad_count == 0) return none;
    Result<QuadReading> reading = cutQuads(mesh, *faces);
    if (!reading) return std::move(reading).error();
    return std::optional<QuadReading>(*std::move(reading));
}

}  // namespace tspace
