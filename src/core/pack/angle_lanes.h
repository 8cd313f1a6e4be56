// SPDX-License-Identifier: MIT
// N on a warped octahedron, and T by its angle about N: what a code of oct32, frame48 or frame64 means. No
// trigonometry; the octahedron's fold and the basis come from whole numbers, so that every decoder takes the same side.
// Whole numbers are floats here: none is above 2^23. Included as frame_lanes.h.
// Based on: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 3(2), 2014 (the
// octahedron); Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017. The warps are of tspace.
#pragma once

#include "core/pack/frame_lanes.h"

namespace tspace::pack::TSPACE_LANES {

/// The grid of N is 2 * half + 1 wide, both ways; a quarter turn of T has `quarter` steps (a power of two).
struct AngleGrid {
    std::int32_t half, quarter;
};

inline constexpr AngleGrid kOct32Grid{511, 512}, kFrame48Grid{23169, 16384}, kFrame64Grid{1048575, 524288};

// Barycentric coordinates b on a face of the octahedron are spread as b (2.5 - b), which makes its cells more equal: at
// the same grid the worst N falls from 0.159 to 0.134 degrees. x (2.75 - x) does so for the angle along the side of a
// diamond, whose speed then varies by less than 1 %.
inline constexpr double kFaceWarp = 2.5, kAngleWarp = 2.75;

/// N of a grid point, and the sign of its z as the whole numbers have it.
struct GridNormals {
    Vectors normal;
    Floats z_sign;
};

inline GridNormals gridNormals(const AngleGrid& grid, Floats i, Floats j) {
    const Floats half = broadcast(static_cast<float>(grid.half));
    const Floats whole = broadcast(static_cast<float>(kFaceWarp) * static_cast<float>(grid.half));
    const Floats from_i = absolute(i - half), from_j = absolute(j - half), rest = half - from_i - from_j;
    const Floats fold = smaller(rest, zero());  // the lower half is folded over the edges of the diamond
    const Floats a = from_i + fold, b = from_j + fold, c = absolute(rest);
    const Floats x = a * (whole - a), y = b * (whole - b), z = c * (whole - c);
    const Floats z_sign = select(rest < zero(), broadcast(-1.0f), broadcast(1.0f));
    return {ofUnitLength({select(i < half, minus(x), x), select(j < half, minus(y), y), z_sign * z}), z_sign};
}

struct Bases {
    Vectors p, q;
};

inline Bases basesOf(const GridNormals& g) {
    const Floats one = broadcast(1.0f), s = g.z_sign;
    const Vectors& n = g.normal;
    const Floats h = broadcast(-1.0f) / (s + n.z), d = n.x * n.y * h;
    return {{one + s * n.x * n.x * h, s * d, minus(s) * n.x}, {d, s + n.y * n.y * h, minus(n.y)}};
}

/// T after so many quarters of a turn, in the lowest two bits, and `step` of the steps of a quarter.
inline Vectors tangentsAt(const AngleGrid& grid, const Bases& basis, Bits quarters, Floats step) {
    const Floats whole = broadcast(static_cast<float>(kAngleWarp) * static_cast<float>(grid.quarter));
    const Floats x = step, y = broadcast(static_cast<float>(grid.quarter)) - step;
    const Floats run = y * (whole - y), rise = x * (whole - x);
    const Floats scale = broadcast(1.0f) / squareRoot(run * run + rise * rise);
    const Floats cosine = run * scale, sine = rise * scale;
    const Mask odd = isSet<0>(quarters);
    const Bits half_turn = signFrom<1>(quarters);
    return flipped(select(odd, minus(sine), cosine), half_turn) * basis.p +
           flipped(select(odd, cosine, sine), half_turn) * basis.q;
}

}  // namespace tspace::pack::TSPACE_LANES
