// SPDX-License-Identifier: MIT
// NormalOptions::denoise: what noise there is, and normals without it.
#pragma once

#include "core/normals/normal_groups.h"
#include "tspace/position_noise.h"

namespace tspace {

/// By some thousand edges and the normals of `best` at their ends, which call.out has. mean_edge is 0 where no edge has a
/// finite length; a call without results gives that alone. Takes 64 KB.
PositionNoise sampleEdges(const NormalsCall& call);

/// Whether edges alone show that nothing is noise.
bool areClean(const PositionNoise& sampled);

/// Adds sigma, and what of it is noise. Returns the most noise that edges as flat as these may have. groups: in units of the
/// mean edge
double measureNoise(const NormalGroups& groups, const Allocator* allocator, PositionNoise& noise);

/// The same of a call without normals: of the mesh, which its hard edges will be found on.
double roughnessOf(const NormalsCall& call);

/// Of a mesh, without hard edges. `wants_sigma`: also where edges alone show that nothing is noise.
PositionNoise noiseOf(const MeshView& mesh, const Execution& execution, Parallel& parallel, bool wants_sigma);

/// averageNormals by `best`, then without noise. That of the mesh: in a pose it is no other, so that what does not move near
/// a point leaves its normal alone. Takes normal_groups.h and 76 bytes per group. Throws OutOfMemory.
NormalReport denoisedNormals(NormalsCall& call);

}  // namespace tspace
