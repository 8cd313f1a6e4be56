// SPDX-License-Identifier: MIT
// Faces of a mesh, their normals, and the flat normals of corners. Based on: Newell's method as in Sutherland, Sproull
// & Schumacker, "A Characterization of Ten Hidden-Surface Algorithms", 1974.
#include "core/normals/normals_call.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/base/memory.h"
#include "core/base/mesh_loops.h"
#include "core/base/range_lists.h"

namespace tspace {

MeshFaces::MeshFaces(const MeshView& mesh, const Allocator* allocator) {
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

PointItems::PointItems(const MeshView& mesh, const MeshFaces& faces, const Buffer<std::uint32_t>& points,
                       const Allocator* allocator)
    : TriangleGroups(areTriangles(mesh) ? mesh.faceCount() : mesh.cornerCount()), mesh_(mesh), faces_(faces),
      points_(points), in_place_(areTriangles(mesh) && mesh.indices.type == IndexType::u32
                                     ? static_cast<const std::uint32_t*>(mesh.indices.data)
                                     : nullptr) {
    if (in_place_ != nullptr && !points.empty())
        blocks_ = Buffer<std::uint8_t>(allocator, count / TriangleBatch::kMost + 1, unknown);
}

TriangleGroups::InPlace PointItems::inPlace(std::size_t first, std::size_t) const {
    if (in_place_ == nullptr) return {};
    const InPlace vertices{in_place_ + 3 * first, in_place_ + 3 * first};
    if (points_.empty()) return vertices;
    constexpr std::size_t kBlock = TriangleBatch::kMost;
    std::uint8_t* const block = &blocks_[first / kBlock];
    // This data race is benign: concurrent threads store equal values.
    std::uint8_t known = __atomic_load_n(block, __ATOMIC_RELAXED);
    if (known == unknown) {
        const std::size_t begin = first / kBlock * kBlock, end = std::min(begin + kBlock, count);
        const std::uint32_t *v = in_place_ + 3 * begin, *const past = in_place_ + 3 * end,
                            *const points = points_.data();
        prefetchLines(v, 3 * kBlock * sizeof *v);
        while (v != past && points[v[0]] == v[0] && points[v[1]] == v[1] && points[v[2]] == v[2]) v += 3;
        known = v == past ? own : shared;
        __atomic_store_n(block, known, __ATOMIC_RELAXED);
    }
    return known == own ? vertices : InPlace{};
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
            const MeshFaces::Around around = faces_.around(corner);
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

/// Computes Newell's sum relative to the first corner, which avoids cancellation far from the origin.
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

NormalReport writeFaceNormals(const NormalsCall& call) {
    using smooth::FaceTerms, smooth::kTermGroup, smooth::kTermTriangles;
    const MeshFaces& faces = call.faces;
    std::atomic<std::uint64_t> degenerate_faces{0}, degenerate_corners{0};
    const auto write = [&](std::uint32_t face, const FaceRow& row, NormalReport& counts) {
        const std::uint32_t first = faces.first(face), past = faces.past(face);
        if (row.isDegenerate()) {
            ++counts.degenerate_face_count;
            counts.fallback_corner_count += past - first;
            return;
        }
        const Vec3 normal = toFloat({row.x, row.y, row.z});
        for (std::uint32_t corner = first; corner != past; ++corner) call.out[corner] = normal;
    };
    const auto writeBlocks = [&](std::size_t begin, std::size_t end, NormalReport& counts) {
        TriangleBatch batch;
        FaceTerms terms;
        for (RangeLists::Batches batches(call.items, kTermTriangles, begin, end); batches.next(batch);) {
            const std::uint32_t* const v = fillGroup(batch.vertices, batch.count, kTermGroup, batch.own_vertices);
            call.kernel.compute(call.source(call.posed, false, false), v, batch.count, terms);
            for (std::size_t t = 0; t < batch.count; ++t) {
                const auto& [x, y, z, size] = terms.normal[t];
                write(batch.number(t), {x, y, z, size}, counts);
            }
        }
    };
    const auto writePolygons = [&](std::size_t begin, std::size_t end, NormalReport& counts) {
        for (auto face = static_cast<std::uint32_t>(begin); face != end; ++face) {
            const std::uint32_t first = faces.first(face), past = faces.past(face);
            const bool is_used = faces.isUsed(face);
            write(face, is_used ? faceRow(call.posed, first, past, call.factor, false) : FaceRow{0, 0, 0, 1}, counts);
        }
    };
    const std::size_t step = call.are_triangles ? kTermTriangles : 1;
    const std::size_t steps = (call.mesh.faceCount() + step - 1) / step;
    call.parallel.forRanges(steps, Parallel::kGrain / step, [&](std::size_t begin, std::size_t end) {
        NormalReport counts;
        call.are_triangles ? writeBlocks(begin, end, counts) : writePolygons(begin, end, counts);
        degenerate_faces += counts.degenerate_face_count;
        degenerate_corners += counts.fallback_corner_count;
    });
    return {faces.usedCount(), degenerate_faces, degenerate_corners};
}

}  // namespace tspace
