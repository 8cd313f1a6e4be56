// SPDX-License-Identifier: MIT
// Replaces denoise and crease_auto in the module of the entry "tspace", which saves 16 KB; the module of
// "tspace/normals" contains them. The JavaScript functions reject these options before the call.
#include "core/estimate/creases.h"
#include "core/estimate/denoise.h"
#include "core/normals/normals_call.h"

namespace tspace {

NormalReport denoisedNormals(NormalsCall& call) { return averageNormals(call); }

Creases findCreases(const MeshView&, const NormalOptions&, const Execution&, Parallel&) { return {}; }

PositionNoise noiseOf(const MeshView&, const Execution&, Parallel&, double) { return {}; }
PositionNoise withoutGrowth(PositionNoise noise) { return noise; }
bool mayHaveNoise(const MeshView&, double, const Execution&, Parallel&) { return false; }

}  // namespace tspace
