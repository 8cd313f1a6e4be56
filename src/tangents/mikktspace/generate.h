// SPDX-License-Identifier: MIT
// Tangents of a mesh in its own pose, in one call.
#pragma once

#include "core/parallel.h"
#include "tspace/tangents.h"

namespace tspace::mikk {

/// The bits of planGrouped and evaluateGroups, for a validated mesh and into checked outputs. Throws OutOfMemory.
TangentReport generateGrouped(const MeshView& mesh, const TangentOptions& options, const TangentOutput& out,
                              Parallel& parallel);

}  // namespace tspace::mikk
