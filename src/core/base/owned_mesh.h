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

/// Arrays of a mesh, with tangents; used by all classes that own a mesh.
struct OwnedMesh {
    std::vector<Vec3> positions = {};
    std::vector<Vec3> normals = {};  ///< one per vertex, or empty, like tangents and uvs
    std::vector<Vec4> tangents = {};
    std::vector<Vec2> uvs = {};
    std::vector<std::uint32_t> indices = {};     ///< one per corner; empty: every corner has its own vertex
    std::vector<std::uint32_t> face_sizes = {};  ///< corners per face; empty: all faces are triangles

    /// Returns a view that is valid until the arrays change.
    [[nodiscard]] MeshView view() const {
        MeshView mesh{.positions = positions, .normals = normals, .uvs = uvs, .face_sizes = face_sizes};
        if (!indices.empty()) mesh.indices = std::span<const std::uint32_t>(indices);
        return mesh;
    }

    /// Appends `count` vertices of another mesh, starting at `first`. Attributes that `from` lacks are unchanged.
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
