// SPDX-License-Identifier: MIT
#include "core/mesh/surface/position_lattice.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "core/base/unit.h"
#include "core/base/uv_frame.h"
#include "core/base/vec_math.h"

namespace tspace {

namespace {

double valueAt(const Vec3& p, std::size_t axis) { return static_cast<double>(axis == 0 ? p.x : axis == 1 ? p.y : p.z); }

/// The greatest common divisor of distances that are off by `slack` each; 0: there is none to speak of. They are sorted, so
/// that each longer one makes the step more exact before it has to count more of them.
double commonStep(std::vector<double>& distances, double slack, double least) {
    std::sort(distances.begin(), distances.end());
    double step = 0;
    for (const double distance : distances) {
        if (distance <= slack) continue;
        // Euclid, where what is left over by rounding alone is 0.
        double a = distance, b = step;
        while (b != 0) {
            const double left = std::fabs(a - std::round(a / b) * b);
            a = b;
            b = left > slack ? left : 0;
        }
        if (a < least) return 0;
        step = distance / std::round(distance / a);
    }
    return step;
}

}  // namespace

double latticeStep(StridedSpan<const Vec3> positions, std::size_t axis) {
    constexpr std::size_t kFew = 256, kMostTries = 16;
    constexpr double kSlack = 4, kLeast = 32;  // of the distance between floats
    double far = 0;
    for (std::size_t v = 0; v < positions.count; ++v) {
        const double value = std::fabs(valueAt(positions[v], axis));
        if (!std::isfinite(value)) return 0;
        far = std::max(far, value);
    }
    if (positions.count == 0 || far == 0) return 0;
    const double ulp = std::ldexp(1.0, std::ilogb(far) - 23), first = valueAt(positions[0], axis);
    std::vector<double> few;
    const std::size_t stride = positions.count / kFew + 1;
    for (std::size_t v = 0; v < positions.count; v += stride)
        few.push_back(std::fabs(valueAt(positions[v], axis) - first));
    for (std::size_t tries = 0; tries < kMostTries; ++tries) {
        const double step = commonStep(few, kSlack * ulp, kLeast * ulp);
        if (step == 0) return 0;
        std::size_t v = 0;
        for (; v < positions.count; ++v) {
            const double distance = std::fabs(valueAt(positions[v], axis) - first);
            if (std::fabs(distance - std::round(distance / step) * step) <= kSlack * ulp) continue;
            few.push_back(distance);
            break;
        }
        if (v == positions.count) return step;
    }
    return 0;
}

namespace {

/// dP/du of a triangle, and the sine by which rounding turns it in the mean square.
struct TurnedDirection {
    DVec3 direction = {};  ///< unit; zero where rounding left none
    double size = 0;
    double sine = 0;  ///< 0: the triangle says nothing
};

TurnedDirection directionOf(StridedSpan<const Vec3> positions, StridedSpan<const Vec2> uvs, const std::uint32_t* v,
                            double error) {
    const Vec2 a = uvs[v[0]], b = uvs[v[1]], c = uvs[v[2]];
    const UvFrame frame = uvFrame(positions[v[0]], positions[v[1]], positions[v[2]], a, b, c);
    const double area = std::fabs(frame.determinant), length_of_tangent = length(frame.tangent);
    if (!(area > 0) || !std::isfinite(length_of_tangent)) return {};
    // t2 (P1 - P0) - t1 (P2 - P0) is linear in the corners, and across it two of three coordinates of each turn it. In the
    // mean a square is a third of half a step's, and that a third of the square of `error`.
    const double t1 = double{b.y} - a.y, t2 = double{c.y} - a.y;
    const double off = std::sqrt(2.0 / 9 * (t1 * t1 + t2 * t2 + (t2 - t1) * (t2 - t1))) * error;
    TurnedDirection result{.size = length_of_tangent / area,
                           .sine = off < length_of_tangent ? off / length_of_tangent : 1};
    if (length_of_tangent > 0) result.direction = (frame.determinant < 0 ? -1 : 1) / length_of_tangent * frame.tangent;
    return result;
}

}  // namespace

bool scattersByRounding(StridedSpan<const Vec3> positions, StridedSpan<const Vec2> uvs,
                        std::span<const std::span<const std::uint32_t>> corner_lists, double error,
                        const std::array<bool, 3>& may_be_raster) {
    // Parts of what is wanted. Lengths change less where edges are all about as many steps long.
    constexpr double kLeastSine = 0.17, kLeastTurn = 0.25, kLeastStretch = 0.07;
    constexpr std::size_t kLeastCount = 32;
    struct Edge {
        std::uint32_t low, high;
        std::size_t triangle;
        bool operator<(const Edge& other) const {
            return std::tie(low, high, triangle) < std::tie(other.low, other.high, other.triangle);
        }
    };
    std::vector<TurnedDirection> triangles;
    std::vector<Edge> edges;
    for (const std::span<const std::uint32_t> corners : corner_lists) {
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
            const TurnedDirection triangle = directionOf(positions, uvs, corners.data() + i, error);
            if (!(triangle.sine > kLeastSine)) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const auto [low, high] = std::minmax(corners[i + k], corners[i + (k + 1) % 3]);
                edges.push_back({low, high, triangles.size()});
            }
            triangles.push_back(triangle);
        }
    }
    std::sort(edges.begin(), edges.end());
    std::size_t count = 0;
    double turned = 0, stretched = 0, wanted = 0;
    std::array<double, 3> along_axes = {};
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
        if (edges[i].low != edges[i + 1].low || edges[i].high != edges[i + 1].high) continue;
        const TurnedDirection &a = triangles[edges[i].triangle], &b = triangles[edges[i + 1].triangle];
        const DVec3 turn = a.direction - b.direction;
        const double sum = a.size + b.size, stretch = sum > 0 ? 2 * (a.size - b.size) / sum : 0;
        ++count;
        turned += dot(turn, turn);
        stretched += stretch * stretch;
        const DVec3 change = sum > 0 ? 2 / sum * (a.size * a.direction - b.size * b.direction) : DVec3{};
        along_axes[0] += change.x * change.x;
        along_axes[1] += change.y * change.y;
        along_axes[2] += change.z * change.z;
        wanted += std::min(1.0, a.sine * a.sine + b.sine * b.sine);
    }
    const auto isMuch = [&](double sum, double least) { return sum > least * least * wanted; };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (may_be_raster[axis] && !isMuch(along_axes[axis], kLeastTurn)) return false;
    }
    return count >= kLeastCount && isMuch(turned, kLeastTurn) && isMuch(stretched, kLeastStretch);
}

}  // namespace tspace
