// SPDX-License-Identifier: MIT
// The normal of each face at all its corners.
#include <atomic>

#include "core/base/range_lists.h"
#include "core/normals/normals_call.h"

namespace tspace {

NormalReport writeFaceNormals(const NormalsCall& call) {
    using smooth::FaceTerms, smooth::kTermGroup, smooth::kTermTriangles;
    const Faces& faces = call.faces;
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
