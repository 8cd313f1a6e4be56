// SPDX-License-Identifier: MIT
// Determines which triangle of a UV map covers each texel, and the position of the texel center in that triangle.
#pragma once

#include <optional>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "maps/layout/uv_coverage.h"
#include "maps/layout/uv_rows.h"

namespace tspace {

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;
/// Value for unlimited padding: every texel gets a triangle, if there is any triangle.
inline constexpr std::uint32_t kAllTexels = 0xffffffffu;

enum class TexelCoverage : std::uint8_t {
    none,     ///< no triangle is within the padding
    inside,   ///< the center is inside the triangle or on its edge
    adjacent  ///< the center is near the triangle, whose plane is extrapolated
};

struct TexelPlace {
    std::uint32_t triangle = kNoTriangle;
    /// Column and row before wrapping, relative to the origin of the triangle's image (PlacedTriangle).
    std::int32_t x = 0, y = 0;
};

struct TexelTriangleCounts {
    std::uint64_t inside = 0, beside = 0;
    std::uint64_t overlapping = 0;  ///< texels whose center is inside several triangles; the first triangle is used
    // Numbers of skipped triangles, for each reason:
    std::uint64_t without_area = 0;  ///< triangles that are less than 1/256 texel wide
    std::uint64_t not_finite = 0;
    std::uint64_t too_far = 0;   ///< triangles with UvPlacing::tooFar
    std::uint64_t repeated = 0;  ///< large triangles whose corners equal those of two earlier ones
};

struct TexelTriangles {
    TextureShape shape = {};
    Buffer<TexelPlace> places = {};  ///< place of each texel, width * height entries, like `kinds`
    Buffer<TexelCoverage> kinds = {};
    Buffer<bool> overlaps = {};  ///< one flag per texel: several triangles cover it
    /// One flag per texel: it is outside all triangles, but bilinear filtering inside one reads it; requires a padding
    /// of 2.
    Buffer<bool> is_read = {};
    TexelTriangleCounts counts = {};
};

/// Finds the triangle of each texel of an image with nonzero sides and at most 2^33 texels.
///
/// Texels inside triangles are those of coverTexels; if several triangles cover a texel, the first one is used. Other
/// texels within 1.5 texels of a triangle get the nearest one. Farther texels, up to `padding`, get the nearest of the
/// triangles assigned to adjacent texels, whose distance exceeds that of the nearest triangle by less than one texel.
/// Texels wrap according to the wrap modes; beyond the edge of a clamped image no triangles are searched.
///
/// Returns nullopt if the work exceeds what valid models need (kCoverSteps). Time: linear in triangles, their rows, and
/// texels. The result does not depend on the number of threads. Throws OutOfMemory. Memory: 27 bytes per texel
/// temporarily, 15 permanently.
std::optional<TexelTriangles> findTexelTriangles(const UvTriangles& triangles, std::uint32_t width,
                                                 std::uint32_t height, std::uint32_t padding, Parallel& parallel,
                                                 const Allocator* allocator = nullptr);

/// Triangle in unrounded texel coordinates, relative to the origin that PlacedTriangle chose.
class ExactTriangle {
  public:
    ExactTriangle(const std::array<Vec2, 3>& uvs, const PlacedTriangle& placed, const TextureShape& shape);

    /// Returns the barycentric coordinates of a point, which sum to 1. Outside the triangle they are extrapolated, but
    /// none falls below -1: farther points use the coordinates of a closer point, because extrapolated frames are
    /// meaningless at such distances (slivers). The coordinates are always finite.
    [[nodiscard]] std::array<double, 3> weights(double x, double y) const;
    /// Returns the squared distance of a point from the triangle, in texels; 0 inside.
    [[nodiscard]] double squaredDistance(double x, double y) const;

    /// Returns whether bilinear filtering inside the triangle reads the texel at a point: whether a point of the
    /// triangle is less than one column and less than one row away.
    [[nodiscard]] bool isReadAt(double x, double y) const;

    std::array<double, 3> x = {}, y = {};

  private:
    struct Nearest {
        std::array<double, 3> weights = {};
        double squared_distance = 0;
    };
    [[nodiscard]] Nearest nearest(double px, double py) const;
    [[nodiscard]] std::array<double, 3> plane(double px, double py) const;

    double double_area_ = 0;
};

/// Returns ExactTriangle::weights of the center of a texel, whose `place` must have a triangle.
std::array<double, 3> weightsAt(const UvTriangles& triangles, const TextureShape& shape, const TexelPlace& place);

/// Sample point of a triangle, in texels before wrapping.
struct UvSample {
    double x = 0, y = 0;
    std::array<double, 3> weights = {};
};

/// Calls visit(UvSample) for each point of a grid of n x n points per texel (at (i + 0.5) / n) that is inside the
/// triangle or on its edge; a point on a shared edge is visited with both triangles. Visits nothing if the triangle
/// cannot be placed. The grid must not exceed 2^33 points.
template <class Visit>
UvPlacing forEachSample(const std::array<Vec2, 3>& uvs, const TextureShape& shape, std::uint32_t n, Visit&& visit) {
    const TextureShape grid{shape.width * n, shape.height * n, shape.wrap_u, shape.wrap_v};
    PlacedTriangle placed;
    const UvPlacing placing = placed.place(uvs, grid);
    if (placing != UvPlacing::placed || placed.doubleArea() == 0) return placing;
    const ExactTriangle exact(uvs, placed, shape);
    const TexelRange rows = placed.rows();
    for (std::int64_t row = rows.first; row <= rows.last; ++row) {
        const TexelRange columns = placed.columns(row);
        for (std::int64_t column = columns.first; column <= columns.last; ++column) {
            const double x = (static_cast<double>(column) + 0.5) / n, y = (static_cast<double>(row) + 0.5) / n;
            visit(UvSample{x, y, exact.weights(x, y)});
        }
    }
    return placing;
}

}  // namespace tspace
