// SPDX-License-Identifier: MIT
// Step 5: whether the defect of the reference's edge list (see tail_order.h) can change anything. Nearly
// always it cannot, and this is known without any list of edges or of corners.
#pragma once

#include "core/memory.h"
#include "core/parallel.h"
#include "tangents/mikktspace/faces.h"
#include "tangents/mikktspace/weld.h"

namespace tspace::mikk {

/// False when the order of the last bucket cannot change a link: it has at most two half-edges, or no edge in
/// both directions. True otherwise, and always for nodes that are not tame. Takes about a byte per vertex,
/// six per node, and what the corners of a few cells of the reference's grid need; mostly reads all indices
/// once.
bool tailMayMatter(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes, const Allocator* allocator,
                   Parallel& parallel);

}  // namespace tspace::mikk
