// SPDX-License-Identifier: MIT
// Islands by union-find over welded edges; matrices of texture transforms.
#include "core/mesh/surface/uvs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/base/disjoint_sets.h"
#include "core/base/mesh_loops.h"
#include "core/base/vec_math.h"
#include "core/mesh/surface/surface.h"

namespace tspace {
namespace {

/// Returns the parents of triangles in a forest of disjoint sets (disjoint_sets.h), one set per UV island.
std::vector<std::uint32_t> joinIslands(std::span<const std::uint32_t> corners, const EqualVertices& equal) {
    std::vector<std::uint32_t> islands(corners.size() / 3);
    std::iota(islands.begin(), islands.end(), 0U);
    const auto forHalves = [&](const auto& add) {
        for (std::uint32_t corner = 0; corner < corners.size(); ++corner) {
            const std::uint32_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
            const auto [low, high] = std::minmax(equal.class_of[corners[corner]], equal.class_of[corners[next]]);
            add(low, high, corner);
        }
    };
    forEachEdge(equal.class_count, nullptr, forHalves,
                [&](std::uint32_t, std::uint32_t, std::span<const HalfEdge> halves) {
                    for (const HalfEdge half : halves)
                        joinSets(islands.data(), cornerOf(halves[0]) / 3, cornerOf(half) / 3);
                });
    return islands;
}

}  // namespace

UvIslands findUvIslands(std::span<const std::uint32_t> corners, std::span<const Vec3> positions,
                        std::span<const Vec2> uvs) {
    std::vector<std::uint32_t> sets = joinIslands(corners, findEqualVertices(positions, {}, uvs));
    UvIslands islands;
    islands.island_of.resize(corners.size() / 3);
    constexpr std::uint32_t kNew = 0xffffffffu;
    std::vector<std::uint32_t> number_of(islands.island_of.size(), kNew);
    for (std::size_t i = 0; i < islands.island_of.size(); ++i) {
        std::uint32_t& number = number_of[rootOf(sets.data(), static_cast<std::uint32_t>(i))];
        if (number == kNew) number = islands.count++;
        islands.island_of[i] = number;
    }
    return islands;
}

double signedUvArea(const Vec2& a, const Vec2& b, const Vec2& c, bool v_runs_down) {
    const double s1 = static_cast<double>(b.x) - a.x;
    const double t1 = static_cast<double>(b.y) - a.y;
    const double s2 = static_cast<double>(c.x) - a.x;
    const double t2 = static_cast<double>(c.y) - a.y;
    const double area = s1 * t2 - s2 * t1;
    return v_runs_down ? -area : area;
}

// Conversion of a texture transform to the matrix for its frames.

namespace {

/// Returns a sine or cosine, rounded to -1, 0 or 1 if it is close: files store a quarter turn as a float, or with a few
/// digits.
double snapped(double value) {
    constexpr double kClose = 1e-6;
    if (std::fabs(value) < kClose) return 0;
    if (std::fabs(value) > 1 - kClose * kClose) return value < 0 ? -1 : 1;
    return value;
}

}  // namespace

UvMatrix uvMatrix(double rotation, double scale_u, double scale_v) {
    const SineCosine turn = sineCosine(rotation);
    const double sine = snapped(turn.sine), cosine = snapped(turn.cosine);
    if (scale_u == 0) scale_u = 1;
    if (scale_v == 0) scale_v = 1;
    if (sine == 0 || cosine == 0) {
        scale_u = std::copysign(1.0, scale_u);
        scale_v = std::copysign(1.0, scale_v);
    } else {
        const double common = std::max(std::fabs(scale_u), std::fabs(scale_v));
        scale_u /= common;
        scale_v /= common;
    }
    // Adding +0 converts -0 to +0, so that equal matrices have equal bits.
    return {cosine * scale_u, sine * scale_v + 0.0, -sine * scale_u + 0.0, cosine * scale_v};
}

std::vector<Vec2> transformUvs(StridedSpan<const Vec2> uvs, const UvMatrix& matrix) {
    std::vector<Vec2> result;
    result.reserve(uvs.count);
    for (std::size_t i = 0; i < uvs.count; ++i) {
        const Vec2& uv = uvs[i];
        result.push_back({static_cast<float>(matrix.uu * uv.x + matrix.uv * uv.y),
                          static_cast<float>(matrix.vu * uv.x + matrix.vv * uv.y)});
    }
    return result;
}

}  // namespace tspace
