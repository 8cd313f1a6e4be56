// SPDX-License-Identifier: MIT
// Grouping and evaluation in one pass over the triangles, for the nodes where that can be done: one fan, one
// orientation, tangents that the angular test cannot separate. Those are nearly all nodes of nearly all
// meshes. The rest goes, with the triangles around it, through the general steps (plan.h), which give the
// same bits for everything.
#pragma once

#include <optional>

#include "core/scratch_block.h"
#include "tangents/mikktspace/faces.h"
#include "tangents/mikktspace/grouped_plan.h"
#include "tangents/mikktspace/weld.h"

namespace tspace::mikk {

/// What to begin with: the pass, or, where it would leave most nodes unclear, a look at each node alone. Both give
/// the same bits, and tests ask for both.
enum class FirstLook { asItSeems, onePass, eachNode };

/// Writes tangents of the mesh's own pose. Returns nothing, and leaves the outputs undefined, when the
/// general steps are the better way for all of it: most nodes need them. `nodes` must be tame, the threshold
/// 180 degrees, and the order of the reference's last edge bucket without effect (tail_check.h) or not asked
/// for. `brief`: for what is not needed any more when tangents are written: their own memory, unless somebody
/// looks at it. Throws OutOfMemory.
std::optional<TangentReport> evaluateInOnePass(const MeshView& mesh, const TangentOptions& options,
                                               const TriangleList& triangles, const Nodes& nodes,
                                               const TangentOutput& out, ScratchBlock& brief, Parallel& parallel,
                                               FirstLook first_look = FirstLook::asItSeems);

}  // namespace tspace::mikk
