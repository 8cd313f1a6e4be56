// SPDX-License-Identifier: MIT
// Offsets that morph targets should add to normals that stay.
#pragma once

#include <span>
#include <vector>

#include "core/mesh/pools/primitive.h"
#include "core/mesh/surface/surface_turn.h"

namespace tspace {

class TurnedNormals {
  public:
    /// The pool has normals.
    TurnedNormals(const PoolView& pool, std::span<const PrimitiveGeometry> primitives);

    /// Per vertex the offset that turns its normal as the surface around it turns, when a target adds `positions` (one
    /// per vertex, or none). Zero where nothing turns, and where triangles vanish.
    [[nodiscard]] std::vector<Vec3> offsets(std::span<const Vec3> positions) const;

  private:
    std::vector<Vec3> positions_ = {}, normals_ = {};
    std::vector<std::uint32_t> corners_ = {};
};

/// The vertices whose offset is not zero.
VertexOffsets sparse(std::span<const Vec3> offsets);

}  // namespace tspace
