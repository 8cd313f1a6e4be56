// SPDX-License-Identifier: MIT
// Nearest N first, then the angle of T in the basis of the N that is decoded: so T's error is that of two legs of a
// right-angled spherical triangle, N's error and half a step of the angle.
#include "pack/angle_code.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tspace::pack {

namespace {

// Barycentric coordinates b on a face of the octahedron are spread as b (2.5 - b), which makes its cells more equal: at
// the same grid the worst N falls from 0.159 to 0.134 degrees. x (2.75 - x) does so for the angle along the side of a
// diamond, whose speed then varies by less than 1 %.
constexpr double kFaceWarp = 2.5, kAngleWarp = 2.75;

struct Basis {
    Vec3 p, q;
};

/// N of a grid point, and the sign of its z as the integers have it.
struct GridNormal {
    Vec3 normal;
    float z_sign;
};

GridNormal gridNormal(std::int32_t half, std::int32_t i, std::int32_t j) {
    std::int32_t a = std::abs(i - half), b = std::abs(j - half), c = half - a - b;
    float z_sign = 1;
    if (c < 0) {  // the lower half is folded over the edges of the diamond
        a += c;
        b += c;
        c = -c;
        z_sign = -1;
    }
    const float whole = static_cast<float>(kFaceWarp) * static_cast<float>(half);
    const auto spread = [whole](std::int32_t steps) {
        return static_cast<float>(steps) * (whole - static_cast<float>(steps));
    };
    const Vec3 v{i < half ? -spread(a) : spread(a), j < half ? -spread(b) : spread(b), z_sign * spread(c)};
    return {unit(v), z_sign};
}

Basis basisOf(const GridNormal& g) {
    const Vec3& n = g.normal;
    const float h = -1 / (g.z_sign + n.z);
    const float d = n.x * n.y * h;
    return {{1 + g.z_sign * n.x * n.x * h, g.z_sign * d, -g.z_sign * n.x}, {d, g.z_sign + n.y * n.y * h, -n.y}};
}

/// T at step k of 4 * quarter.
Vec3 tangentAt(const Basis& basis, std::int32_t quarter, std::int32_t k) {
    const std::int32_t x = k & (quarter - 1), y = quarter - x;
    const float whole = static_cast<float>(kAngleWarp) * static_cast<float>(quarter);
    const float run = static_cast<float>(y) * (whole - static_cast<float>(y));
    const float rise = static_cast<float>(x) * (whole - static_cast<float>(x));
    const float scale = 1 / std::sqrt(run * run + rise * rise);
    float cosine = run * scale, sine = rise * scale;
    const std::int32_t turns = k / quarter;
    if ((turns & 1) != 0) {
        const float c = cosine;
        cosine = -sine;
        sine = c;
    }
    if ((turns & 2) != 0) {
        cosine = -cosine;
        sine = -sine;
    }
    return cosine * basis.p + sine * basis.q;
}

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
    GridNormal normal{};
    double least = std::numeric_limits<double>::infinity();
    for (const std::int32_t i : {i0, i0 + 1}) {
        for (const std::int32_t j : {j0, j0 + 1}) {
            const GridNormal found = gridNormal(grid.half, i, j);
            const double error = squaredDistance(found.normal, frame.normal);
            if (error >= least) continue;
            least = error;
            normal = found;
            best = {i, j, 0};
        }
    }
    const Basis basis = basisOf(normal);
    const double c = dot(frame.tangent, toDouble(basis.p)), s = dot(frame.tangent, toDouble(basis.q));
    const std::int32_t k0 = stepBefore(c, s, grid.quarter) & (4 * grid.quarter - 1);
    const std::int32_t k1 = (k0 + 1) & (4 * grid.quarter - 1);
    const bool is_first = squaredDistance(tangentAt(basis, grid.quarter, k0), frame.tangent) <=
                          squaredDistance(tangentAt(basis, grid.quarter, k1), frame.tangent);
    best.k = is_first ? k0 : k1;
    return best;
}

DecodedFrame decodeAngle(const AngleGrid& grid, const AngleCode& code) {
    const GridNormal normal = gridNormal(grid.half, code.i, code.j);
    return {normal.normal, tangentAt(basisOf(normal), grid.quarter, code.k)};
}

}  // namespace tspace::pack
