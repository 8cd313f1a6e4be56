// SPDX-License-Identifier: MIT
#include "commands/check/mesh_regression.h"

#include <array>
#include <cstddef>

#include "core/base/vec_math.h"

namespace tspace {
namespace {

/// Correlation of the map's vectors with the mesh normals: the slope of the regression of vectors on normals. It is
/// about 1 in object space, and 0 for a map that is unrelated to the mesh. Relief that resembles the mesh (a bulge on a
/// bulge) correlates too, so the `bent` values are computed after removing all that is linear in u and v.
struct NormalRegression {
    double spread = 0;  ///< mean squared distance of the normals from their mean
    double slope = 0;
    double bent_share = 0, bent_slope = 0;
};

NormalRegression regressionOf(std::span<const TexelOnSurface> surface, const MapLayout& layout) {
    // Sums of products of the values 1, u, v, the normal and the vector of the map.
    std::array<std::array<double, 9>, 9> sums{};
    const LayoutReader reader(layout);
    for (const TexelOnSurface& point : surface) {
        DVec3 v = reader.vector(point.texel);
        if (!normalize(v)) continue;
        const std::array<double, 9> row{1,   point.uv.x, point.uv.y, point.normal.x, point.normal.y, point.normal.z,
                                        v.x, v.y,        v.z};
        for (std::size_t i = 0; i < 9; ++i) {
            for (std::size_t k = 0; k < 9; ++k) sums[i][k] += point.weight * row[i] * row[k];
        }
    }
    const double weight = sums[0][0];
    const auto eliminate = [&](std::size_t pivot, double least) {
        if (!(sums[pivot][pivot] > least)) return;
        const auto by = sums[pivot];
        for (auto& row : sums) {
            const double factor = row[pivot] / by[pivot];
            for (std::size_t k = 0; k < 9; ++k) row[k] -= factor * by[k];
        }
    };
    const auto spread = [&] { return sums[3][3] + sums[4][4] + sums[5][5]; };
    const auto slope = [&] { return spread() > 0 ? (sums[3][6] + sums[4][7] + sums[5][8]) / spread() : 0; };
    if (!(weight > 0)) return {};
    constexpr double kRounding = 1e-9;
    const double min_u = kRounding * sums[1][1], min_v = kRounding * sums[2][2];
    eliminate(0, 0);
    NormalRegression regression{.spread = spread() / weight, .slope = slope()};
    eliminate(1, min_u);
    eliminate(2, min_v);
    regression.bent_share = regression.spread > 0 ? spread() / weight / regression.spread : 0;
    regression.bent_slope = slope();
    return regression;
}

}  // namespace

bool isOfMesh(std::span<const TexelOnSurface> surface, const MapLayout& layout, bool may_be_tangent) {
    constexpr double kFlat = 0.002, kMinSlope = 0.5, kMinBent = 0.25;
    const NormalRegression regression = regressionOf(surface, layout);
    if (!may_be_tangent) return regression.spread < kFlat || regression.slope > kMinSlope;
    return regression.spread >= kFlat && regression.slope > kMinSlope && regression.bent_share > kMinBent &&
           regression.bent_slope > kMinSlope;
}

bool isOfMeshUnderRelief(std::span<const TexelOnSurface> surface, const MapLayout& layout, bool may_be_tangent) {
    constexpr std::size_t kQuarters = 4, kManyPoints = 1024;
    constexpr double kFlat = 0.002, kMinSlope = 0.4, kMinOfQuarter = 0.25, kMinBent = 0.25;
    if (surface.size() < kManyPoints) return false;
    const NormalRegression regression = regressionOf(surface, layout);
    if (regression.spread < kFlat || regression.slope < kMinSlope) return false;
    if (may_be_tangent && (regression.bent_share < kMinBent || regression.bent_slope < kMinSlope)) return false;
    for (std::size_t i = 0; i < kQuarters; ++i) {
        const std::size_t begin = i * surface.size() / kQuarters, end = (i + 1) * surface.size() / kQuarters;
        const NormalRegression quarter = regressionOf(surface.subspan(begin, end - begin), layout);
        if (quarter.spread < kFlat || quarter.slope < kMinOfQuarter) return false;
    }
    return true;
}

}  // namespace tspace
