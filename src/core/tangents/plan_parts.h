// SPDX-License-Identifier: MIT
// What planBuffers reads of a plan.
#pragma once

#include "core/tangents/indexed_methods.h"
#include "core/tangents/mikktspace/evaluate.h"

namespace tspace {

struct PlanParts {
    const mikk::EvaluationPlan* grouped = nullptr;  ///< null for lengyel, flat and basis
    const IndexedPlan* indexed = nullptr;           ///< null for all others
    bool is_symmetric = false, normalizes_normals = false;
    bool has_own_lists = false;  ///< vertices of the plan are not those of a pose
};

PlanParts partsOf(const TangentPlan& plan);

}  // namespace tspace
