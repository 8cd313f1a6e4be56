// SPDX-License-Identifier: MIT
// Groups in which each member has a subset of its own (angular threshold).
#pragma once

#include "core/parallel.h"
#include "tangents/mikktspace/corner_terms.h"
#include "tangents/mikktspace/results.h"

namespace tspace::mikk {

/// Writes the results of all members but those whose corner has several. Those are returned, one per member,
/// when the plan has conflicts. Quadratic in the size of a group, which is limited when plans are made.
/// Throws OutOfMemory.
Buffer<Tangents> evaluateSplits(const EvaluationPlan& plan, const CornerSource& source, CornerTermsFunction terms,
                                const Sink& sink, const Allocator* allocator, Parallel& parallel);

}  // namespace tspace::mikk
