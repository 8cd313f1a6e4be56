// SPDX-License-Identifier: MIT
#include "core/mesh/surface/uv_votes.h"

#include "core/mesh/surface/surface.h"

namespace tspace {

std::vector<std::uint8_t> uvVotes(const MeshView& triangles) {
    const StridedSpan<const Vec3>& positions = triangles.positions;
    const StridedSpan<const Vec2>& uvs = triangles.uvs;
    std::vector<std::uint8_t> votes(triangles.cornerCount() / 3, 0);
    for (std::size_t t = 0; t < votes.size() && !uvs.empty(); ++t) {
        const IndexView& v = triangles.indices;
        const std::uint32_t a = v[3 * t], b = v[3 * t + 1], c = v[3 * t + 2];
        const std::array<Vec2, 3> face_uvs{uvs[a], uvs[b], uvs[c]};
        votes[t] = describeFace({positions[a], positions[b], positions[c]}, &face_uvs).orientation != 0;
    }
    return votes;
}

}  // namespace tspace
