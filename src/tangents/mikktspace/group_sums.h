// SPDX-License-Identifier: MIT
// The sums of a plan's groups for one pose.
#pragma once

#include "core/parallel.h"
#include "tangents/estimators/group_estimates.h"
#include "tangents/mikktspace/results.h"

namespace tspace::mikk {

/// Three floats and no more: these are most of what evaluating holds.
struct GroupSum {
    float s[3] = {0, 0, 0};  ///< of weighted tangents
};

/// The rest, when more than tangents is asked for.
struct alignas(32) GroupRest {
    float t[4] = {0, 0, 0, 0};  ///< of weighted bitangents, and of weighted |dP/du|
    float length_t = 0;         ///< of weighted |dP/dv|
    float weight = 0;
};

struct GroupSums {
    Buffer<GroupSum> groups;
    Buffer<GroupRest> rest;  ///< empty when tangents_only
};

/// Whether results for one corner are merged or kept depends on all their parts.
inline bool wantsOnlyTangents(const EvaluationPlan& plan, const TangentOutput& out) {
    return wantsTangentsOnly(out) && !plan.has_repeats;
}

/// Room for what the estimators give, and how they reach it.
GroupSums estimatedSums(const EvaluationPlan& plan, bool tangents_only, const Allocator* allocator);
estimators::GroupEstimates estimatesIn(GroupSums& sums);

/// Adds up in the order of triangles. Throws OutOfMemory.
GroupSums sumGroups(const EvaluationPlan& plan, const CornerSource& source, CornerTermsFunction terms,
                    const Allocator* allocator, Parallel& parallel);

}  // namespace tspace::mikk
