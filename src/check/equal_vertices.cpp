// SPDX-License-Identifier: MIT
#include "check/equal_vertices.h"

#include <array>

#include "asset/unique_index.h"

namespace tspace {

EqualVertices findEqualVertices(const TangentView& mesh, bool with_uvs) {
    UniqueIndex<std::array<std::uint32_t, 8>> keys(mesh.positions.size());
    EqualVertices result;
    result.class_of.resize(mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const Vec3 &p = mesh.positions[v], &n = mesh.normals[v];
        const Vec2 uv = with_uvs ? mesh.uvs[v] : Vec2{};
        result.class_of[v] = keys.indexOf({weldBits(p.x), weldBits(p.y), weldBits(p.z), weldBits(n.x), weldBits(n.y),
                                           weldBits(n.z), weldBits(uv.x), weldBits(uv.y)});
    }
    result.class_count = keys.size();
    return result;
}

}  // namespace tspace
