// SPDX-License-Identifier: MIT
// Solves the texels of a baked map from ray samples, in strips of rows: the system of a whole map of 8192 x 8192 texels
// would need 14 GB.
#pragma once

#include "maps/bake/texel_plan.h"
#include "maps/bake/trace_texels.h"

namespace tspace {

/// Number of rows of a strip (even), and number of adjacent rows that are solved together with it and discarded.
inline constexpr std::uint32_t kStripRows = 512, kRowsAround = 8;

/// Sets traced.wanted to the texels whose filtered map is closest to the ray samples: for 8 bits, vectors that integers
/// represent; otherwise vectors that are not rounded yet. On input, traced.wanted contains the target vectors at texel
/// centers, which must be nonzero wherever a filter reads. Memory: 14 bytes per texel, and 216 bytes per texel of a
/// strip and the rows around it.
void solveInStrips(const MapSurfaces& surfaces, const TexelPlan& plan, std::uint32_t points, const BakeOptions& options,
                   const MapWork& work, TracedTexels& traced, std::uint32_t strip_rows = kStripRows);

}  // namespace tspace
