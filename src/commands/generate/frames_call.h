// SPDX-License-Identifier: MIT
// What generate passes to computeFrames, and takes from its reports; the names of what was done.
#pragma once

#include "core/mesh/pools/primitive.h"
#include "tspace/generate.h"

namespace tspace {

/// The options that computing frames needs, without `execution` and `progress`, which differ from call to call.
FramesOptions framesOptions(const GenerateOptions& options);

/// Copies everything that computeFrames reports.
void copyReport(const FramesReport& computed, PrimitiveReport& report);

/// Copies the counts that hold for tangents that stay: signs that targets flip, and faults of the triangles.
void copyReportOfKept(const FramesReport& computed, PrimitiveReport& report);

}  // namespace tspace
