// SPDX-License-Identifier: MIT
// Seams in the shading between primitives of one mesh.
#pragma once

#include <vector>

#include "model/scene/scene.h"
#include "tspace/check.h"

namespace tspace {

/// Notes on pairs of primitives of a mesh that are one smooth surface, but whose normals differ at their border because each
/// has those of its own triangles alone. A note stands only where the border cannot be an intended hard edge: its bend is no
/// larger than what both sides smooth over elsewhere, and smaller than any edge that they have hard.
std::vector<Finding> checkSeams(const Scene& scene, const CheckOptions& options);

}  // namespace tspace
