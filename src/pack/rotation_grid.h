// SPDX-License-Identifier: MIT
// The lattice of frame32.
#pragma once

#include <cstdint>

namespace tspace::pack {

// Steps along x and z (turns about T and N) run from -kSide to kSide; kRows along y (turns about B, which move N and T
// both, so that these steps are the finer ones). Columns whose x + z is odd are shifted by half a step. 24 charts of
// kColumns * kRows * kColumns codes: all but 176,672 of 2^31.
inline constexpr std::int32_t kSide = 226, kColumns = 2 * kSide + 1, kRows = 436, kCharts = 24;
inline constexpr std::uint32_t kCodes = static_cast<std::uint32_t>(kCharts) * kColumns * kRows * kColumns;
static_assert(kCodes < 0x80000000u);

// p = u (kLinear + kCubic u^2): at the faces of the cube tan(22.5 degrees), and there 1.13 as steep as a straight line,
// in the middle 0.935, since rotations lie closer together far from the middle of a chart.
inline constexpr double kHalfEdge = 0.41421356237309503;
inline constexpr double kWarp = 0.065;
inline constexpr double kLinear = kHalfEdge * (1 - kWarp), kCubic = kHalfEdge * kWarp;

}  // namespace tspace::pack
