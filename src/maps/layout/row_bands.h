// SPDX-License-Identifier: MIT
// Lists of the triangles that have texels in a band of rows of an image, so that bands can be processed in parallel.
#pragma once

#include <span>
#include <vector>

#include "maps/layout/uv_rows.h"

namespace tspace {

/// Bands of `rows` rows of an image; the last band has the remaining rows. Band 0 starts at row `shift`, and the rows
/// above it belong to the last band.
class RowBands {
  public:
    RowBands(const TextureShape& shape, std::uint32_t rows, std::uint32_t shift = 0)
        : shape_(shape), rows_(rows), shift_(shift), lists_((shape.height + rows - 1) / rows) {}

    [[nodiscard]] std::size_t size() const { return lists_.size(); }
    /// Returns the triangles of a band in the order in which they were added.
    [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t band) const { return lists_[band]; }

    /// Adds a triangle to each band that contains one of its rows, which are rows of the infinite plane. Three tiles
    /// suffice: a triangle that extends over more than two tiles covers all rows of a tile, and so all bands.
    void add(std::uint32_t triangle, TexelRange rows) {
        const std::int64_t height = shape_.height;
        const bool is_clamped = shape_.wrap_v == TextureWrap::clamp;
        const std::int64_t first_tile = is_clamped ? 0 : floorDiv(rows.first, height);
        const std::int64_t last_tile = is_clamped ? 0 : std::min(floorDiv(rows.last, height), first_tile + 2);
        for (std::int64_t tile = first_tile; tile <= last_tile; ++tile) {
            const TexelRange inside = rowsOfTile(rows, tile, shape_.height, shape_.wrap_v, 0, height - 1);
            if (inside.isEmpty()) continue;
            if (inside.first < shift_) addTo(lists_.back(), triangle);
            const std::int64_t begin = std::max<std::int64_t>(inside.first - shift_, 0);
            for (std::int64_t band = begin / rows_; band * rows_ <= inside.last - shift_; ++band)
                addTo(lists_[static_cast<std::size_t>(band)], triangle);
        }
    }

  private:
    static void addTo(std::vector<std::uint32_t>& list, std::uint32_t triangle) {
        if (list.empty() || list.back() != triangle) list.push_back(triangle);
    }

    TextureShape shape_;
    std::int64_t rows_, shift_;
    std::vector<std::vector<std::uint32_t>> lists_;
};

}  // namespace tspace
