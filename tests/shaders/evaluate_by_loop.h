// SPDX-License-Identifier: MIT
// shaders/tspace_evaluate.metal as a C++ function: a simple loop over the results of a plan.
#pragma once

#include <string>

#include "evaluate_cases.h"

namespace tspace::shaders {

std::string evaluateByLoop(EvaluateBuffers& in);

}  // namespace tspace::shaders
