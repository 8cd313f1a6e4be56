// SPDX-License-Identifier: MIT
// The last planning step: who writes which corner of the mesh.
#pragma once

#include "tangents/mikktspace/grouped_plan.h"
#include "tangents/mikktspace/triangle_pass.h"

namespace tspace::mikk {

/// Fills the plan's conflicts, default_corners and copies. A copy from kNone takes the default.
void planSlotWrites(GroupedPlan& plan, TrianglePass& pass, const Allocator* allocator);

}  // namespace tspace::mikk
