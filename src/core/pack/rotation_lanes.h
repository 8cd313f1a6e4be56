// SPDX-License-Identifier: MIT
// What a code of frame32 means. A rotation is one of the 24 that turn axes into axes, after a small one. The small one is
// given by its Rodrigues vector p (axis times the tangent of half the angle), which lies in the cube
// |p_i| <= tan(22.5 degrees) for at least one of the 24. Each p_i is a warped lattice coordinate. docs/pack.md says why
// its error is bounded. Included as frame_lanes.h.
#pragma once

#include "core/pack/frame_lanes.h"

namespace tspace::pack::TSPACE_LANES {

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

inline Floats warped(Floats u) {
    return u * (broadcast(static_cast<float>(kLinear)) + broadcast(static_cast<float>(kCubic)) * (u * u));
}
/// p of a column x or z, and of a row: twice y, and 1 more in columns that are shifted.
inline Floats atColumn(Floats x) { return warped((x - broadcast(kSide)) * broadcast(1.0f / kSide)); }
inline Floats atRow(Floats twice_y) { return warped((twice_y - broadcast(kRows)) * broadcast(1.0f / (kRows - 1))); }

/// The rows of the small rotation in the order and with the signs of chart g = 4 * order + signs: first three turns of x,
/// y, z, then the three swaps, which are turns of x, z, y. Two signs are free, the third keeps the determinant +1.
struct Charts {
    Mask is_swap, is_turned_once, is_turned_twice;
    Bits signs[3];

    explicit Charts(Bits g) {
        const Floats order = toFloats(shiftRight<2>(g));
        is_swap = order > broadcast(2.5f);
        const Floats turns = order - select(is_swap, broadcast(3.0f), zero());
        is_turned_once = turns == broadcast(1.0f);
        is_turned_twice = turns == broadcast(2.0f);
        signs[0] = signFrom<0>(g);
        signs[1] = signFrom<1>(g);
        signs[2] = signs[0] ^ signs[1] ^ orWhere(broadcastBits(0), is_swap, 0x80000000u);
    }
    [[nodiscard]] Vectors apply(Vectors v) const {
        const Floats y = select(is_swap, v.z, v.y), z = select(is_swap, v.y, v.z);
        const auto turned = [&](Floats none, Floats once, Floats twice) {
            return select(is_turned_twice, twice, select(is_turned_once, once, none));
        };
        return {flipped(turned(v.x, y, z), signs[0]), flipped(turned(y, z, v.x), signs[1]),
                flipped(turned(z, v.x, y), signs[2])};
    }
};

inline Frames rotationFrames(const Charts& charts, Floats x, Floats twice_y, Floats z) {
    const Frames small = framesOf(atColumn(x), atRow(twice_y), atColumn(z), broadcast(1.0f));
    return {charts.apply(small.normal), charts.apply(small.tangent)};
}

}  // namespace tspace::pack::TSPACE_LANES
