// SPDX-License-Identifier: MIT
// Face normals by Newell's sum, and the lists of corners around points.
// Based on: Newell's method as in Sutherland, Sproull & Schumacker, "A Characterization of Ten Hidden-Surface
// Algorithms", 1974.
#include "normals/topology.h"

#include <cmath>

#include "core/face_walk.h"
#include "core/sum_ranges.h"
#include "normals/weld.h"

namespace tspace {

namespace {

constexpr std::size_t kGrain = 2048;

/// Newell's sum taken about the first corner: the same value, but far from the origin no digits cancel.
FaceNormal faceNormal(const MeshView& mesh, std::uint32_t first, std::uint32_t end, double factor) {
    const DVec3 origin = toDouble(mesh.positions[mesh.indices[first]]);
    DVec3 sum;
    DVec3 before = toDouble(mesh.positions[mesh.indices[first + 1]]) - origin;
    for (std::uint32_t corner = first + 2; corner < end; ++corner) {
        const DVec3 here = toDouble(mesh.positions[mesh.indices[corner]]) - origin;
        sum = sum + cross(before, here);
        before = here;
    }
    const double l = length(sum);
    if (!(l > 0) || !std::isfinite(l)) return {};
    return {(factor / l) * sum, l};
}

}  // namespace

FaceTable makeFaceTable(const MeshView& mesh, double factor, const Allocator* allocator, Parallel& parallel) {
    const std::size_t face_count = mesh.faceCount();
    FaceTable table;
    table.first_corners = Buffer<std::uint32_t>(allocator, face_count + 1);
    table.corner_faces = Buffer<std::uint32_t>(allocator, mesh.cornerCount());
    table.normals = Buffer<FaceNormal>(allocator, face_count);
    forEachFace(mesh, [&](std::size_t face, std::size_t first, std::uint32_t size) {
        table.first_corners[face] = static_cast<std::uint32_t>(first);
        if (size >= 3) ++table.used_count;
    });
    table.first_corners[face_count] = static_cast<std::uint32_t>(mesh.cornerCount());

    table.degenerate_count = sumRanges(parallel, face_count, kGrain, [&](std::size_t begin, std::size_t end) {
        std::uint64_t degenerate = 0;
        for (std::size_t f = begin; f < end; ++f) {
            const auto face = static_cast<std::uint32_t>(f);
            const std::uint32_t first = table.first_corners[f];
            const std::uint32_t past = table.first_corners[f + 1];
            for (std::uint32_t corner = first; corner < past; ++corner) table.corner_faces[corner] = face;
            table.normals[f] = table.isUsed(face) ? faceNormal(mesh, first, past, factor) : FaceNormal{};
            if (table.isUsed(face) && table.normals[f].isDegenerate()) ++degenerate;
        }
        return degenerate;
    });
    return table;
}

PointTable makePointTable(const MeshView& mesh, const FaceTable& faces, bool weld_positions, const Allocator* allocator,
                          Parallel& parallel) {
    const std::size_t corner_count = mesh.cornerCount();
    const std::size_t vertex_count = mesh.vertexCount();
    PointTable table;
    table.corner_points = Buffer<std::uint32_t>(allocator, corner_count);
    {
        Buffer<std::uint32_t> lowest;
        if (weld_positions) lowest = weldPositions(mesh, allocator, parallel);
        parallel.forRanges(corner_count, kGrain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c) {
                const std::uint32_t vertex = mesh.indices[c];
                table.corner_points[c] = lowest.empty() ? vertex : lowest[vertex];
            }
        });
    }

    // A counting sort. It counts two places up, so that after the sum and the filling `begins` holds the
    // begins.
    table.begins = Buffer<std::uint32_t>(allocator, vertex_count + 2, 0);
    std::size_t used = 0;
    for (std::size_t c = 0; c < corner_count; ++c) {
        if (!faces.isUsed(faces.corner_faces[c])) continue;
        ++table.begins[table.corner_points[c] + 2];
        ++used;
    }
    for (std::size_t p = 2; p < vertex_count + 2; ++p) table.begins[p] += table.begins[p - 1];
    table.corners = Buffer<std::uint32_t>(allocator, used);
    for (std::size_t c = 0; c < corner_count; ++c) {
        if (!faces.isUsed(faces.corner_faces[c])) continue;
        table.corners[table.begins[table.corner_points[c] + 1]++] = static_cast<std::uint32_t>(c);
    }
    return table;
}

}  // namespace tspace
