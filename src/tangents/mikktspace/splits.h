// SPDX-License-Identifier: MIT
// Step 8: splits. Inside a group only members whose tangents and bitangents differ by less than the angular
// threshold are averaged; each member has a subset of the group of its own.
#pragma once

#include "tangents/mikktspace/grouped_plan.h"

namespace tspace::mikk {

/// Cosine of an angular threshold in degrees, in the reference's arithmetic.
float thresholdCosine(float degrees);

/// Finds the groups that split on this pose and fills the plan's split_* members. Groups of more than
/// kLargestSplitGroup members that might split stay whole and set report.reference_order_abandoned.
/// `faces` has one face per triangle, or is empty when triangle t is face t.
void findSplits(GroupedPlan& plan, float threshold_cosine, const Pose& pose, const PoseData& data,
                const Buffer<std::uint32_t>& faces, const Allocator* allocator, Parallel& parallel);

/// Subsets are quadratic in the size of a group by definition: every member may have another one, and float
/// sums cannot be shared. Above this size, groups that might split would take quadratic time here too.
inline constexpr std::uint32_t kLargestSplitGroup = 4096;

}  // namespace tspace::mikk
