// SPDX-License-Identifier: MIT
// Baseline to which all times are compared.
#pragma once

#include "mesh.h"

namespace tspace::bench {

/// Computes tangents of an indexed triangle mesh as in textbooks: one per vertex, with scalar code and one thread.
/// Based on: Lengyel, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh", 2001.
/// `tangents` has one entry per vertex.
void plainLoop(const Mesh& mesh, std::vector<Vec4>& tangents);

}  // namespace tspace::bench
