// SPDX-License-Identifier: MIT
// A mesh of triangles, quads and pentagons over random vertices, for both APIs.
#pragma once

#include <cstdint>
#include <random>

#include "support/simple_mesh.h"
#include "tspace/tspace.h"

namespace tspace::test {

/// Returns the default options with a convention, because the convention has no default.
inline tspace_TangentOptions tangentOptions() {
    tspace_TangentOptions options;
    TSPACE_INIT(options);
    options.convention.v_axis = TSPACE_V_UP;
    return options;
}

struct RandomMesh : SimpleMesh {
    RandomMesh(unsigned seed, std::uint32_t face_count) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> value(-1.0f, 1.0f);
        const std::uint32_t vertex_count = face_count / 2 + 5;
        for (std::uint32_t v = 0; v < vertex_count; ++v) {
            positions.push_back({value(random), value(random), value(random)});
            normals.push_back({value(random), value(random), 1.5f});
            uvs.push_back({value(random), value(random)});
        }
        for (std::uint32_t f = 0; f < face_count; ++f) {
            face_sizes.push_back(3 + f % 3);
            // Choose consecutive vertices, so that the corners of a face differ, but faces share vertices.
            const std::uint32_t first = static_cast<std::uint32_t>(random()) % (vertex_count - 4);
            for (std::uint32_t k = 0; k < face_sizes.back(); ++k) indices.push_back(first + k);
        }
    }

    [[nodiscard]] tspace_Mesh c() const {
        tspace_Mesh mesh;
        TSPACE_INIT(mesh);
        mesh.positions = {&positions[0].x, positions.size(), 0};
        mesh.normals = {&normals[0].x, normals.size(), 0};
        mesh.uvs = {&uvs[0].x, uvs.size(), 0};
        mesh.indices = {indices.data(), indices.size(), TSPACE_INDEX_U32};
        mesh.face_sizes = face_sizes.data();
        mesh.face_count = face_sizes.size();
        return mesh;
    }
};

}  // namespace tspace::test
