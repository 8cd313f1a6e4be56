// SPDX-License-Identifier: MIT
// A random mesh with an index list per attribute, and the same mesh with a single list, as a caller would convert it.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <random>
#include <span>
#include <vector>

#include "support/same_bits.h"
#include "support/simple_mesh.h"

namespace tspace::test {

struct ListsMesh : SimpleMesh {
    std::vector<std::uint32_t> uv_indices;
    std::vector<std::uint16_t> normal_indices;

    /// Creates triangles, quads and pentagons from few vertices, so that faces share vertices.
    ListsMesh(unsigned seed, std::uint32_t face_count) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> value(-1.0f, 1.0f);
        const std::uint32_t vertex_count = face_count / 2 + 5, uv_count = face_count / 2 + 9;
        for (std::uint32_t v = 0; v < vertex_count; ++v)
            positions.push_back({value(random), value(random), value(random)});
        positions.push_back({7, 7, 7});  // a vertex that no corner uses
        for (int n = 0; n < 7; ++n) normals.push_back({value(random), value(random), 1.5f});
        for (std::uint32_t u = 0; u < uv_count; ++u) uvs.push_back({value(random), value(random)});
        for (std::uint32_t f = 0; f < face_count; ++f) {
            face_sizes.push_back(3 + f % 3);
            const auto first = static_cast<std::uint32_t>(random() % (vertex_count - 4));
            const bool is_seam = random() % 3 == 0;
            for (std::uint32_t k = 0; k < face_sizes.back(); ++k) {
                indices.push_back(first + k);
                normal_indices.push_back(static_cast<std::uint16_t>((first + k) % 6 + (random() % 5 == 0 ? 1 : 0)));
                uv_indices.push_back(first + k + (is_seam ? 4 : 0));
            }
        }
    }

    [[nodiscard]] MeshView view() const {
        MeshView mesh = SimpleMesh::view();
        mesh.normal_indices = std::span<const std::uint16_t>(normal_indices);
        mesh.uv_indices = std::span<const std::uint32_t>(uv_indices);
        return mesh;
    }
};

/// A mesh with one vertex per combination of indices.
struct UnrolledMesh : SimpleMesh {
    std::vector<std::uint32_t> source_positions, source_normals;

    explicit UnrolledMesh(const ListsMesh& mesh) {
        face_sizes = mesh.face_sizes;
        std::map<std::array<std::uint32_t, 3>, std::uint32_t> vertices;
        for (std::size_t c = 0; c < mesh.cornerCount(); ++c) {
            const std::array<std::uint32_t, 3> key{mesh.indices[c], mesh.normal_indices[c], mesh.uv_indices[c]};
            const auto [found, is_new] = vertices.emplace(key, static_cast<std::uint32_t>(positions.size()));
            if (is_new) {
                addVertex(mesh.positions[key[0]], mesh.normals[key[1]], mesh.uvs[key[2]]);
                source_positions.push_back(key[0]);
                source_normals.push_back(key[1]);
            }
            indices.push_back(found->second);
        }
    }
};

}  // namespace tspace::test
