// SPDX-License-Identifier: MIT
// Triangles of a UV map on the texel grid in integer coordinates, and the rows of texel centers inside them. All code
// uses this rule for whether a texel is inside a triangle: UVs are rounded to 1/256 texel, and the rest is exact. So
// triangles that share an edge leave no gap.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/unique_index.h"
#include "maps/texels/texture_sample.h"

namespace tspace {

/// Number of subdivisions of a texel to which UVs are rounded.
inline constexpr std::int64_t kTexelParts = 256;
/// Maximum number of times a triangle may repeat the image. With images of at most 2^33 texels, products of two
/// coordinates do not overflow.
inline constexpr double kMostRepeats = 64;

inline std::int64_t floorDiv(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }
inline std::int64_t ceilDiv(std::int64_t a, std::int64_t b) { return -floorDiv(-a, b); }

/// Returns the position in the image of texel `at` of an infinite row; `size` if the image has no such texel.
inline std::uint32_t texelInImage(std::int64_t at, std::uint32_t size, TextureWrap wrap) {
    return wrap == TextureWrap::clamp && (at < 0 || at >= size) ? size : wrappedTexel(at, size, wrap);
}

enum class UvPlacing : std::uint8_t {
    placed,
    notFinite,
    tooFar  ///< repeats the image more than kMostRepeats times, or is that many images outside a clamped image
};

/// One UV coordinate of the three corners of a triangle, in texels.
struct PlacedAxis {
    /// Number of whole images that were subtracted from the coordinates, so that the first covered image has index 0
    /// (with `mirror`: 0 or 1). With `clamp`, nothing is subtracted.
    double begin = 0;
    std::array<std::int64_t, 3> at = {};  ///< coordinate of each corner, in subdivisions of a texel

    UvPlacing place(const std::array<float, 3>& from, std::uint32_t size, TextureWrap wrap) {
        const double least = std::min({from[0], from[1], from[2]}), most = std::max({from[0], from[1], from[2]});
        for (const float value : from) {
            if (!std::isfinite(value)) return UvPlacing::notFinite;
        }
        if (!(most - least <= kMostRepeats)) return UvPlacing::tooFar;
        begin = 0;
        if (wrap == TextureWrap::repeat) begin = std::floor(least);
        if (wrap == TextureWrap::mirror) begin = 2 * std::floor(least / 2);
        if (wrap == TextureWrap::clamp && (least < -kMostRepeats || most > kMostRepeats)) return UvPlacing::tooFar;
        for (std::size_t i = 0; i < 3; ++i) at[i] = std::llround((from[i] - begin) * size * kTexelParts);
        return UvPlacing::placed;
    }
};

/// Range of texel columns (or rows), including the last one.
struct TexelRange {
    std::int64_t first = 0, last = -1;

    [[nodiscard]] bool isEmpty() const { return last < first; }
};

/// Returns whether a tile (a copy of the image in the infinite plane) is mirrored.
inline bool isFlipped(std::int64_t tile, TextureWrap wrap) { return wrap == TextureWrap::mirror && tile % 2 != 0; }

/// Returns the rows of the image that a range of rows of the infinite plane covers in a tile, limited to the rows
/// `first` to `last`.
inline TexelRange rowsOfTile(TexelRange rows, std::int64_t tile, std::uint32_t size, TextureWrap wrap,
                             std::int64_t first, std::int64_t last) {
    if (wrap == TextureWrap::clamp && tile != 0) return {};
    const std::int64_t height = size;
    std::int64_t from = std::max<std::int64_t>(rows.first - tile * height, 0);
    std::int64_t to = std::min<std::int64_t>(rows.last - tile * height, height - 1);
    if (isFlipped(tile, wrap)) {
        from = height - 1 - from;
        to = height - 1 - to;
        std::swap(from, to);
    }
    return {std::max(from, first), std::min(to, last)};
}

/// Calls visit(column, column in the image) for a range of columns, which is limited to the image if the image is
/// clamped.
template <class Visit>
void forColumnsInImage(TexelRange columns, std::uint32_t size, TextureWrap wrap, const Visit& visit) {
    const std::int64_t width = size;
    if (wrap == TextureWrap::clamp)
        columns = {std::max<std::int64_t>(columns.first, 0), std::min(columns.last, width - 1)};
    while (!columns.isEmpty()) {
        const std::int64_t tile = floorDiv(columns.first, width);
        const std::int64_t last = std::min(columns.last, (tile + 1) * width - 1);
        const bool flipped = isFlipped(tile, wrap);
        for (std::int64_t column = columns.first; column <= last; ++column) {
            const std::int64_t at = column - tile * width;
            visit(column, static_cast<std::size_t>(flipped ? width - 1 - at : at));
        }
        columns.first = last + 1;
    }
}

/// Triangle in texel coordinates of the infinite plane; texelInImage converts them to positions in the image.
struct PlacedTriangle {
    PlacedAxis x = {}, y = {};

    UvPlacing place(const std::array<Vec2, 3>& uvs, const TextureShape& shape) {
        const UvPlacing placing = x.place({uvs[0].x, uvs[1].x, uvs[2].x}, shape.width, shape.wrap_u);
        return placing == UvPlacing::placed ? y.place({uvs[0].y, uvs[1].y, uvs[2].y}, shape.height, shape.wrap_v)
                                            : placing;
    }

    /// Returns a key that is equal for triangles with the same corner positions in the same order.
    [[nodiscard]] std::array<std::int64_t, 6> key() const {
        return {x.at[0], x.at[1], x.at[2], y.at[0], y.at[1], y.at[2]};
    }

    /// Returns twice the area in squared subdivisions; 0 if the triangle is degenerate.
    [[nodiscard]] std::int64_t doubleArea() const {
        return (x.at[1] - x.at[0]) * (y.at[2] - y.at[0]) - (y.at[1] - y.at[0]) * (x.at[2] - x.at[0]);
    }

    [[nodiscard]] TexelRange rows() const {
        const auto [least, most] = std::minmax_element(y.at.begin(), y.at.end());
        return {ceilDiv(*least - kTexelParts / 2, kTexelParts), floorDiv(*most - kTexelParts / 2, kTexelParts)};
    }

    /// Returns the texels of a row whose centers are inside the triangle or on its edge.
    [[nodiscard]] TexelRange columns(std::int64_t row) const {
        const std::int64_t center = row * kTexelParts + kTexelParts / 2;
        TexelRange range{INT64_MAX, INT64_MIN};
        const auto include = [&](std::int64_t over, std::int64_t under) {
            range.first = std::min(range.first, ceilDiv(over - kTexelParts / 2 * under, kTexelParts * under));
            range.last = std::max(range.last, floorDiv(over - kTexelParts / 2 * under, kTexelParts * under));
        };
        for (std::size_t i = 0; i < 3; ++i) {
            std::size_t a = i, b = (i + 1) % 3;
            if (y.at[a] > y.at[b]) std::swap(a, b);
            if (center < y.at[a] || center > y.at[b]) continue;
            if (y.at[a] == y.at[b]) {
                include(x.at[a], 1);
                include(x.at[b], 1);
            } else {
                const std::int64_t height = y.at[b] - y.at[a];
                include(x.at[a] * height + (center - y.at[a]) * (x.at[b] - x.at[a]), height);
            }
        }
        return range;
    }

    /// Returns whether the center of a texel is strictly inside, not on an edge.
    [[nodiscard]] bool isInner(std::int64_t column, std::int64_t row) const {
        const std::int64_t px = column * kTexelParts + kTexelParts / 2, py = row * kTexelParts + kTexelParts / 2;
        int left = 0, right = 0;
        for (std::size_t a = 0; a < 3; ++a) {
            const std::size_t b = (a + 1) % 3;
            const std::int64_t side = (x.at[b] - x.at[a]) * (py - y.at[a]) - (y.at[b] - y.at[a]) * (px - x.at[a]);
            left += side > 0 ? 1 : 0;
            right += side < 0 ? 1 : 0;
        }
        return left == 3 || right == 3;
    }
};

/// Large triangles, which are remembered so that repeated ones can be skipped: many cards of one tree share the same
/// part of an image.
class LargeTriangles {
  public:
    /// Returns the number of earlier triangles with equal corners, and remembers the triangle. Returns 0 for triangles
    /// with few rows, and for those that exceed the memory.
    std::uint32_t countEarlier(const PlacedTriangle& triangle) {
        constexpr std::int64_t kLeastRows = 64;
        constexpr std::size_t kMostRemembered = std::size_t{1} << 16;
        const TexelRange rows = triangle.rows();
        if (rows.last - rows.first < kLeastRows) return 0;
        const std::uint32_t number =
            earlier_.size() < kMostRemembered ? known_.indexOf(triangle.key()) : known_.find(triangle.key());
        if (number < earlier_.size()) return ++earlier_[number];
        if (number == earlier_.size()) earlier_.push_back(0);
        return 0;
    }

  private:
    UniqueIndex<std::array<std::int64_t, 6>> known_{};
    std::vector<std::uint32_t> earlier_ = {};  ///< number of earlier triangles for each number of `known_`
};

}  // namespace tspace
