// SPDX-License-Identifier: MIT
// Tangents for a small mesh from C++: one call, and what it gives.
#include <array>
#include <cstdio>
#include <tspace/tspace.hpp>

namespace {

struct Vertex {
    tspace::Vec3 position;
    tspace::Vec3 normal;
    tspace::Vec2 uv;
};

// Two quads side by side. The texture runs to the right on the first and is mirrored on the second, so the
// two vertices between them need two tangents each.
constexpr std::array<Vertex, 6> kVertices = {{{{0, 0, 0}, {0, 0, 1}, {0, 0}},
                                              {{1, 0, 0}, {0, 0, 1}, {1, 0}},
                                              {{2, 0, 0}, {0, 0, 1}, {0, 0}},
                                              {{0, 1, 0}, {0, 0, 1}, {0, 1}},
                                              {{1, 1, 0}, {0, 0, 1}, {1, 1}},
                                              {{2, 1, 0}, {0, 0, 1}, {0, 1}}}};
constexpr std::array<std::uint16_t, 8> kIndices = {0, 1, 4, 3, 1, 2, 5, 4};

int fail(const tspace::Error& error) {
    std::fprintf(stderr, "%s: %s\n", tspace::errorName(error.code), error.message.c_str());
    return 1;
}

}  // namespace

int main() {
    tspace::MeshView mesh;
    mesh.positions = {&kVertices[0].position, kVertices.size(), sizeof(Vertex)};
    mesh.normals = {&kVertices[0].normal, kVertices.size(), sizeof(Vertex)};
    mesh.uvs = {&kVertices[0].uv, kVertices.size(), sizeof(Vertex)};
    mesh.indices = std::span<const std::uint16_t>(kIndices);
    mesh.face_size = 4;

    tspace::IndexedFramesOptions options;  // method mikktspace
    options.tangents.convention = tspace::conventions::gltf;
    const auto frames = tspace::makeIndexedFrames(mesh, options);
    if (!frames) return fail(frames.error());

    // Corners that disagree got a vertex of their own.
    for (std::size_t v = 0; v < frames->vertexCount(); ++v) {
        const tspace::Vec4& t = frames->tangents[v];
        std::printf("vertex %zu copies %u: tangent %g %g %g sign %g\n", v,
                    static_cast<unsigned>(frames->source_vertices[v]), t.x, t.y, t.z, t.w);
    }
    std::printf("%zu vertices became %zu\n", kVertices.size(), frames->vertexCount());
    return 0;
}
