// SPDX-License-Identifier: MIT
// The normal of each face at all its corners.
#include <atomic>

#include "core/range_lists.h"
#include "normals/normals_call.h"

namespace tspace {

using smooth::FaceTerms, smooth::kTermGroup, smooth::kTermTriangles;

NormalReport writeFaceNormals(const NormalsCall& call) {
    const Faces& faces = call.faces;
    std::atomic<std::uint64_t> degenerate_faces{0}, degenerate_corners{0};
    const auto write = [&](std::uint32_t face, const FaceRow& row) {
        const std::uint32_t first = faces.first(face), past = faces.past(face);
        if (row.isDegenerate()) {
            ++degenerate_faces;
            degenerate_corners += past - first;
            return;
        }
        const Vec3 normal = toFloat({row.x, row.y, row.z});
        for (std::uint32_t corner = first; corner != past; ++corner) call.out[corner] = normal;
    };
    const auto writeBlocks = [&](std::size_t begin, std::size_t end) {
        TriangleBatch batch;
        FaceTerms terms;
        for (RangeLists::Batches batches(call.items, kTermTriangles, begin, end); batches.next(batch);) {
            const std::uint32_t* const v = fillGroup(batch.vertices, batch.count, kTermGroup, batch.own_vertices);
            call.kernel.compute(call.source(call.posed, false, false), v, batch.count, terms);
            for (std::size_t t = 0; t < batch.count; ++t) {
                const auto& [x, y, z, size] = terms.normal[t];
                write(batch.number(t), {x, y, z, size});
            }
        }
    };
    const auto writePolygons = [&](std::size_t begin, std::size_t end) {
        for (auto face = static_cast<std::uint32_t>(begin); face != end; ++face)
            write(face, faces.isUsed(face)
                            ? faceRow(call.posed, faces.first(face), faces.past(face), call.factor, false)
                            : FaceRow{0, 0, 0, 1});
    };
    constexpr std::size_t kBlockGrain = Parallel::kGrain / kTermTriangles;
    const std::size_t count = call.mesh.faceCount(), block_count = (count + kTermTriangles - 1) / kTermTriangles;
    if (call.are_triangles)
        call.parallel.forRanges(block_count, kBlockGrain, writeBlocks);
    else
        call.parallel.forRanges(count, Parallel::kGrain, writePolygons);
    return {faces.usedCount(), degenerate_faces, degenerate_corners};
}

}  // namespace tspace
