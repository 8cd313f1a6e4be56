// SPDX-License-Identifier: MIT
// Noise of positions that is large enough to be reported.
#pragma once

#include <cstdint>

#include "tspace/mesh.h"
#include "tspace/normals.h"

namespace tspace {

/// Returns PositionNoise::noise if it is visible in normals and certain; otherwise, or if it cannot be measured,
/// returns 0. Noise of 0.03 edge lengths rotates normals by one degree, and a few hundred vertices are necessary to
/// detect it. Of 1,005 primitives in 162 models, one has such noise; it was added on purpose. `position_step`:
/// quantization step of positions stored as integers; rounding to it is not noise.
double reportableNoise(const MeshView& mesh, double position_step, float weld_distance = NormalOptions::weld_auto);

/// Returns an upper estimate of the temporary memory of reportableNoise.
std::uint64_t reportableNoiseMemory(const MeshView& mesh);

}  // namespace tspace
