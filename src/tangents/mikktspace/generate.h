// SPDX-License-Identifier: MIT
// Tangents of a mesh in its own pose, in one call.
#pragma once

#include "tangents/mikktspace/grouped_plan.h"

namespace tspace::mikk {

/// Plan and evaluation of a validated mesh into checked outputs, by the faster of two ways: in one pass
/// (one_pass.h) where the mesh allows it, else by the general steps (planGrouped, evaluateGroups). Same bits
/// either way. Throws OutOfMemory.
TangentReport generateGrouped(const MeshView& mesh, const TangentOptions& options, const TangentOutput& out,
                              Parallel& parallel);

}  // namespace tspace::mikk
