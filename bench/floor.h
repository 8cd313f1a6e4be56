// SPDX-License-Identifier: MIT
// Lower bound for any tangent generator: the time to move its data.
#pragma once

#include "mesh.h"

namespace tspace::bench {

/// Reads all inputs once and writes 16 bytes for each entry of `out` once: one per vertex or one per corner.
void memoryFloor(const Mesh& mesh, std::vector<Vec4>& out);

}  // namespace tspace::bench
