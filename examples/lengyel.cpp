// SPDX-License-Identifier: MIT
// Eric Lengyel's method (Computing Tangent Space Basis Vectors for an Arbitrary Mesh, 2001), implemented with public
// functions: one loop over the triangles, one loop over the vertices. generateTangents() with Method::lengyel computes
// the same tangents.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <tspace/tspace.hpp>
#include <vector>

namespace {

using tspace::Vec3;

void add(Vec3& sum, const Vec3& v) { sum = {sum.x + v.x, sum.y + v.y, sum.z + v.z}; }

/// Returns one tangent per vertex; w is the sign in B = w * cross(N, T).
std::vector<tspace::Vec4> lengyelTangents(const std::vector<Vec3>& positions, const std::vector<Vec3>& normals,
                                          const std::vector<tspace::Vec2>& uvs,
                                          const std::vector<std::uint32_t>& indices) {
    // Sum dP/du and dP/dv of the triangles at each vertex. They are not normalized.
    std::vector<Vec3> along_u(positions.size()), along_v(positions.size());
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const std::uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
        const Vec3 corners[] = {positions[a], positions[b], positions[c]};
        const tspace::Vec2 corner_uvs[] = {uvs[a], uvs[b], uvs[c]};
        const tspace::FaceFrame face = tspace::faceFrame(corners, corner_uvs);
        for (const std::uint32_t vertex : {a, b, c}) {
            add(along_u[vertex], face.tangent);
            add(along_v[vertex], face.bitangent);
        }
    }
    // Make each tangent perpendicular to the normal (Gram-Schmidt). The sign says on which side of T and N dP/dv lies.
    std::vector<tspace::Vec4> tangents(positions.size());
    for (std::size_t v = 0; v < positions.size(); ++v)
        tangents[v] = tspace::packTangent({.tangent = along_u[v], .bitangent = along_v[v], .normal = normals[v]});
    return tangents;
}

}  // namespace

int main() {
    // A square that is bent upwards; the texture covers it once.
    const std::vector<Vec3> positions = {{0, 0, 0}, {2, 0, 1}, {2, 2, 1}, {0, 2, 0}};
    const std::vector<Vec3> normals = {{-0.6f, 0, 0.8f}, {0, 0, 1}, {0, 0, 1}, {-0.6f, 0, 0.8f}};
    const std::vector<tspace::Vec2> uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 3};
    const std::vector<tspace::Vec4> by_hand = lengyelTangents(positions, normals, uvs, indices);

    tspace::MeshView mesh;
    mesh.positions = positions;
    mesh.normals = normals;
    mesh.uvs = uvs;
    mesh.indices = indices;
    std::vector<tspace::Vec4> by_library(positions.size());
    const auto report = tspace::generateTangents(mesh,
                                                 {.method = tspace::Method::lengyel,
                                                  .convention = tspace::conventions::opengl,
                                                  .domain = tspace::OutputDomain::vertex},
                                                 {.tangents = by_library});
    if (!report) return 1;
    float difference = 0;
    for (std::size_t v = 0; v < positions.size(); ++v) {
        const tspace::Vec4 &t = by_hand[v], &other = by_library[v];
        difference = std::fmax(difference, std::fabs(t.x - other.x) + std::fabs(t.y - other.y) +
                                               std::fabs(t.z - other.z) + std::fabs(t.w - other.w));
        std::printf("vertex %zu: tangent %.4f %.4f %.4f sign %g\n", v, t.x, t.y, t.z, t.w);
    }
    std::printf("largest difference from the library: %s\n", difference < 1e-6f ? "below 0.000001" : "too large");
    return difference < 1e-6f ? 0 : 1;
}
