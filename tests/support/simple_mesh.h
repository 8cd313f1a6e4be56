// SPDX-License-Identifier: MIT
// A mesh that owns its arrays, for all tests of the core; and cubes.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "tspace/mesh.h"

namespace tspace::test {

struct SimpleMesh {
    std::vector<Vec3> positions = {};
    std::vector<Vec3> normals = {};
    std::vector<Vec2> uvs = {};
    std::vector<std::uint32_t> indices = {};
    std::vector<std::uint32_t> face_sizes = {};  ///< corners per face; empty: all faces are triangles

    std::uint32_t addVertex(const Vec3& position, const Vec3& normal, const Vec2& uv) {
        positions.push_back(position);
        normals.push_back(normal);
        uvs.push_back(uv);
        return static_cast<std::uint32_t>(positions.size() - 1);
    }
    /// Adds a face to a mesh that contains only triangles.
    void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { indices.insert(indices.end(), {a, b, c}); }
    void addFace(std::initializer_list<std::uint32_t> vertices) {
        addFace(std::span(vertices.begin(), vertices.size()));
    }
    void addFace(std::span<const std::uint32_t> vertices) {
        indices.insert(indices.end(), vertices.begin(), vertices.end());
        face_sizes.push_back(static_cast<std::uint32_t>(vertices.size()));
    }
    [[nodiscard]] std::size_t cornerCount() const { return indices.size(); }
    [[nodiscard]] MeshView view() const {
        MeshView mesh;
        mesh.positions = positions;
        mesh.normals = normals;
        mesh.uvs = uvs;
        mesh.indices = IndexView(std::span<const std::uint32_t>(indices));
        mesh.face_sizes = face_sizes;
        return mesh;
    }
};

/// The faces of the cube [-1, 1]^3, counter-clockwise seen from outside. Bits 0, 1 and 2 of a vertex index select x, y
/// and z.
inline constexpr std::array<std::array<std::uint32_t, 4>, 6> kCubeFaces{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
inline constexpr std::array<Vec3, 6> kCubeNormals{
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

inline std::vector<Vec3> cubePositions() {
    std::vector<Vec3> positions;
    for (unsigned i = 0; i < 8; ++i) {
        positions.push_back({(i & 1) != 0 ? 1.0f : -1.0f, (i & 2) != 0 ? 1.0f : -1.0f, (i & 4) != 0 ? 1.0f : -1.0f});
    }
    return positions;
}

/// Returns the cube as six quads.
inline SimpleMesh quadCube() {
    SimpleMesh cube;
    cube.positions = cubePositions();
    for (const auto& f : kCubeFaces) cube.addFace({f[0], f[1], f[2], f[3]});
    return cube;
}

/// Returns the cube as twelve triangles. Bit f of `diagonals` selects the diagonal of face f.
inline SimpleMesh triangleCube(unsigned diagonals) {
    SimpleMesh cube;
    cube.positions = cubePositions();
    for (std::size_t f = 0; f < kCubeFaces.size(); ++f) {
        const auto& q = kCubeFaces[f];
        const std::size_t s = diagonals >> f & 1;
        cube.addFace({q[s], q[s + 1], q[s + 2]});
        cube.addFace({q[s], q[s + 2], q[(s + 3) % 4]});
    }
    return cube;
}

}  // namespace tspace::test
