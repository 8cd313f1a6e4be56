// SPDX-License-Identifier: MIT
#include "core/mesh/pools/local_mesh.h"

#include <utility>

#include "tspace/split.h"

namespace tspace {

namespace {

constexpr std::uint32_t kNoSlot = 0xffffffffu;

}  // namespace

MeshView viewInPool(const PoolView& pool, const PrimitiveGeometry& primitive) {
    MeshView mesh;
    mesh.positions = pool.positions;
    mesh.normals = pool.normals;
    mesh.uvs = pool.uvs;
    mesh.indices = IndexView(spanOf(primitive.indices));
    mesh.face_sizes = primitive.face_sizes;
    return mesh;
}

void takeFaces(QuadFaces&& faces, LocalMesh& mesh) {
    mesh.own_indices = gather(mesh.indices, faces.corners);
    mesh.useOwnIndices();
    mesh.own_face_sizes = std::move(faces.sizes);
    mesh.face_sizes = mesh.own_face_sizes;
    mesh.face_corners = std::move(faces.face_corners);
}

LocalMesh LocalMeshes::make(const PrimitiveGeometry& primitive) {
    LocalMesh mesh;
    mesh.face_sizes = primitive.face_sizes;
    if (primitive_count_ > 1 || pool_.positions.count > primitive.indices.size()) {
        takeUsedPart(primitive, mesh);
        return mesh;
    }
    mesh.positions = pool_.positions;
    mesh.normals = pool_.normals;
    mesh.uvs = pool_.uvs;
    mesh.indices = primitive.indices;
    return mesh;
}

/// The used part of the pool, vertices in order of first use.
void LocalMeshes::takeUsedPart(const PrimitiveGeometry& primitive, LocalMesh& mesh) {
    local_of_vertex_.resize(pool_.positions.count, kNoSlot);
    std::vector<std::uint32_t>& sources = mesh.sources;
    mesh.own_indices.reserve(primitive.indices.size());
    for (const std::uint32_t vertex : primitive.indices) {
        std::uint32_t& local = local_of_vertex_[vertex];
        if (local == kNoSlot) {
            local = static_cast<std::uint32_t>(sources.size());
            sources.push_back(vertex);
        }
        mesh.own_indices.push_back(local);
    }
    for (const std::uint32_t vertex : sources) local_of_vertex_[vertex] = kNoSlot;
    mesh.own_positions = gather(pool_.positions, sources);
    mesh.own_normals = gather(pool_.normals, sources);
    mesh.own_uvs = gather(pool_.uvs, sources);
    mesh.useOwnIndices();
    mesh.useOwnVertices();
}

std::vector<Vec3> gatherNormals(const std::vector<Vec3>& normals, const std::vector<std::uint32_t>& corners) {
    std::vector<Vec3> result;
    result.reserve(corners.size());
    for (const std::uint32_t corner : corners) {
        result.push_back(corner == kNoCorner ? Vec3{0, 0, 1} : normals[corner]);
    }
    return result;
}

}  // namespace tspace
