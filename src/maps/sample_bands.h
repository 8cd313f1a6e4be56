// SPDX-License-Identifier: MIT
// Points of triangles on a grid of n x n a texel, cut into bands of texel rows, one after the other in a band: what all
// threads add up is the same for any number of them.
#pragma once

#include <utility>

#include "core/memory.h"
#include "maps/texel_triangles.h"

namespace tspace {

/// A point inside of a triangle or on its edge.
struct BandSample {
    std::uint32_t triangle = 0;
    std::int64_t row = 0;      ///< of the grid, from where the band begins
    std::uint32_t column = 0;  ///< of the grid, in the image
    double x = 0, y = 0;       ///< in texels, where the triangle is placed
    const ExactTriangle* exact = nullptr;

    [[nodiscard]] std::array<double, 3> weights() const { return exact->weights(x, y); }
};

/// The image repeats. Band b has the grid rows b * kBandTexels * n + shift and on, as many as kBandTexels texels have or are
/// left; beyond the last row comes the first.
class SampleBands {
  public:
    static constexpr std::uint32_t kBandTexels = 16;

    SampleBands(const UvTriangles& triangles, std::uint32_t width, std::uint32_t height, std::uint32_t n,
                std::uint32_t shift, const Allocator* allocator)
        : triangles_(triangles),
          shape_{width, height},
          grid_{width * n, height * n},
          n_(n),
          shift_(shift),
          begin_(allocator, bandCount() + 1, std::size_t{0}) {
        const std::size_t count = triangles.corners.size() / 3;
        for (std::size_t i = 0; i < count; ++i) {
            forBands(i, [&](std::size_t band) { ++begin_[band]; });
        }
        std::size_t total = 0;
        for (std::size_t band = 0; band <= bandCount(); ++band) total += std::exchange(begin_[band], total);
        entries_ = Buffer<std::uint32_t>(allocator, total);
        Buffer<std::size_t> next(allocator, bandCount(), std::size_t{0});
        for (std::size_t i = 0; i < count; ++i) {
            forBands(i,
                     [&](std::size_t band) { entries_[begin_[band] + next[band]++] = static_cast<std::uint32_t>(i); });
        }
    }

    [[nodiscard]] std::size_t bandCount() const { return (shape_.height + kBandTexels - 1) / kBandTexels; }
    /// Texel rows of a band.
    [[nodiscard]] std::uint32_t rowCount(std::size_t band) const {
        return std::min(kBandTexels, shape_.height - static_cast<std::uint32_t>(band) * kBandTexels);
    }

    /// visit(BandSample), triangle after triangle.
    template <class Visit>
    void forSamples(std::size_t band, Visit&& visit) const {
        const std::int64_t height = grid_.height, width = grid_.width;
        const std::int64_t first = std::int64_t{kBandTexels} * n_ * static_cast<std::int64_t>(band) + shift_;
        const std::int64_t last = first + std::int64_t{rowCount(band)} * n_ - 1;
        for (std::size_t i = begin_[band]; i < begin_[band + 1]; ++i) {
            const std::array<Vec2, 3> uvs = cornerUvs(triangles_, entries_[i]);
            PlacedTriangle placed;
            if (placed.place(uvs, grid_) != UvPlacing::placed) continue;
            const ExactTriangle exact(uvs, placed, shape_);
            const TexelRange rows = placed.rows();
            for (std::int64_t tile = floorDiv(rows.first - last, height); tile * height + first <= rows.last; ++tile) {
                const std::int64_t begin = tile * height + first;
                for (std::int64_t row = std::max(rows.first, begin); row <= std::min(rows.last, tile * height + last);
                     ++row) {
                    const TexelRange columns = placed.columns(row);
                    for (std::int64_t column = columns.first; column <= columns.last; ++column) {
                        const double x = (static_cast<double>(column) + 0.5) / n_;
                        const double y = (static_cast<double>(row) + 0.5) / n_;
                        visit(BandSample{entries_[i], row - begin, static_cast<std::uint32_t>(column % width), x, y,
                                         &exact});
                    }
                }
            }
        }
    }

  private:
    /// visit(band), once for each that the triangle has rows in.
    template <class Visit>
    void forBands(std::size_t triangle, Visit&& visit) const {
        PlacedTriangle placed;
        if (placed.place(cornerUvs(triangles_, triangle), grid_) != UvPlacing::placed || placed.doubleArea() == 0)
            return;
        const TexelRange rows = placed.rows();
        if (rows.isEmpty()) return;
        const std::int64_t height = grid_.height;
        const std::int64_t count = std::min(rows.last - rows.first + 1, height);
        const auto bandOf = [&](std::int64_t row) {
            const std::int64_t from_shift = row - shift_, in_image = from_shift - floorDiv(from_shift, height) * height;
            return static_cast<std::size_t>(in_image / (std::int64_t{kBandTexels} * n_));
        };
        const std::size_t first = bandOf(rows.first), last = bandOf(rows.first + count - 1);
        visit(first);
        if (first == last && count <= std::int64_t{kBandTexels} * n_) return;
        for (std::size_t band = first + 1 == bandCount() ? 0 : first + 1; band != first;
             band = band + 1 == bandCount() ? 0 : band + 1) {
            visit(band);
            if (band == last) break;
        }
    }

    UvTriangles triangles_;
    TextureShape shape_, grid_;
    std::uint32_t n_, shift_;
    Buffer<std::size_t> begin_;
    Buffer<std::uint32_t> entries_ = {};
};

}  // namespace tspace
