// SPDX-License-Identifier: MIT
// Measures all combinations of meshes, jobs, thread counts and SIMD targets, without targets for their times.
#pragma once

#include <string>

#include "rows.h"

namespace tspace::bench {

/// Runs Google Benchmark over every mesh, job, thread count and SIMD target whose name MESH/JOB/threads:N/TARGET
/// matches the regular expression. `json`: as in TableOptions. Returns 1 if nothing matches.
int runSweep(Lab& lab, const std::string& pattern, const std::string& json);

}  // namespace tspace::bench
