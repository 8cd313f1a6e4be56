// SPDX-License-Identifier: MIT
// Cutting faces into triangles, by the rule of polygon.h.
#include "core/tangents/mikktspace/faces.h"

#include <algorithm>
#include <span>

#include "core/base/mesh_loops.h"
#include "core/base/polygon.h"
#include "core/tangents/mikktspace/words.h"

namespace tspace::mikk {

namespace {

/// The sizes of faces that are cut: 3 and 4, and those of n-gons if wanted. All others are skipped.
class UsedSizes {
  public:
    explicit UsedSizes(Ngons ngons) : count_(ngons == Ngons::triangulate ? 0u - kLeast : 5 - kLeast) {}
    [[nodiscard]] bool has(std::uint32_t size) const { return size - kLeast < count_; }

  private:
    static constexpr std::uint32_t kLeast = 3;
    std::uint32_t count_;
};

/// Counts of faces and corners. Corners are fewer than 2^31.
struct FaceCounts {
    std::uint32_t triangles = 0;  // after cutting
    std::uint32_t faces_of_three = 0, skipped_faces = 0, skipped_corners = 0;
};

/// The loop has no branch, so that it becomes SIMD: a size that is not used counts as 0.
FaceCounts countFaces(std::span<const std::uint32_t> sizes, Ngons ngons) {
    const UsedSizes used(ngons);
    std::uint32_t corners = 0, used_corners = 0, used_faces = 0, faces_of_three = 0;
    for (const std::uint32_t size : sizes) {
        const std::uint32_t used_size = used.has(size) ? size : 0;
        corners += size;
        used_corners += used_size;
        used_faces += used_size != 0 ? 1 : 0;
        faces_of_three += size == 3 ? 1 : 0;
    }
    const auto faces = static_cast<std::uint32_t>(sizes.size());
    return {used_corners - 2 * used_faces, faces_of_three, faces - used_faces, corners - used_corners};
}

/// Counts the faces of a mesh by their list of sizes, or by the one size of all.
FaceCounts countFaces(const MeshView& mesh, Ngons ngons) {
    if (!mesh.face_sizes.empty()) return countFaces(mesh.face_sizes, ngons);
    const std::uint32_t size = mesh.face_size;
    const auto faces = static_cast<std::uint32_t>(mesh.faceCount());
    FaceCounts counts = countFaces(std::span(&size, faces == 0 ? 0 : 1), ngons);
    for (std::uint32_t* count :
         {&counts.triangles, &counts.faces_of_three, &counts.skipped_faces, &counts.skipped_corners})
        *count *= faces;
    return counts;
}

}  // namespace

std::uint64_t countTriangles(const MeshView& mesh, Ngons ngons) { return countFaces(mesh, ngons).triangles; }

TriangleList cutFaces(const MeshView& mesh, Ngons ngons, const Allocator* allocator) {
    const FaceCounts counts = countFaces(mesh, ngons);
    TriangleList list;
    list.count = counts.triangles;
    if (counts.faces_of_three == mesh.faceCount()) return list;
    list.skipped_face_count = counts.skipped_faces;
    list.corners = Buffer<std::uint32_t>(allocator, 3 * list.count);
    list.faces = Buffer<std::uint32_t>(allocator, list.count);
    list.skipped_corners = Buffer<std::uint32_t>(allocator, counts.skipped_corners);
    FaceCutter cutter(mesh);
    const UsedSizes used(ngons);
    std::uint32_t *to = list.corners.data(), *face_of = list.faces.data(), *skipped = list.skipped_corners.data();
    forEachFace(mesh, [&](std::size_t face, std::size_t corner, std::uint32_t size) {
        if (used.has(size)) {
            cutter.cut(corner, size, to);
            to += 3 * (size - 2);
            face_of = std::fill_n(face_of, size - 2, static_cast<std::uint32_t>(face));
        } else {
            for (std::uint32_t k = 0; k < size; ++k) *skipped++ = static_cast<std::uint32_t>(corner + k);
        }
    });
    return list;
}

const std::uint32_t* readCutTriangles(const MeshView& mesh, const TriangleList& triangles, std::size_t first,
                                      std::size_t count, std::uint32_t* buffer) {
    const std::uint32_t* corners = triangles.corners.data() + 3 * first;
    withIndices(mesh.indices, [&](auto vertexOf) {
        for (std::size_t i = 0; i < 3 * count; ++i) buffer[i] = vertexOf(corners[i]);
    });
    return buffer;
}

}  // namespace tspace::mikk
