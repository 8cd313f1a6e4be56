// SPDX-License-Identifier: MIT
// Conversions between the options and reports of generate and those of computeFrames, and names of actions.
#pragma once

#include "core/mesh/pools/primitive.h"
#include "tspace/generate.h"

namespace tspace {

/// Returns the options of computeFrames, without `execution` and `progress`, which differ between calls.
FramesOptions framesOptions(const GenerateOptions& options);

/// Copies all results that computeFrames reports.
void copyReport(const FramesReport& computed, PrimitiveReport& report);

/// Copies only the counts that are valid for kept tangents: signs that morph targets flip, and faults of the triangles.
void copyReportOfKept(const FramesReport& computed, PrimitiveReport& report);

}  // namespace tspace
