// SPDX-License-Identifier: MIT
// The texels of a baked map from what rays say, some rows at a time: the system of a whole map of 8192 x 8192 texels would take
// 14 GB.
#pragma once

#include "maps/bake/texel_plan.h"
#include "maps/bake/trace_texels.h"

namespace tspace {

/// Rows of a strip, even, and of each those around that are solved with it.
inline constexpr std::uint32_t kStripRows = 512, kRowsAround = 8;

/// Sets traced.wanted to the texels of which the filtered map shows best what rays say: for 8 bits vectors that integers stand
/// for, and else vectors that are not rounded yet. traced.wanted: what is wanted at centres, none of them zero where a filter
/// reads. Memory: 14 bytes a texel, and 216 a texel of a strip with the rows around it.
void solveInStrips(const MapSurfaces& surfaces, const TexelPlan& plan, std::uint32_t points, const BakeOptions& options,
                   const MapWork& work, TracedTexels& traced, std::uint32_t strip_rows = kStripRows);

}  // namespace tspace
