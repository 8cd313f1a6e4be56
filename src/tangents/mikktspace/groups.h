// SPDX-License-Identifier: MIT
// Step 7: groups, the sets of tricorners at one node that share tangents.
#pragma once

#include "tangents/mikktspace/grouped_plan.h"
#include "tangents/mikktspace/tail_order.h"

namespace tspace::mikk {

/// Reorders plan.list so that groups are contiguous and marked, settles the orientation of kAny triangles,
/// and counts groups in the report.
void formGroups(GroupedPlan& plan, const TailPairs& tail, const Allocator* allocator, Parallel& parallel);

}  // namespace tspace::mikk
