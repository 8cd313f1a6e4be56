// SPDX-License-Identifier: MIT
// What every time is compared with.
#pragma once

#include "mesh.h"

namespace tspace::bench {

/// Tangents of an indexed triangle mesh as textbooks write them: one per vertex index, scalar, one thread.
/// Based on: Lengyel, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh", 2001.
/// `tangents` has one entry per vertex.
void plainLoop(const Mesh& mesh, std::vector<Vec4>& tangents);

}  // namespace tspace::bench
