// SPDX-License-Identifier: MIT
// Tangents for a small mesh from C++: one call, and its result.
#include <cstdint>
#include <cstdio>
#include <tspace/tspace.hpp>

namespace {

// Two adjacent squares, as an interleaved vertex buffer: position, normal, UV. The texture runs to the right on the
// first square and is mirrored on the second, so the two vertices between them need two tangents each.
constexpr std::size_t kFloatsPerVertex = 8, kVertexCount = 6;
// clang-format off
constexpr float kVertices[kVertexCount * kFloatsPerVertex] = {
    0, 0, 0,  0, 0, 1,  0, 0,
    1, 0, 0,  0, 0, 1,  1, 0,
    2, 0, 0,  0, 0, 1,  0, 0,
    0, 1, 0,  0, 0, 1,  0, 1,
    1, 1, 0,  0, 0, 1,  1, 1,
    2, 1, 0,  0, 0, 1,  0, 1,
};
// clang-format on
constexpr std::uint16_t kIndices[] = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};

int fail(const tspace::Error& error) {
    std::fprintf(stderr, "%s: %s\n", tspace::errorName(error.code), error.message.c_str());
    return 1;
}

}  // namespace

int main() {
    constexpr std::size_t kStride = kFloatsPerVertex * sizeof(float);  // bytes
    tspace::MeshView mesh;
    mesh.positions = tspace::vec3Span(kVertices, kVertexCount, kStride);
    mesh.normals = tspace::vec3Span(kVertices + 3, kVertexCount, kStride);
    mesh.uvs = tspace::vec2Span(kVertices + 6, kVertexCount, kStride);
    mesh.indices = kIndices;

    tspace::IndexedFramesOptions options;  // method mikktspace
    options.tangents.convention = tspace::conventions::gltf;
    const auto frames = tspace::makeIndexedFrames(mesh, options);
    if (!frames) return fail(frames.error());

    // A vertex whose corners need different tangents is split: the copies follow the vertices of the mesh.
    for (std::size_t v = 0; v < frames->vertexCount(); ++v) {
        const tspace::Vec4& t = frames->tangents[v];
        std::printf("vertex %zu copies %u: tangent %g %g %g sign %g\n", v,
                    static_cast<unsigned>(frames->source_vertices[v]), t.x, t.y, t.z, t.w);
    }
    std::printf("%zu vertices became %zu\n", kVertexCount, frames->vertexCount());
    return 0;
}
