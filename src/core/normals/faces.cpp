// SPDX-License-Identifier: MIT
// Based on: Newell's method as in Sutherland, Sproull & Schumacker, "A Characterization of Ten Hidden-Surface
// Algorithms", 1974.
#include "core/normals/faces.h"

#include <algorithm>
#include <cmath>

#include "core/base/caches.h"
#include "core/base/mesh_loops.h"

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

PointItems::PointItems(const MeshView& mesh, const Faces& faces, const Buffer<std::uint32_t>& points,
                       const Allocator* allocator)
    : TriangleGroups(areTriangles(mesh) ? mesh.faceCount() : mesh.cornerCount()),
      mesh_(mesh),
      faces_(faces),
      points_(points),
      in_place_(areTriangles(mesh) && mesh.indices.type == IndexType::u32
                    ? static_cast<const std::uint32_t*>(mesh.indices.data)
                    : nullptr) {
    if (in_place_ != nullptr && !points.empty())
        blocks_ = Buffer<std::uint8_t>(allocator, count / TriangleBatch::kMost + 1, unknown);
}

const std::uint32_t* PointItems::inPlace(std::size_t first, std::size_t) const {
    if (in_place_ == nullptr || points_.empty()) return in_place_ == nullptr ? nullptr : in_place_ + 3 * first;
    constexpr std::size_t kBlock = TriangleBatch::kMost;
    std::uint8_t* const block = &blocks_[first / kBlock];
    std::uint8_t known = __atomic_load_n(block, __ATOMIC_RELAXED);  // of two threads at once both find the same
    if (known == unknown) {
        const std::size_t begin = first / kBlock * kBlock, end = std::min(begin + kBlock, count);
        const std::uint32_t *v = in_place_ + 3 * begin, *const past = in_place_ + 3 * end,
                            *const points = points_.data();
        prefetchLines(v, 3 * kBlock * sizeof *v);
        while (v != past && points[v[0]] == v[0] && points[v[1]] == v[1] && points[v[2]] == v[2]) v += 3;
        known = v == past ? own : shared;
        __atomic_store_n(block, known, __ATOMIC_RELAXED);
    }
    return known == own ? in_place_ + 3 * first : nullptr;
}

template <class NumberOf>
void PointItems::readEach(NumberOf numberOf, std::size_t size, std::uint32_t* vertices, std::uint32_t* points) const {
    const std::uint32_t* const roots = points_.empty() ? nullptr : points_.data();
    const auto readTriangle = [&](std::size_t i, const auto& vertexOf) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = vertexOf(k);
            if (vertices != nullptr) vertices[3 * i + k] = vertex;
            points[3 * i + k] = roots != nullptr ? roots[vertex] : vertex;
        }
    };
    withIndices(mesh_.indices, [&](const auto vertexOf) {
        if (areTriangles(mesh_)) {
            for (std::size_t i = 0; i < size; ++i) {
                const std::size_t first = std::size_t{3} * numberOf(i);
                readTriangle(i, [&](std::size_t k) { return vertexOf(first + k); });
            }
            return;
        }
        for (std::size_t i = 0; i < size; ++i) {
            const auto corner = static_cast<std::uint32_t>(numberOf(i));
            const Faces::Around around = faces_.around(corner);
            readTriangle(i, [&](std::size_t k) { return vertexOf(around.corners[k]); });
            const bool is_used = faces_.isUsed(faces_.of(corner));
            std::fill_n(points + 3 * i, 3, is_used ? points[3 * i] : ~std::uint32_t{0});
        }
    });
}

void PointItems::read(std::size_t first, std::size_t size, std::uint32_t* vertices, std::uint32_t* points) const {
    readEach([first](std::size_t i) { return first + i; }, size, vertices, points);
}

void PointItems::readSome(const std::uint32_t* numbers, std::size_t size, std::uint32_t* vertices,
                          std::uint32_t* points) const {
    readEach([numbers](std::size_t i) { return std::size_t{numbers[i]}; }, size, vertices, points);
}

/// Newell's sum taken about the first corner: the same value, but far from the origin no digits cancel.
FaceRow faceRow(const MeshView& mesh, std::uint32_t first, std::uint32_t past, double factor, bool by_area) {
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
    const DVec3 unit = (factor / l) * sum;
    const double size = by_area ? l : 1;
    return {size * unit.x, size * unit.y, size * unit.z, size};
}

}  // namespace tspace
