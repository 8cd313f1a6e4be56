// SPDX-License-Identifier: MIT
// Vertices with equal position and normal, or position, normal and UV.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/unique_index.h"
#include "core/mesh/surface/tangent_view.h"
#include "tspace/span.h"

namespace tspace {

/// A key of UniqueIndex: positions that are equal, both zeros being one value, have one key.
inline std::array<std::uint32_t, 3> positionKey(const Vec3& p) { return {weldBits(p.x), weldBits(p.y), weldBits(p.z)}; }

struct EqualVertices {
    std::vector<std::uint32_t> class_of = {};  ///< one per vertex
    std::size_t class_count = 0;               ///< numbered in order of their first vertices
};

/// One entry per vertex in each; `uvs` may be empty. Bits decide, but both zeros are one value. Expected linear time.
EqualVertices findEqualVertices(const StridedSpan<const Vec3>& positions, const StridedSpan<const Vec3>& normals,
                                const StridedSpan<const Vec2>& uvs);
EqualVertices findEqualVertices(const TangentView& mesh, bool with_uvs);

}  // namespace tspace
