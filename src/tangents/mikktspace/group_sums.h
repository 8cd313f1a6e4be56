// SPDX-License-Identifier: MIT
// The sums of a plan's groups for one pose.
#pragma once

#include "core/parallel.h"
#include "tangents/mikktspace/corner_terms.h"
#include "tangents/mikktspace/evaluation_plan.h"

namespace tspace::mikk {

struct alignas(16) GroupSum {
    float s[4] = {0, 0, 0, 0};  ///< sum of weighted tangents, and of weights
};

/// The rest, when more than tangents is asked for.
struct alignas(32) GroupRest {
    float t[4] = {0, 0, 0, 0};  ///< of weighted bitangents, and of weighted |dP/du|
    float length_t = 0;         ///< of weighted |dP/dv|
};

struct GroupSums {
    Buffer<GroupSum> groups;
    Buffer<GroupRest> rest;  ///< empty when tangents_only
};

/// Adds up in the order of triangles. Throws OutOfMemory.
GroupSums sumGroups(const EvaluationPlan& plan, const CornerSource& source, CornerTermsFunction terms,
                    const Allocator* allocator, Parallel& parallel);

}  // namespace tspace::mikk
