// SPDX-License-Identifier: MIT
#include "core/mesh/surface/equal_vertices.h"

#include <array>

#include "core/base/unique_index.h"

namespace tspace {

EqualVertices findEqualVertices(const StridedSpan<const Vec3>& positions, const StridedSpan<const Vec3>& normals,
                                const StridedSpan<const Vec2>& uvs) {
    UniqueIndex<std::array<std::uint32_t, 8>> keys(positions.count);
    EqualVertices result;
    result.class_of.resize(positions.count);
    for (std::size_t v = 0; v < positions.count; ++v) {
        const Vec3 &p = positions[v], &n = normals[v];
        const Vec2 uv = uvs.empty() ? Vec2{} : uvs[v];
        result.class_of[v] = keys.indexOf({weldBits(p.x), weldBits(p.y), weldBits(p.z), weldBits(n.x), weldBits(n.y),
                                           weldBits(n.z), weldBits(uv.x), weldBits(uv.y)});
    }
    result.class_count = keys.size();
    return result;
}

EqualVertices findEqualVertices(const TangentView& mesh, bool with_uvs) {
    return findEqualVertices(mesh.positions, mesh.normals, with_uvs ? mesh.uvs : std::span<const Vec2>());
}

}  // namespace tspace
