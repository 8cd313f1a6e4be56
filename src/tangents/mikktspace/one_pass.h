// SPDX-License-Identifier: MIT
// Grouping and evaluation in one pass over the triangles, for the nodes where that can be done: one fan, one
// orientation, tangents that the angular test cannot separate. Those are nearly all nodes of nearly all
// meshes. The rest is for the vertex path (vertex_path.h), which gives the same bits for everything.
#pragma once

#include "core/scratch_block.h"
#include "tangents/mikktspace/vertex_path.h"

namespace tspace::mikk {

/// What to begin with: the pass, or a look at each node alone. Both give the same bits, and tests ask for both.
enum class FirstLook { onePass, eachNode };

struct PassOptions {
    FirstLook first_look = FirstLook::onePass;
    unsigned range_shift = 0;  ///< log2 of the nodes of a range; 0: what suits the mesh
};

/// Writes tangents of the mesh's own pose. `transient`: for what is not needed any more when tangents are written: their own
/// memory, unless somebody looks at it. Throws OutOfMemory.
TangentReport evaluateInOnePass(const NodeSetting& setting, ScratchBlock& transient, Parallel& parallel,
                                const PassOptions& pass = {});

}  // namespace tspace::mikk
