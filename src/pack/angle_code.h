// SPDX-License-Identifier: MIT
// The codes of oct32, frame48 and frame64: N on a warped octahedron, and the angle of T about N. No trigonometry; the
// octahedron's fold and the basis come from integers, so that every decoder takes the same side.
// Based on: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 3(2), 2014 (the
// octahedron); Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017. The warps are of tspace.
#pragma once

#include <cstdint>

#include "pack/frame_code.h"

namespace tspace::pack {

/// The grid is 2 * half + 1 wide, both ways; a quarter turn has `quarter` steps (a power of two).
struct AngleGrid {
    std::int32_t half, quarter;
};

/// i and j in [0, 2 * half], k in [0, 4 * quarter).
struct AngleCode {
    std::int32_t i = 0, j = 0, k = 0;
};

AngleCode encodeAngle(const AngleGrid& grid, const SoundFrame& frame);
/// The sign is not part of it.
DecodedFrame decodeAngle(const AngleGrid& grid, const AngleCode& code);

}  // namespace tspace::pack
