// SPDX-License-Identifier: MIT
// Step 4: the tricorners of each node, ascending.
#pragma once

#include "tangents/mikktspace/grouped_plan.h"

namespace tspace::mikk {

/// Fills plan.node_begin and plan.list from plan.nodes.
void listCorners(GroupedPlan& plan, const Allocator* allocator);

}  // namespace tspace::mikk
