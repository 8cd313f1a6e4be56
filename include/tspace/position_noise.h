// SPDX-License-Identifier: MIT
// How noisy the positions of a mesh are.
#pragma once

#include "tspace/execution.h"
#include "tspace/mesh.h"
#include "tspace/result.h"

namespace tspace {

/// Lengths are parts of `mean_edge`.
struct PositionNoise {
    /// How far positions lie from a smooth surface through their neighbours: the standard deviation along the normal. Detail
    /// as small as a triangle is in it too. 0: less than 200 vertices have enough neighbours to tell.
    float sigma = 0;
    /// Of how normals differ along an edge, the part that no smooth surface has: the median, 0..1. Noise gives .3 to .8; CAD,
    /// bevels and what was decimated give less for their sigma.
    float kink_share = 0;
    /// What of `sigma` is noise: so much NormalOptions::denoise removes where it goes by the mesh. 0: positions are not
    /// noisy. That is so, too, where most edges are flatter than noise would leave them.
    float noise = 0;
    double mean_edge = 0;  ///< of a sample, in the unit of positions, less what noise of sigma adds to it
};

/// Measures the noise in the positions of a mesh, by samples: up to 4096 vertices and 16384 edges. sigma is within 15 % of
/// random noise from .03 to .3 on smooth shapes; noise that is smooth from vertex to vertex cannot be told from detail.
///
/// mesh       positions and indices; UVs and normals are not looked at. Vertices at one position are one
/// execution  threads and memory; changes no bit
/// Errors: those of validate(); outOfMemory.
/// O(corners): the time of NormalWeighting::best and half as much again. Scratch memory: that of `best`, then 28 bytes per
/// corner, 56 per vertex, and 4 per vertex and thread. Thread-safe; same bits for any thread count.
Result<PositionNoise> measurePositionNoise(const MeshView& mesh, const Execution& execution = {});

}  // namespace tspace
