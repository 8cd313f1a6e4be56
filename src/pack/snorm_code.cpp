// SPDX-License-Identifier: MIT
#include "pack/snorm_code.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tspace::pack {

namespace {

constexpr std::int32_t kMost16 = 32767;

std::int32_t rounded(double x) { return static_cast<std::int32_t>(std::floor(x + 0.5)); }

/// The quaternion x, y, z, w of the rotation with columns T, N x T, N; w >= 0. The largest component comes first, from
/// the diagonal, and divides the others: no digits cancel.
std::array<double, 4> quaternionOf(const SoundFrame& frame) {
    const DVec3 &t = frame.tangent, &n = frame.normal, b = cross(n, t);
    const double squares[4] = {1 + t.x - b.y - n.z, 1 - t.x + b.y - n.z, 1 - t.x - b.y + n.z, 1 + t.x + b.y + n.z};
    const double sums[3][3] = {{0, t.y + b.x, n.x + t.z}, {t.y + b.x, 0, b.z + n.y}, {n.x + t.z, b.z + n.y, 0}};
    const double differences[3] = {b.z - n.y, n.x - t.z, t.y - b.x};
    const auto largest = static_cast<std::size_t>(std::max_element(squares, squares + 4) - squares);
    std::array<double, 4> q;
    for (std::size_t m = 0; m < 4; ++m) {
        if (m == largest) {
            q[m] = squares[m];
        } else if (largest == 3) {
            q[m] = differences[m];
        } else {
            q[m] = m == 3 ? differences[largest] : sums[largest][m];
        }
    }
    const double scale = (q[3] < 0 ? -1 : 1) / std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (double& component : q) component *= scale;
    return q;
}

/// How far N or T is from that of the rotation q, whichever is farther: the turn between them, in the frame's axes, is
/// about the vector of conj(q) * code. In no unit, but for all codes in the same.
double errorOf(const std::array<std::int32_t, 4>& code, const std::array<double, 4>& q) {
    const DVec3 v{q[0], q[1], q[2]}, c{double(code[0]), double(code[1]), double(code[2])};
    return squaredReach(q[3] * c - code[3] * v - cross(v, c));
}

}  // namespace

std::array<std::int32_t, 4> encodeQuaternion(const SoundFrame& frame) {
    const std::array<double, 4> q = quaternionOf(frame);
    std::array<std::int32_t, 4> below;
    for (std::size_t m = 0; m < 4; ++m) below[m] = static_cast<std::int32_t>(std::floor(q[m] * kMost16));
    // Of the codes around it the one with the least error, not the one with the nearest components. Sixteen do; but w must
    // not be 0, and where only 1 is left for it, further x, y and z make up for that: docs/pack.md has the bounds.
    std::array<std::int32_t, 4> best{0, 0, 0, 1};
    double least = std::numeric_limits<double>::infinity();
    const bool is_half_turn = below[3] == 0;
    for (std::uint32_t choice = 0; choice < (is_half_turn ? 64u : 16u); ++choice) {
        std::array<std::int32_t, 4> code;
        for (std::uint32_t m = 0; m < 4; ++m) {
            const auto up = static_cast<std::int32_t>(is_half_turn ? choice >> 2 * m & 3 : choice >> m & 1);
            code[m] = std::clamp(below[m] + up - (is_half_turn ? 1 : 0), -kMost16, kMost16);
        }
        if (is_half_turn) code[3] = 1;
        const double error = errorOf(code, q);
        if (error >= least) continue;
        least = error;
        best = code;
    }
    if (frame.mirrored) {
        for (std::int32_t& component : best) component = -component;
    }
    return best;
}

std::array<std::int32_t, 3> encodeVector(const DVec3& v, std::int32_t most) {
    // v is unit but for its last bits, so nothing exceeds `most`.
    return {rounded(v.x * most), rounded(v.y * most), rounded(v.z * most)};
}

}  // namespace tspace::pack
