// SPDX-License-Identifier: MIT
// Nearest N first, then the angle of T in the basis of the N that is decoded: so T's error is that of two legs of a
// right-angled spherical triangle, N's error and half a step of the angle.
#include "pack/angle_code.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simd/lanes_scalar.h"
#define TSPACE_LANES scalar
#include "pack/angle_lanes.h"
#undef TSPACE_LANES

namespace tspace::pack {

namespace {

Vec3 vectorOf(const simd::scalar::Vectors& v) { return {v.x.v, v.y.v, v.z.v}; }

struct Point {
    double x = 0, y = 0;
};

/// Where a unit vector lies on the unfolded octahedron, [-1, 1] both ways: the b_i with b_i (2.5 - b_i) = L |n_i| whose
/// sum is 1. Their sum is convex in L and grows, and the first L is not too small, so Newton's method falls
/// monotonically; it ends within a thousandth of frame64's cell.
Point unfolded(const DVec3& n) {
    const double size[3] = {std::fabs(n.x), std::fabs(n.y), std::fabs(n.z)};
    const double most = std::max({size[0], size[1], size[2]});
    double scale = (kFaceWarp - 1) / most;
    double b[3];
    for (int step = 0; step < 7; ++step) {
        double sum = 0, slope = 0;
        for (int m = 0; m < 3; ++m) {
            const double root = std::sqrt(kFaceWarp * kFaceWarp - 4 * std::min(scale * size[m], kFaceWarp - 1));
            b[m] = (kFaceWarp - root) / 2;
            sum += b[m];
            slope += size[m] / root;
        }
        if (std::fabs(sum - 1) < 1e-10) break;
        scale -= (sum - 1) / slope;
    }
    const double x = n.z < 0 ? 1 - b[1] : b[0], y = n.z < 0 ? 1 - b[0] : b[1];
    return {n.x < 0 ? -x : x, n.y < 0 ? -y : y};
}

/// The step at or before this angle, whose cosine and sine may have any common length. Within a quarter
/// s y (2.75 - y) = c x (2.75 - x) with y = 1 - x is a quadratic equation, solved here in the form that divides by no
/// difference.
std::int32_t stepBefore(double c, double s, std::int32_t quarter) {
    std::int32_t turns = 0;
    if (c <= 0 && s > 0) {
        turns = 1;
    } else if (c < 0 && s <= 0) {
        turns = 2;
    } else if (c >= 0 && s < 0) {
        turns = 3;
    }
    const double along[4] = {c, s, -c, -s}, up[4] = {s, -c, -s, c};
    const double run = along[turns], rise = up[turns];
    const double square = rise - run, linear = kAngleWarp * run + (kAngleWarp - 2) * rise;
    const double constant = (kAngleWarp - 1) * rise;
    const double below = linear + std::sqrt(std::max(linear * linear + 4 * square * constant, 0.0));
    const double x = below > 0 ? 2 * constant / below : 0;
    return turns * quarter + std::clamp(static_cast<std::int32_t>(std::floor(x * quarter)), 0, quarter);
}

}  // namespace

AngleCode encodeAngle(const AngleGrid& grid, const SoundFrame& frame) {
    const Point point = unfolded(frame.normal);
    const auto cornerOf = [&](double x) {
        return std::clamp(static_cast<std::int32_t>(std::floor((x + 1) * grid.half)), 0, 2 * grid.half - 1);
    };
    const std::int32_t i0 = cornerOf(point.x), j0 = cornerOf(point.y);
    AngleCode best;
    scalar::GridNormals normal{};
    double least = std::numeric_limits<double>::infinity();
    for (const std::int32_t i : {i0, i0 + 1}) {
        for (const std::int32_t j : {j0, j0 + 1}) {
            const scalar::GridNormals found =
                scalar::gridNormals(grid, {static_cast<float>(i)}, {static_cast<float>(j)});
            const double error = squaredDistance(vectorOf(found.normal), frame.normal);
            if (error >= least) continue;
            least = error;
            normal = found;
            best = {i, j, 0};
        }
    }
    const scalar::Bases basis = scalar::basesOf(normal);
    const double c = dot(frame.tangent, toDouble(vectorOf(basis.p)));
    const double s = dot(frame.tangent, toDouble(vectorOf(basis.q)));
    const std::int32_t k0 = stepBefore(c, s, grid.quarter) & (4 * grid.quarter - 1);
    const std::int32_t k1 = (k0 + 1) & (4 * grid.quarter - 1);
    const auto errorAt = [&](std::int32_t k) {
        const auto quarters = static_cast<std::uint32_t>(k / grid.quarter);
        const auto step = static_cast<float>(k % grid.quarter);
        return squaredDistance(vectorOf(scalar::tangentsAt(grid, basis, {quarters}, {step})), frame.tangent);
    };
    best.k = errorAt(k0) <= errorAt(k1) ? k0 : k1;
    return best;
}

}  // namespace tspace::pack
