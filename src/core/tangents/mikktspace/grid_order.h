// SPDX-License-Identifier: MIT
// The order of corners in the spatial search of the reference.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/tangents/mikktspace/welded_mesh.h"

namespace tspace::mikk {

// Representatives of nodes: the representative is the corner that the reference keeps when it welds a node. It depends
// on the order in which the reference's spatial search leaves corners. This code reproduces that order for the nodes
// for which it matters.

/// Sets representatives[node] to the corner that the reference keeps, for the nodes of `vertices`; kNone if a node has
/// no corners. Also sets, correctly, some other nodes in the same cells of the reference's grid (2048 along the longest
/// axis). Returns the triangles that have a corner in these cells, ascending, including all triangles at the nodes.
/// Requires finite nodes. Time: linear in the vertices and indices, plus the corners in these cells times the number of
/// partition levels, which the range of floats bounds.
Buffer<std::uint32_t> findRepresentatives(const WeldedMesh& welded, std::span<const std::uint32_t> vertices,
                                          std::uint32_t* representatives, const Allocator* allocator,
                                          Parallel& parallel);

}  // namespace tspace::mikk
