// SPDX-License-Identifier: MIT
// Which triangle of a UV map says what stands in a texel, and where in the triangle the texel's centre is.
#pragma once

#include <optional>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "maps/layout/uv_coverage.h"
#include "maps/layout/uv_rows.h"

namespace tspace {

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;
/// A padding without limit: every texel has a triangle, if there is one at all.
inline constexpr std::uint32_t kAllTexels = 0xffffffffu;

enum class TexelCoverage : std::uint8_t {
    none,    ///< no triangle within the padding
    inside,  ///< the centre lies in the triangle or on its edge
    beside   ///< the nearest triangle, whose plane goes on
};

struct TexelPlace {
    std::uint32_t triangle = kNoTriangle;
    /// Column and row before wrapping, counted from where the triangle's image begins (PlacedTriangle).
    std::int32_t x = 0, y = 0;
};

struct TexelTriangleCounts {
    std::uint64_t inside = 0, beside = 0;
    std::uint64_t overlapping = 0;  ///< texels with the centre inside of several triangles; the first has them
    // Triangles that are left out:
    std::uint64_t without_area = 0;  ///< less than 1/256 texel wide
    std::uint64_t not_finite = 0;
    std::uint64_t too_far = 0;   ///< UvPlacing::tooFar
    std::uint64_t repeated = 0;  ///< large ones, all of whose corners are those of two before
};

struct TexelTriangles {
    TextureShape shape = {};
    Buffer<TexelPlace> places = {};  ///< width * height, as kinds
    Buffer<TexelCoverage> kinds = {};
    Buffer<bool> overlaps = {};  ///< whether several triangles claim the texel
    Buffer<bool> is_read =
        {};  ///< outside of all triangles, but read by bilinear filtering inside of one; needs a padding of 2
    TexelTriangleCounts counts = {};
};

/// Looks at all texels of an image, 2^33 at most, neither side 0.
///
/// Inside of a triangle is what coverTexels says; where several claim a texel, the first has it. Of the others, those within 1.5
/// texels of a triangle get the nearest one; further away, up to `padding` texels, the nearest one of those that the
/// texels around have, which is less than a texel further than the nearest of all. Wrapped as the modes say;
/// a clamped image ends at its edge, beyond which triangles are not looked for.
///
/// Nothing where there is more work than sound models need (kCoverSteps). Time: linear in triangles, their rows, and texels.
/// Equal results for any number of threads. Throws OutOfMemory; 27 bytes a texel while it runs, 15 stay.
std::optional<TexelTriangles> findTexelTriangles(const UvTriangles& triangles, std::uint32_t width,
                                                 std::uint32_t height, std::uint32_t padding, Parallel& parallel,
                                                 const Allocator* allocator = nullptr);

/// The UVs of a triangle's corners.
inline std::array<Vec2, 3> cornerUvs(const UvTriangles& triangles, std::size_t triangle) {
    const std::uint32_t* const corners = triangles.corners.data() + 3 * triangle;
    return {triangles.uvs[corners[0]], triangles.uvs[corners[1]], triangles.uvs[corners[2]]};
}

/// A triangle in texels, not rounded, where PlacedTriangle puts it.
class ExactTriangle {
  public:
    ExactTriangle(const std::array<Vec2, 3>& uvs, const PlacedTriangle& placed, const TextureShape& shape);

    /// Barycentric coordinates of a point; their sum is 1. Outside of the triangle they go on as its plane does, but none below
    /// -1: from there on they are those of a point nearer to it, since frames say nothing so far away (slivers).
    /// Always finite.
    [[nodiscard]] std::array<double, 3> weights(double x, double y) const;
    /// The square of the distance of a point, in texels; 0 inside.
    [[nodiscard]] double squaredDistance(double x, double y) const;

    /// Whether a point of the triangle lies less than one column and less than one row away.
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

/// ExactTriangle::weights of a texel's centre. `place` has a triangle.
std::array<double, 3> weightsAt(const UvTriangles& triangles, const TextureShape& shape, const TexelPlace& place);

/// A point of a triangle, in texels before wrapping.
struct UvSample {
    double x = 0, y = 0;
    std::array<double, 3> weights = {};
};

/// visit(UvSample) for each point of a grid of n x n points a texel (those of a texel at (i + 0.5) / n) that lies inside of the
/// triangle or on its edge: a point on the edge of two is visited with both. Not placed: nothing is visited. `n` times the
/// image's sides give at most 2^33 points.
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
