// SPDX-License-Identifier: MIT
// Grouping and evaluation in one pass over the triangles, for the nodes where that can be done: one fan, one
// orientation, tangents that the angular test cannot separate. Those are nearly all nodes of nearly all
// meshes. The rest is for the vertex path (vertex_path.h), which gives the same bits for everything.
#pragma once

#include "core/scratch_block.h"
#include "tangents/mikktspace/vertex_path.h"

namespace tspace::mikk {

/// Writes tangents of the mesh's own pose, but for an angular threshold. `transient`: for what is not needed any more when
/// tangents are written: their own memory, unless somebody looks at it. `range_shift`: log2 of the nodes of a range; 0: what
/// suits the mesh. Throws OutOfMemory.
TangentReport evaluateInOnePass(const NodeSetting& setting, const TangentOutput& out, ScratchBlock& transient,
                                Parallel& parallel, unsigned range_shift = 0);

}  // namespace tspace::mikk
