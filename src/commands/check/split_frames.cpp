// SPDX-License-Identifier: MIT
// Vertices that are equal but for their tangents. Some must differ: MikkTSpace separates triangles that do not touch in
// a fan, or whose orientations differ. So its result decides which should be equal.
#include <array>
#include <bit>

#include "commands/check/frame_health.h"
#include "core/base/unique_index.h"
#include "core/base/vec_math.h"
#include "core/mesh/surface/surface.h"
#include "tspace/tangents.h"

namespace tspace {

namespace {

bool areFar(const Vec4& a, const Vec4& b, double tolerance_deg) {
    return (a.w > 0) != (b.w > 0) || angleBetween(toDouble(xyz(a)), toDouble(xyz(b))) * 180 / kPi > tolerance_deg;
}

bool isUsable(const Vec4& tangent) { return isFinite(xyz(tangent)) && tangent.w == tangent.w; }

bool doAnyDiffer(const TangentView& mesh, const EqualVertices& equal, double tolerance_deg) {
    std::vector<std::uint32_t> first(equal.class_count, kNoClass);
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        if (!isUsable(mesh.tangents[v])) continue;
        std::uint32_t& other = first[equal.class_of[v]];
        if (other == kNoClass) {
            other = v;
        } else if (areFar(mesh.tangents[other], mesh.tangents[v], tolerance_deg)) {
            return true;
        }
    }
    return false;
}

/// Opposite triangles can cancel out. The tangent that a tool then gives depends on more than the vertex.
bool isSound(const Vec4& tangent) {
    const float size = length(xyz(tangent));
    return size > 0.9f && size < 1.1f;
}

Result<std::vector<Vec4>> referenceTangents(const TangentView& mesh) {
    const MeshView view = mesh.triangles();
    std::vector<Vec4> tangents(mesh.corners.size());
    const TangentOptions options{.convention = conventions::opengl, .pairing = Pairing::corrected};
    const Result<TangentReport> report = generateTangents(view, options, {.tangents = tangents});
    if (!report) return report.error();
    return tangents;
}

}  // namespace

Result<Done> examineSplits(const TangentView& mesh, const Surface& surface, const CheckOptions& options,
                           FrameHealth& health) {
    const EqualVertices equal = findEqualVertices(mesh, true);
    health.frames_differ.total = mesh.positions.size();
    if (equal.class_count == mesh.positions.size() || !doAnyDiffer(mesh, equal, options.split_deg)) return Done{};
    const Result<std::vector<Vec4>> reference = referenceTangents(mesh);
    if (!reference) return reference.error();
    // Corners of one class with the same reference tangent share a group of it.
    UniqueIndex<std::array<std::uint32_t, 5>> groups(mesh.positions.size());
    std::vector<std::uint32_t> first_vertex;
    std::vector<bool> counted(mesh.positions.size(), false);
    for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
        const std::uint32_t vertex = mesh.corners[c];
        if (surface.faces[c / 3].orientation == 0 || !isUsable(mesh.tangents[vertex])) continue;
        const Vec4& t = (*reference)[c];
        if (!isSound(t)) continue;
        const std::uint32_t group =
            groups.indexOf({equal.class_of[vertex], weldBits(t.x), weldBits(t.y), weldBits(t.z), weldBits(t.w)});
        if (group == first_vertex.size()) first_vertex.push_back(vertex);
        const Vec4& first = mesh.tangents[first_vertex[group]];
        if (counted[vertex] || health.isSettled(vertex) || !areFar(first, mesh.tangents[vertex], options.split_deg))
            continue;
        counted[vertex] = true;
        health.fault(vertex, FindingCode::splitFramesDiffer, mesh.positions.size());
        const double angle = angleBetween(toDouble(xyz(first)), toDouble(xyz(mesh.tangents[vertex]))) * 180 / kPi;
        health.frames_differ.add(vertex, surface.known_areas[vertex], angle);
    }
    return Done{};
}

}  // namespace tspace
