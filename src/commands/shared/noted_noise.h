// SPDX-License-Identifier: MIT
// Which noise of positions is worth a word.
#pragma once

#include <cstdint>

#include "tspace/mesh.h"
#include "tspace/normals.h"

namespace tspace {

/// PositionNoise::noise, where somebody will see it in normals and where it is sure: .03 edges turn normals by a degree, and
/// it takes some hundred vertices to tell. Else 0, as where it cannot be measured. Of the 1,005 primitives of 162 models one
/// has more: it is damaged on purpose.
/// position_step: of positions that are stored as whole numbers; rounding to them is no noise
double notedNoise(const MeshView& mesh, double position_step, float weld_distance = NormalOptions::weld_auto);

/// The memory that notedNoise takes for a while: that of measurePositionNoise, rounded up.
std::uint64_t noteMemory(const MeshView& mesh);

}  // namespace tspace
