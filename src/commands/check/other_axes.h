// SPDX-License-Identifier: MIT
// Tangents that are wrong because they were not turned along with their mesh, as from Z up to Y up.
#pragma once

#include <string>

#include "commands/check/primitive_checks.h"

namespace tspace {

/// The axes in which the tangents fit nearly everywhere, where they lie in the surface nearly nowhere as they are:
/// "x, z, -y" of what is stored. Empty: there are none. Each of the 47 ways to exchange and negate axes is tried.
std::string findOtherAxes(const PrimitiveFacts& facts, const FrameHealth& health);

}  // namespace tspace
