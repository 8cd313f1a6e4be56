// SPDX-License-Identifier: MIT
// A mesh that owns its arrays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tspace/mesh.h"
#include "tspace/span.h"

namespace tspace {

/// The arrays that a MeshView shows, and tangents. Whatever holds a mesh of its own holds one of these.
struct OwnedMesh {
    std::vector<Vec3> positions = {};
    std::vector<Vec3> normals = {};  ///< one per vertex, or empty, as the next two
    std::vector<Vec4> tangents = {};
    std::vector<Vec2> uvs = {};
    std::vector<std::uint32_t> indices = {};     ///< one per corner; empty: every corner has its own vertex
    std::vector<std::uint32_t> face_sizes = {};  ///< empty: triangles

    /// Valid while the arrays stay as they are.
    [[nodiscard]] MeshView view() const {
        MeshView mesh{.positions = positions, .normals = normals, .uvs = uvs, .face_sizes = face_sizes};
        if (!indices.empty()) mesh.indices = std::span<const std::uint32_t>(indices);
        return mesh;
    }

    /// Appends vertices of another mesh, `count` from `first` on, in the arrays that it has.
    void addVertices(const OwnedMesh& from, std::size_t first, std::size_t count) {
        const auto add = [&](const auto& values, auto& to) {
            if (values.empty()) return;
            const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
            to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
        };
        add(from.positions, positions);
        add(from.normals, normals);
        add(from.tangents, tangents);
        add(from.uvs, uvs);
    }
};

}  // namespace tspace
