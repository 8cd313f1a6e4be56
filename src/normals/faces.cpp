// SPDX-License-Identifier: MIT
// Based on: Newell's method as in Sutherland, Sproull & Schumacker, "A Characterization of Ten Hidden-Surface
// Algorithms", 1974.
#include "normals/faces.h"

#include <cmath>

#include "core/face_walk.h"

namespace tspace {

Faces::Faces(const MeshView& mesh, const Allocator* allocator) {
    if (mesh.face_sizes.empty()) {
        size_ = mesh.face_size;
        used_count_ = size_ >= 3 ? mesh.faceCount() : 0;
        return;
    }
    first_corners_ = Buffer<std::uint32_t>(allocator, mesh.faceCount() + 1);
    corner_faces_ = Buffer<std::uint32_t>(allocator, mesh.cornerCount());
    forEachFace(mesh, [&](std::size_t face, std::size_t first, std::uint32_t size) {
        first_corners_[face] = static_cast<std::uint32_t>(first);
        for (std::size_t corner = first; corner < first + size; ++corner)
            corner_faces_[corner] = static_cast<std::uint32_t>(face);
        if (size >= 3) ++used_count_;
    });
    first_corners_[mesh.faceCount()] = static_cast<std::uint32_t>(mesh.cornerCount());
}

/// Newell's sum taken about the first corner: the same value, but far from the origin no digits cancel.
FaceNormal faceNormal(const MeshView& mesh, std::uint32_t first, std::uint32_t past, double factor) {
    const DVec3 origin = toDouble(mesh.positions[mesh.indices[first]]);
    DVec3 sum;
    DVec3 before = toDouble(mesh.positions[mesh.indices[first + 1]]) - origin;
    for (std::uint32_t corner = first + 2; corner < past; ++corner) {
        const DVec3 here = toDouble(mesh.positions[mesh.indices[corner]]) - origin;
        sum = sum + cross(before, here);
        before = here;
    }
    const double l = length(sum);
    if (!(l > 0) || !std::isfinite(l)) return {};
    return {(factor / l) * sum, l};
}

}  // namespace tspace
