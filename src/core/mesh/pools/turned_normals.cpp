// SPDX-License-Identifier: MIT
// Base normals that an artist has chosen (of bevels, of foliage) turn with the surface; they are not computed from it.
#include "core/mesh/pools/turned_normals.h"

#include "core/base/unit.h"
#include "core/mesh/pools/morph_frames.h"

namespace tspace {

TurnedNormals::TurnedNormals(const PoolView& pool, std::span<const PrimitiveGeometry> primitives) {
    for (std::size_t v = 0; v < pool.positions.count; ++v) {
        positions_.push_back(pool.positions[v]);
        normals_.push_back(pool.normals[v]);
    }
    for (const PrimitiveGeometry& primitive : primitives)
        corners_.insert(corners_.end(), primitive.indices.begin(), primitive.indices.end());
}

std::vector<Vec3> TurnedNormals::offsets(std::span<const Vec3> positions) const {
    std::vector<Vec3> result(positions_.size());
    if (positions.empty()) return result;
    const std::vector<VertexTurn> turns = SurfaceTurns(positions_, normals_, corners_).under(positions);
    for (std::size_t v = 0; v < result.size(); ++v) {
        if (turns[v].isKnown()) result[v] = offsetBetween(normals_[v], turns[v].apply(normals_[v]));
    }
    return result;
}

VertexOffsets sparse(std::span<const Vec3> offsets) {
    VertexOffsets result;
    for (std::size_t v = 0; v < offsets.size(); ++v) {
        if (isZero(offsets[v])) continue;
        result.vertices.push_back(static_cast<std::uint32_t>(v));
        result.offsets.push_back(offsets[v]);
    }
    return result;
}

}  // namespace tspace
