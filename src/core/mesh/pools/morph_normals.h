// SPDX-License-Identifier: MIT
// Normals for a pool that has none, and for its morph targets.
#pragma once

#include <span>
#include <vector>

#include "core/mesh/pools/morph_targets.h"
#include "core/mesh/pools/primitive.h"

namespace tspace {

/// The pool after its normals: with them, and split where corners have different ones, on the base or in a target.
struct PoolWithNormals {
    VertexPool pool = {};  ///< its targets read those of the pool it was made from, which must outlive it
    std::vector<PrimitiveGeometry> primitives = {};   ///< the same corners
    std::vector<std::uint32_t> source_vertices = {};  ///< new vertex -> old vertex, identity first
    std::vector<VertexOffsets> offsets = {};  ///< one per target: what it adds to the normals of the new vertices
};

/// Normals by options.normals. Which edges are hard is the base's matter; what a target adds makes the normals of the
/// moved shape. Fills the normals of the reports. The result must stay where it is: its targets point into it.
Result<Done> generatePoolNormals(const PoolView& pool, std::span<const PrimitiveGeometry> primitives,
                                 const GenerateOptions& options, std::span<PrimitiveReport> reports,
                                 PoolWithNormals& result);

}  // namespace tspace
