// SPDX-License-Identifier: MIT
// Functions for meshes of any source.
#include "mesh.h"

#include <random>

namespace tspace::bench {

MeshView Mesh::view() const {
    MeshView view;
    view.positions = positions;
    view.normals = normals;
    view.uvs = uvs;
    if (!indices.empty()) view.indices = IndexView(std::span<const std::uint32_t>(indices));
    view.face_sizes = face_sizes;
    view.face_size = face_size;
    return view;
}

std::size_t Mesh::triangleCount() const {
    if (face_sizes.empty()) return cornerCount() / face_size * (face_size - 2);
    std::size_t count = 0;
    for (const std::uint32_t size : face_sizes) count += size < 3 ? 0 : size - 2;
    return count;
}

Mesh Mesh::triangulated() const {
    Mesh cut{.positions = positions, .normals = normals, .uvs = uvs};
    cut.indices.reserve(3 * triangleCount());
    const IndexView corner = view().indices;
    const std::size_t faces = view().faceCount();
    for (std::size_t face = 0, first = 0; face < faces; ++face) {
        const std::size_t size = face_sizes.empty() ? face_size : face_sizes[face];
        for (std::size_t i = 2; i < size; ++i) cut.triangle(corner[first], corner[first + i - 1], corner[first + i]);
        first += size;
    }
    return cut;
}

std::uint32_t Mesh::vertex(const Vec3& position, const Vec3& normal, const Vec2& uv) {
    positions.push_back(position);
    normals.push_back(normal);
    uvs.push_back(uv);
    return static_cast<std::uint32_t>(positions.size() - 1);
}

void Mesh::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { indices.insert(indices.end(), {a, b, c}); }

Mesh unindexed(const Mesh& mesh) {
    Mesh soup{.face_sizes = mesh.face_sizes, .face_size = mesh.face_size};
    soup.positions.reserve(mesh.indices.size());
    soup.normals.reserve(mesh.indices.size());
    soup.uvs.reserve(mesh.indices.size());
    for (const std::uint32_t v : mesh.indices) soup.vertex(mesh.positions[v], mesh.normals[v], mesh.uvs[v]);
    return soup;
}

Mesh shuffled(Mesh mesh) {
    std::mt19937 random(1);
    const std::size_t size = mesh.face_size, faces = mesh.cornerCount() / size;
    for (std::size_t i = faces; i-- > 1;) {
        const std::size_t j = random() % (i + 1);
        for (std::size_t k = 0; k < size; ++k) {
            const std::size_t a = size * i + k, b = size * j + k;
            if (!mesh.indices.empty()) {
                std::swap(mesh.indices[a], mesh.indices[b]);
                continue;
            }
            std::swap(mesh.positions[a], mesh.positions[b]);
            std::swap(mesh.normals[a], mesh.normals[b]);
            std::swap(mesh.uvs[a], mesh.uvs[b]);
        }
    }
    return mesh;
}

}  // namespace tspace::bench
