// SPDX-License-Identifier: MIT
// Based on: Newell's method as in Sutherland, Sproull & Schumacker, "A Characterization of Ten Hidden-Surface
// Algorithms", 1974.
#include "normals/faces.h"

#include <algorithm>
#include <cmath>

#include "core/face_walk.h"
#include "core/typed_indices.h"

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

PointItems::PointItems(const MeshView& mesh, const Faces& faces, const Buffer<std::uint32_t>& points)
    : TriangleGroups(areTriangles(mesh) ? mesh.faceCount() : mesh.cornerCount()),
      mesh_(mesh),
      faces_(faces),
      points_(points),
      in_place_(areTriangles(mesh) && mesh.indices.type == IndexType::u32
                    ? static_cast<const std::uint32_t*>(mesh.indices.data)
                    : nullptr),
      is_own_mesh_(points.empty()) {}

void PointItems::findOwn(const Allocator* allocator, Parallel& parallel) {
    if (in_place_ == nullptr || is_own_mesh_) return;
    const std::uint32_t* const points = points_.data();
    constexpr std::size_t kBlock = TriangleBatch::kMost, kGrain = Parallel::kGrain / kBlock;
    are_own_ = Buffer<std::uint8_t>(allocator, (count + kBlock - 1) / kBlock);
    parallel.forRanges(are_own_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t block = begin; block < end; ++block) {
            const std::uint32_t* v = in_place_ + 3 * kBlock * block;
            const std::uint32_t* const past = v + 3 * std::min(kBlock, count - kBlock * block);
            while (v != past && points[v[0]] == v[0] && points[v[1]] == v[1] && points[v[2]] == v[2]) v += 3;
            are_own_[block] = v == past ? 1 : 0;
        }
    });
}

void PointItems::read(std::size_t first, std::size_t size, std::uint32_t* vertices, std::uint32_t* points) const {
    if (areTriangles(mesh_)) {
        const std::uint32_t* const v =
            readIndices(mesh_.indices, 3 * first, 3 * size, vertices != nullptr ? vertices : points);
        if (vertices != nullptr && v != vertices) std::copy_n(v, 3 * size, vertices);
        for (std::size_t i = 0; i < 3 * size; ++i) points[i] = is_own_mesh_ ? v[i] : points_[v[i]];
        return;
    }
    for (std::size_t i = 0; i < size; ++i) {
        const auto corner = static_cast<std::uint32_t>(first + i);
        const bool is_used = faces_.isUsed(faces_.of(corner));
        std::fill_n(points + 3 * i, 3, is_used ? pointOf(corner) : ~std::uint32_t{0});
        if (vertices == nullptr) continue;
        const Faces::Around around = faces_.around(corner);
        for (std::size_t k = 0; k < 3; ++k) vertices[3 * i + k] = mesh_.indices[around.corners[k]];
    }
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
