// SPDX-License-Identifier: MIT
// Lower bound of the time of any tangent generator: the time to read its inputs and write its outputs.
#pragma once

#include "mesh.h"

namespace tspace::bench {

/// Reads all inputs once, and writes each entry of `out` (16 bytes) once. `out` has one entry per vertex or one per
/// corner.
void memoryFloor(const Mesh& mesh, std::vector<Vec4>& out);

}  // namespace tspace::bench
