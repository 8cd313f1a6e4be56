// SPDX-License-Identifier: MIT
// Baseline for all times. It is intentionally simple, like the code of most programs.
#include "plain_loop.h"

#include <cmath>

namespace tspace::bench {

namespace {

Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 operator*(const Vec3& a, float b) { return {a.x * b, a.y * b, a.z * b}; }
float dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace

void plainLoop(const Mesh& mesh, std::vector<Vec4>& tangents) {
    std::vector<Vec3> tangent_sums(mesh.positions.size()), bitangent_sums(mesh.positions.size());

    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::uint32_t i0 = mesh.indices[i], i1 = mesh.indices[i + 1], i2 = mesh.indices[i + 2];
        const Vec3 e1 = mesh.positions[i1] - mesh.positions[i0], e2 = mesh.positions[i2] - mesh.positions[i0];
        const float s1 = mesh.uvs[i1].x - mesh.uvs[i0].x, t1 = mesh.uvs[i1].y - mesh.uvs[i0].y;
        const float s2 = mesh.uvs[i2].x - mesh.uvs[i0].x, t2 = mesh.uvs[i2].y - mesh.uvs[i0].y;
        const float determinant = s1 * t2 - s2 * t1;
        if (determinant == 0) continue;
        const float r = 1.0f / determinant;
        const Vec3 t = (e1 * t2 - e2 * t1) * r, b = (e2 * s1 - e1 * s2) * r;
        tangent_sums[i0] = tangent_sums[i0] + t;
        tangent_sums[i1] = tangent_sums[i1] + t;
        tangent_sums[i2] = tangent_sums[i2] + t;
        bitangent_sums[i0] = bitangent_sums[i0] + b;
        bitangent_sums[i1] = bitangent_sums[i1] + b;
        bitangent_sums[i2] = bitangent_sums[i2] + b;
    }

    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const Vec3& n = mesh.normals[v];
        const Vec3& t = tangent_sums[v];
        Vec3 orthogonal = t - n * dot(n, t);
        const float length = std::sqrt(dot(orthogonal, orthogonal));
        if (length > 0) orthogonal = orthogonal * (1.0f / length);
        const float sign = dot(cross(n, t), bitangent_sums[v]) < 0 ? -1.0f : 1.0f;
        tangents[v] = {orthogonal.x, orthogonal.y, orthogonal.z, sign};
    }
}

}  // namespace tspace::bench
