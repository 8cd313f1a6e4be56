// SPDX-License-Identifier: MIT
// Access to the parts of a plan, for planBuffers.
#pragma once

#include "core/tangents/indexed_methods.h"
#include "core/tangents/mikktspace/evaluate.h"

namespace tspace {

struct PlanParts {
    const mikk::EvaluationPlan* grouped = nullptr;  ///< plan of a method with groups; null for lengyel, flat and basis
    const IndexedPlan* indexed = nullptr;           ///< plan of lengyel, flat or basis; null for all other methods
    bool is_symmetric = false, normalizes_normals = false;
    /// true: the plan has its own vertex numbering (its mesh has several index lists), which differs from that of a
    /// pose
    bool has_own_lists = false;
};

PlanParts partsOf(const TangentPlan& plan);

}  // namespace tspace
