// SPDX-License-Identifier: MIT
// Points distributed over a low poly, the true normal at each, and the error of a map relative to them.
#pragma once

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "maps/layout/row_bands.h"
#include "maps/layout/texel_triangles.h"
#include "maps/rays/map_surfaces.h"

namespace tspace {

// Points of triangles on a grid of n x n per texel, divided into bands of texel rows. The points of a band are
// processed in sequence, so sums do not depend on the number of threads.

/// Column or row of a grid of n points per texel, as a texel and a fraction of the distance from its center to the next
/// center.
struct BetweenTexels {
    std::uint32_t texel = 0;
    float part = 0;
};

inline BetweenTexels betweenTexels(std::uint32_t at, std::uint32_t n, std::uint32_t size, TextureWrap wrap) {
    const std::uint32_t shift = n / 2;
    const bool repeats = wrap == TextureWrap::repeat;
    // Points before the first center belong to the last texel of an image that repeats. In other images only the first
    // texel contributes to them.
    if (at < shift && !repeats) return {};
    const std::uint32_t from_center = at < shift ? at + size * n - shift : at - shift, texel = from_center / n;
    if (texel + 1 == size && !repeats) return {texel, 0};
    const float first = n % 2 == 0 ? 0.5F / static_cast<float>(n) : 0.0F;
    return {texel, first + static_cast<float>(from_center % n) / static_cast<float>(n)};
}

/// Point of the grid inside a triangle or on its edge.
struct BandSample {
    std::uint32_t triangle = 0;
    std::uint32_t row = 0, column = 0;  ///< row and column of the grid in the image
    double x = 0, y = 0;                ///< position in texels, relative to the origin of the placed triangle
    const ExactTriangle* exact = nullptr;

    [[nodiscard]] std::array<double, 3> weights() const { return exact->weights(x, y); }
};

/// Bands of rows of the sample grid. Band b starts at grid row b * kBandTexels * n + shift and covers kBandTexels rows
/// of texels (the last band: the remaining rows). Row numbers wrap around. Points outside a clamped image are skipped.
/// Points are visited in blocks of 4 x 4, because nearby rays are traced faster together.
class SampleBands {
  public:
    static constexpr std::uint32_t kBandTexels = 16;

    SampleBands(const UvTriangles& triangles, std::uint32_t width, std::uint32_t height, std::uint32_t n,
                std::uint32_t shift)
        : triangles_(triangles), shape_{width, height, triangles.wrap_u, triangles.wrap_v}, grid_{width * n, height * n,
                                                                                                  triangles.wrap_u,
                                                                                                  triangles.wrap_v},
          n_(n), shift_(shift), bands_(grid_, kBandTexels * n, shift) {
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            PlacedTriangle placed;
            if (placed.place(triangles[i], grid_) == UvPlacing::placed && placed.doubleArea() != 0)
                bands_.add(static_cast<std::uint32_t>(i), placed.rows());
        }
    }

    [[nodiscard]] std::size_t bandCount() const { return bands_.size(); }
    /// Returns the number of texel rows of a band.
    [[nodiscard]] std::uint32_t rowCount(std::size_t band) const {
        return std::min(kBandTexels, shape_.height - static_cast<std::uint32_t>(band) * kBandTexels);
    }

    /// Calls visit(BandSample) for all samples of a band, one triangle after the other.
    template <class Visit>
    void forSamples(std::size_t band, Visit&& visit) const {
        const std::int64_t height = grid_.height;
        const std::int64_t first = std::int64_t{kBandTexels} * n_ * static_cast<std::int64_t>(band) + shift_;
        const std::int64_t last = first + std::int64_t{rowCount(band)} * n_ - 1;
        const TexelRange parts[] = {{0, last - height}, {first, std::min(last, height - 1)}};
        for (const std::uint32_t triangle : bands_[band]) {
            const std::array<Vec2, 3> uvs = triangles_[triangle];
            PlacedTriangle placed;
            placed.place(uvs, grid_);
            const ExactTriangle exact(uvs, placed, shape_);
            const TexelRange rows = placed.rows();
            for (std::int64_t tile = floorDiv(rows.first, height); tile <= floorDiv(rows.last, height); ++tile) {
                const bool flipped = isFlipped(tile, grid_.wrap_v);
                for (const TexelRange& part : parts) {
                    const TexelRange inside = rowsOfTile(rows, tile, grid_.height, grid_.wrap_v, part.first, part.last);
                    for (std::int64_t at = inside.first; at <= inside.last; at += kBlock) {
                        const TexelRange some{at, std::min(inside.last, at + kBlock - 1)};
                        visitRows(placed, some, tile * height + (flipped ? height - 1 : 0), flipped ? -1 : 1,
                                  {.triangle = triangle, .exact = &exact}, visit);
                    }
                }
            }
        }
    }

  private:
    static constexpr std::int64_t kBlock = 4;

    /// Visits rows of the image. Its row 0 is row `origin` of the infinite plane, and each further row advances by
    /// `step`.
    template <class Visit>
    void visitRows(const PlacedTriangle& placed, TexelRange rows, std::int64_t origin, std::int64_t step,
                   BandSample sample, Visit&& visit) const {
        std::array<TexelRange, kBlock> columns;
        std::int64_t first = INT64_MAX, last = INT64_MIN;
        for (std::int64_t row = rows.first; row <= rows.last; ++row) {
            const TexelRange range = placed.columns(origin + step * row);
            columns[static_cast<std::size_t>(row - rows.first)] = range;
            if (range.isEmpty()) continue;
            first = std::min(first, range.first);
            last = std::max(last, range.last);
        }
        if (grid_.wrap_u == TextureWrap::clamp) {
            first = std::max<std::int64_t>(first, 0);
            last = std::min<std::int64_t>(last, grid_.width - 1);
        }
        for (std::int64_t block = first; block <= last; block += kBlock) {
            for (std::int64_t row = rows.first; row <= rows.last; ++row) {
                const TexelRange& range = columns[static_cast<std::size_t>(row - rows.first)];
                sample.row = static_cast<std::uint32_t>(row);
                sample.y = (static_cast<double>(origin + step * row) + 0.5) / n_;
                const TexelRange some{std::max(range.first, block), std::min(range.last, block + kBlock - 1)};
                if (some.isEmpty()) continue;
                forColumnsInImage(some, grid_.width, grid_.wrap_u, [&](std::int64_t column, std::size_t at) {
                    sample.x = (static_cast<double>(column) + 0.5) / n_;
                    sample.column = static_cast<std::uint32_t>(at);
                    visit(sample);
                });
            }
        }
    }

    UvTriangles triangles_;
    TextureShape shape_, grid_;
    std::uint32_t n_, shift_;
    RowBands bands_;
};

/// Resources of a call: allocator, threads and progress.
struct MapWork {
    const Allocator* allocator;
    Parallel& parallel;
    const Progress& progress;
};

class MeasurePoints {
  public:
    /// Traces a ray for each of `count` points. Memory: 48 bytes per point.
    static MeasurePoints spread(const MapSurfaces& surfaces, std::uint32_t count, const MapWork& work);

    /// Measures a map, without the heat map.
    [[nodiscard]] MapError measure(const MapImage& map, const MapSurfaces& surfaces, const MapCandidate& candidate,
                                   Parallel& parallel) const;

  private:
    struct Point {
        std::uint32_t triangle = 0;
        float second = 0, third = 0;  ///< weights of the second and the third corner
        bool is_hit = false, is_hidden = false, met_back = false, is_inward = false;
        Vec3 normal = {};  ///< true normal at the point

        [[nodiscard]] std::array<double, 3> weights() const { return {1.0 - second - third, second, third}; }
    };
    std::vector<Point> points_ = {};
    std::vector<std::uint8_t> borders_ =
        {};  ///< flags per triangle: bit i is set if the edge that starts at corner i is a border of the UV map

    void findBorders(const LowPoly& low);
    void countPoints(MapError& error) const;
    [[nodiscard]] bool isNearBorder(const MapImage& map, const LowPoly& low, const Point& point, const Vec2& uv) const;
};

/// Returns the unit normal that a renderer shades at a point.
DVec3 shadedAt(const MapImage& map, const MapCandidate& candidate, const CornerFrames& corners,
               const std::array<double, 3>& weights, const Vec2& uv);

/// Returns the error of each texel in degrees: the mean of four samples; -1 if none of them is in a triangle or hits
/// the high poly.
std::vector<float> heatOf(const MapImage& map, const MapSurfaces& surfaces, const MapCandidate& candidate,
                          const MapWork& work);

/// Range of the progress steps that a stage reports.
struct ProgressSteps {
    std::uint64_t before = 0, total = 0;
};

/// Calls task(i) for each i below `count` in parallel, and `progress` at intervals from the calling thread, since
/// bodies of parallel loops must not call back to the user.
template <class Task>
void forTasksWithProgress(const MapWork& work, std::size_t count, const char* what, ProgressSteps steps, Task&& task) {
    const std::size_t at_once = std::size_t{work.parallel.width()} * 4;
    for (std::size_t begin = 0; begin < count; begin += at_once) {
        if (work.progress) work.progress(what, steps.before + begin, steps.total);
        work.parallel.forTasks(std::min(at_once, count - begin), [&](std::size_t i) { task(begin + i); });
    }
}
template <class Task>
void forTasksWithProgress(const MapWork& work, std::size_t count, const char* what, Task&& task) {
    forTasksWithProgress(work, count, what, {0, count}, task);
}

}  // namespace tspace
