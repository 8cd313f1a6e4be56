// SPDX-License-Identifier: MIT
// Whether one pass over a mesh is worth it.
#pragma once

#include "tangents/mikktspace/faces.h"

namespace tspace::mikk {

/// Judges by a sample of triangles whether one pass would leave so many nodes complex that it is faster to look at each
/// node alone at once. Both ways give the same bits.
bool mostNodesSeemComplex(const MeshView& mesh, const TriangleList& triangles);

}  // namespace tspace::mikk
