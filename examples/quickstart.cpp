// SPDX-License-Identifier: MIT
// Tangents for a small mesh from C++: generate, sanitize, split, print.
#include <array>
#include <cstdio>
#include <tspace/tspace.hpp>
#include <vector>

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

    std::vector<tspace::Vec4> tangents(mesh.cornerCount());  // one per corner: x, y, z, sign
    tspace::TangentOptions options;                          // method mikktspace
    options.convention = tspace::conventions::gltf;
    const auto generated = tspace::generateTangents(mesh, options, {.tangents = tangents});
    if (!generated) return fail(generated.error());
    const auto sanitized = tspace::sanitizeTangents(mesh, tangents);
    if (!sanitized) return fail(sanitized.error());

    // Corners that disagree get a vertex of their own.
    const std::array attributes = {tspace::cornerAttribute(tspace::StridedSpan<const tspace::Vec4>(tangents))};
    const auto split = tspace::splitVertices(mesh.indices, kVertices.size(), tangents.size(), attributes);
    if (!split) return fail(split.error());
    for (std::size_t v = 0; v < split->vertexCount(); ++v) {
        const tspace::Vec4& t = tangents[split->source_corners[v]];
        std::printf("vertex %zu copies %u: tangent %g %g %g sign %g\n", v,
                    static_cast<unsigned>(split->source_vertices[v]), t.x, t.y, t.z, t.w);
    }
    std::printf("%zu vertices became %zu\n", kVertices.size(), split->vertexCount());
    return 0;
}
