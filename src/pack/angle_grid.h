// SPDX-License-Identifier: MIT
// The grids of oct32, frame48 and frame64.
#pragma once

#include <cstdint>

namespace tspace::pack {

/// The grid of N is 2 * half + 1 wide, both ways; a quarter turn of T has `quarter` steps (a power of two).
struct AngleGrid {
    std::int32_t half, quarter;
};

inline constexpr AngleGrid kOct32Grid{511, 512}, kFrame48Grid{23169, 16384}, kFrame64Grid{1048575, 524288};

// Barycentric coordinates b on a face of the octahedron are spread as b (2.5 - b), which makes its cells more equal: at
// the same grid the worst N falls from 0.159 to 0.134 degrees. x (2.75 - x) does so for the angle along the side of a
// diamond, whose speed then varies by less than 1 %.
inline constexpr double kFaceWarp = 2.5, kAngleWarp = 2.75;

}  // namespace tspace::pack
