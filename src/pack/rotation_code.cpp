// SPDX-License-Identifier: MIT
// The encoder of frame32.
#include "pack/rotation_code.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simd/lanes_scalar.h"
#define TSPACE_LANES scalar
#include "pack/rotation_lanes.h"
#undef TSPACE_LANES

namespace tspace::pack {

namespace {

// Row m of a chart's rotation is kRowOf[g >> 2][m] of the small one, times a sign: three turns of x, y, z, then the
// three swaps.
constexpr int kRowOf[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};

struct Signs {
    bool minus[3];
};

/// The signs of chart g: two are free, the third keeps the determinant +1.
Signs signsOf(std::uint32_t g) {
    const bool s0 = (g & 1) != 0, s1 = (g >> 1 & 1) != 0, is_swap = g >= 12;
    return {{s0, s1, (s0 != s1) != is_swap}};
}

struct Cell {
    std::int32_t x, y, z;
};

bool isShifted(std::int32_t x, std::int32_t z) { return ((x + z) & 1) != 0; }

std::uint32_t codeOf(std::uint32_t g, const Cell& cell) {
    const auto x = static_cast<std::uint32_t>(cell.x), y = static_cast<std::uint32_t>(cell.y);
    return ((g * kColumns + x) * kRows + y) * kColumns + static_cast<std::uint32_t>(cell.z);
}

double warped(double u) { return u * (kLinear + kCubic * u * u); }

/// The u whose p this is: after a first guess two steps of Newton's method end below 1e-9 in the cube.
double unwarped(double p) {
    const double straight = p / kHalfEdge;
    double u = straight * (1 + kWarp * (1 - straight * straight));
    for (int step = 0; step < 2; ++step) u -= (warped(u) - p) / (kLinear + 3 * kCubic * u * u);
    return u;
}

/// The code next below x of those from 0 to last, and never the last, so that there is one above.
std::int32_t codeBelow(double x, std::int32_t last) {
    return std::clamp(static_cast<std::int32_t>(std::floor(x)), 0, last - 1);
}

/// Below this, floats have rounded what is left: charts that meet share codes but for the last bits, and only decoding
/// says which of them the frame came from.
constexpr double kTwinError = 1e-11;

/// Of N and T, whichever is farther off.
double squaredDistance(std::uint32_t g, const Cell& cell, const SoundFrame& frame) {
    const auto twice_y = static_cast<float>(2 * cell.y + (isShifted(cell.x, cell.z) ? 1 : 0));
    const scalar::Frames found = scalar::rotationFrames(scalar::Charts({g}), {static_cast<float>(cell.x)}, {twice_y},
                                                        {static_cast<float>(cell.z)});
    const auto vector = [](const scalar::Vectors& v) { return Vec3{v.x.v, v.y.v, v.z.v}; };
    return std::max(pack::squaredDistance(vector(found.normal), frame.normal),
                    pack::squaredDistance(vector(found.tangent), frame.tangent));
}

/// The best code found so far.
struct Best {
    double error = std::numeric_limits<double>::infinity();
    std::uint32_t code = 0;
};

/// Tries the codes around p in chart g: of the four columns around it the rows below and above.
/// Between p and a code's p' lies the rotation with the Rodrigues vector (p' - p - p x p') / (1 + p.p'), in the axes of
/// the frame. What divides differs by less than 2 in 1000 between these codes, and is left out.
void searchAround(const DVec3& p, std::uint32_t g, const SoundFrame& frame, Best& best) {
    const std::int32_t x0 = codeBelow(unwarped(p.x) * kSide + kSide, kColumns - 1);
    const std::int32_t z0 = codeBelow(unwarped(p.z) * kSide + kSide, kColumns - 1);
    const double twice_row = unwarped(p.y) * (kRows - 1) + kRows;
    std::int32_t y0[2];  // in columns with an even and with an odd x + z
    double dx[2], dy[2][2], dz[2];
    for (const std::int32_t i : {0, 1}) {
        dx[i] = warped((x0 + i - kSide) * (1.0 / kSide)) - p.x;
        dz[i] = warped((z0 + i - kSide) * (1.0 / kSide)) - p.z;
        y0[i] = codeBelow((twice_row - i) / 2, kRows - 1);
        for (const std::int32_t up : {0, 1}) {
            dy[i][up] = warped((2 * (y0[i] + up) + i - kRows) * (1.0 / (kRows - 1))) - p.y;
        }
    }
    for (unsigned choice = 0; choice < 8; ++choice) {
        const unsigned right = choice & 1, back = choice >> 1 & 1, up = choice >> 2;
        const Cell column{x0 + static_cast<std::int32_t>(right), 0, z0 + static_cast<std::int32_t>(back)};
        const std::size_t odd = isShifted(column.x, column.z) ? 1 : 0;
        const DVec3 d{dx[right], dy[odd][up], dz[back]};
        double error = squaredReach(d - cross(p, d));
        if (error >= best.error && error >= kTwinError) continue;
        const Cell cell{column.x, y0[odd] + static_cast<std::int32_t>(up), column.z};
        if (error < kTwinError) error = squaredDistance(g, cell, frame);
        if (error >= best.error) continue;
        best.error = error;
        best.code = codeOf(g, cell);
    }
}

/// Half a step beyond the cube: there a code of its face may be the nearest.
constexpr double kReach = kHalfEdge * (1 + 0.6 / kSide);
/// Below the trace of all rotations within reach: it is 1.640 in the corners of the cube.
constexpr double kLeastTrace = 1.63;

}  // namespace

std::uint32_t encodeRotation(const SoundFrame& frame) {
    const DVec3 b = cross(frame.normal, frame.tangent);
    const double rotation[3][3] = {{frame.tangent.x, b.x, frame.normal.x},
                                   {frame.tangent.y, b.y, frame.normal.y},
                                   {frame.tangent.z, b.z, frame.normal.z}};
    // All charts that hold the rotation are searched, not just the one around the nearest of the 24: the corners of a
    // cube lie in other charts too, and each word must come back from what it decodes to.
    Best best;
    for (std::uint32_t g = 0; g < kCharts; ++g) {
        const int* row_of = kRowOf[g >> 2];
        if ((g & 3) == 0) {  // no signs can make more of this order of rows
            const double most = std::fabs(rotation[0][row_of[0]]) + std::fabs(rotation[1][row_of[1]]) +
                                std::fabs(rotation[2][row_of[2]]);
            if (most < kLeastTrace) {
                g += 3;
                continue;
            }
        }
        const Signs signs = signsOf(g);
        double trace = 0;
        for (int m = 0; m < 3; ++m) {
            trace += signs.minus[m] ? -rotation[m][row_of[m]] : rotation[m][row_of[m]];
        }
        if (trace < kLeastTrace) continue;
        double small[3][3];
        for (int m = 0; m < 3; ++m) {
            for (int c = 0; c < 3; ++c) small[row_of[m]][c] = signs.minus[m] ? -rotation[m][c] : rotation[m][c];
        }
        const double k = 1 / (1 + trace);
        const DVec3 p{k * (small[2][1] - small[1][2]), k * (small[0][2] - small[2][0]),
                      k * (small[1][0] - small[0][1])};
        if (std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) <= kReach) searchAround(p, g, frame, best);
    }
    return best.code << 1 | (frame.mirrored ? 1u : 0u);
}

}  // namespace tspace::pack
