// SPDX-License-Identifier: MIT
// Which corner of a node the reference keeps as its representative. It depends on the order in which the
// reference's spatial search happens to leave corners, so that order is reproduced where somebody needs to
// know.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/tangents/mikktspace/weld.h"

namespace tspace::mikk {

/// Sets representatives[node] to the corner that the reference keeps, for the nodes of some vertices; kNone where a node has
/// no corners. Others in the same cells (of 2048) may be set too, and then are right. Returns the triangles that have a
/// corner in these cells, ascending: those at the nodes are among them. Nodes must be all finite. Linear in the vertices
/// and indices, and in the corners of these cells times the halvings of a float interval.
Buffer<std::uint32_t> findRepresentatives(const WeldedMesh& welded, std::span<const std::uint32_t> vertices,
                                          std::uint32_t* representatives, const Allocator* allocator,
                                          Parallel& parallel);

}  // namespace tspace::mikk
