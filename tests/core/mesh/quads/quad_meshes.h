// SPDX-License-Identifier: MIT
// Meshes of quads and triangles, and the triangle lists that exporters write for them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "support/scene_file.h"

namespace tspace::test {

/// Polygons over the vertices of `data`; the indices of `data` are not used.
struct PolygonMesh {
    ModelData data = {};
    std::vector<std::uint32_t> corners = {}, sizes = {};

    [[nodiscard]] MeshView view() const {
        MeshView mesh;
        mesh.positions = data.positions;
        mesh.normals = data.normals;
        mesh.uvs = data.uvs;
        mesh.indices = IndexView(std::span<const std::uint32_t>(corners));
        mesh.face_sizes = sizes;
        return mesh;
    }
};

/// Returns n x n quads over a hilly height field with curved UVs, so that the shorter diagonal in UV space varies, and
/// frames depend on it. Every `triangles_every`-th quad is replaced by two triangles (0: no quad is replaced).
inline PolygonMesh hills(int n, int triangles_every = 0) {
    PolygonMesh mesh;
    const auto height = [](float x, float y) { return 0.35F * std::sin(5 * x + 1) * std::cos(4 * y); };
    for (int y = 0; y <= n; ++y) {
        for (int x = 0; x <= n; ++x) {
            const float s = static_cast<float>(x) / static_cast<float>(n),
                        t = static_cast<float>(y) / static_cast<float>(n);
            const float dx = (height(s + 1e-3F, t) - height(s - 1e-3F, t)) / 2e-3F;
            const float dy = (height(s, t + 1e-3F) - height(s, t - 1e-3F)) / 2e-3F;
            const float size = std::sqrt(dx * dx + dy * dy + 1);
            mesh.data.positions.push_back({s, t, height(s, t)});
            mesh.data.normals.push_back({-dx / size, -dy / size, 1 / size});
            mesh.data.uvs.push_back({s + 0.08F * std::sin(9 * t + 2 * s), t + 0.08F * std::sin(8 * s - t)});
        }
    }
    int quad = 0;
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x, ++quad) {
            const auto a = static_cast<std::uint32_t>(y * (n + 1) + x), b = a + 1;
            const std::uint32_t d = a + static_cast<std::uint32_t>(n) + 1, c = d + 1;
            const bool is_cut = triangles_every != 0 && quad % triangles_every == 0;
            const std::vector<std::uint32_t> corners =
                is_cut ? std::vector<std::uint32_t>{a, b, d, b, c, d} : std::vector<std::uint32_t>{a, b, c, d};
            mesh.corners.insert(mesh.corners.end(), corners.begin(), corners.end());
            mesh.sizes.insert(mesh.sizes.end(), is_cut ? 2 : 1, is_cut ? 3 : 4);
        }
    }
    return mesh;
}

/// The two triangles that an exporter writes for quad 0 1 2 3, as indices of its corners.
using Cut = std::array<unsigned, 6>;
inline constexpr Cut kFan = {0, 1, 2, 0, 2, 3};       // Blender and most other programs
inline constexpr Cut kOtherFan = {0, 1, 3, 1, 2, 3};  // Blender, if kFan would flip a triangle
inline const std::vector<Cut> kCuts = {
    kFan, kOtherFan, {0, 1, 2, 2, 3, 0}, {1, 2, 0, 3, 0, 2}, {2, 0, 1, 0, 2, 3}, {3, 0, 1, 3, 1, 2}};

/// Returns, for each corner of the triangles, the corresponding corner of the polygons.
inline std::vector<std::uint32_t> cutQuads(const PolygonMesh& mesh, const Cut& cut) {
    std::vector<std::uint32_t> corners;
    std::uint32_t first = 0;
    for (const std::uint32_t size : mesh.sizes) {
        const std::size_t count = size == 4 ? 6 : 3;
        for (std::size_t k = 0; k < count; ++k)
            corners.push_back(first + (size == 4 ? cut[k] : static_cast<unsigned>(k)));
        first += size;
    }
    return corners;
}

/// Returns the mesh with its quads split into triangles according to `cut`; vertices are unchanged.
inline ModelData trianglesOf(const PolygonMesh& mesh, const Cut& cut) {
    ModelData data = mesh.data;
    for (const std::uint32_t corner : cutQuads(mesh, cut)) data.indices.push_back(mesh.corners[corner]);
    return data;
}

inline MeshView viewOf(const ModelData& data) {
    MeshView mesh;
    mesh.positions = data.positions;
    mesh.normals = data.normals;
    mesh.uvs = data.uvs;
    mesh.indices = IndexView(std::span<const std::uint32_t>(data.indices));
    return mesh;
}

/// Returns the output of an exporter that computes tangents on the polygons and writes triangles: vertices with one
/// tangent each, for glTF.
inline ModelData withTangentsOnQuads(const PolygonMesh& mesh, const Cut& cut) {
    std::vector<Vec4> tangents(mesh.corners.size());
    if (!generateTangents(mesh.view(), {.convention = conventions::opengl}, {.tangents = std::span(tangents)}))
        throw std::exception();
    ModelData data = unwelded(trianglesOf(mesh, cut));
    for (const std::uint32_t corner : cutQuads(mesh, cut)) {
        Vec4 tangent = tangents[corner];
        tangent.w = -tangent.w;
        data.tangents.push_back(tangent);
    }
    return data;
}

}  // namespace tspace::test
