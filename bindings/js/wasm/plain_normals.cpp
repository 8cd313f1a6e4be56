// SPDX-License-Identifier: MIT
// What the module of the entry "tspace" has in the place of denoise and crease_auto, which that of "tspace/normals" has: 16 KB
// less. The calls of JavaScript refuse these options before they come here.
#include "core/normals/denoise.h"
#include "core/normals/normals_call.h"

namespace tspace {

NormalReport denoisedNormals(NormalsCall& call) { return averageNormals(call); }

Creases findCreases(const MeshView&, const NormalOptions&, const Execution&, Parallel&) { return {}; }

PositionNoise noiseOf(const MeshView&, const Execution&, Parallel&, double) { return {}; }
PositionNoise withoutGrowth(PositionNoise noise) { return noise; }
bool mayHaveNoise(const MeshView&, double, const Execution&, Parallel&) { return false; }

}  // namespace tspace
