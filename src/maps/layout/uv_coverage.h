// SPDX-License-Identifier: MIT
// Computes which texels of an image the triangles of a UV map cover.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tspace/maps.h"
#include "tspace/span.h"

namespace tspace {

// UDIM, a UV layout in which each unit square has its own image: ten squares per row, numbered from 1001.

/// Returns the tile that contains the center of a triangle, given the UVs of its three corners. Returns 0 if there is
/// none: the center is not finite, or outside tiles 1001 to 9990.
inline std::uint32_t tileOf(const Vec2* uvs) {
    const double u = (static_cast<double>(uvs[0].x) + uvs[1].x + uvs[2].x) / 3;
    // Tile rows are counted upward, whereas v points down.
    const double v = 1 - (static_cast<double>(uvs[0].y) + uvs[1].y + uvs[2].y) / 3;
    if (!(u >= 0 && u < 10 && v >= 0 && v < 899)) return 0;
    return 1001 + static_cast<std::uint32_t>(u) + 10 * static_cast<std::uint32_t>(v);
}

// Set of the texels of one image, with one bit per texel.

/// Rectangle of texels: texels `left` to `right` - 1 of rows `top` to `bottom` - 1; row 0 is at the top.
struct TexelRect {
    std::uint32_t left = 0, top = 0, right = 0, bottom = 0;

    [[nodiscard]] bool isEmpty() const { return left >= right || top >= bottom; }
    /// Grows to the smallest rectangle that contains both.
    void include(const TexelRect& other);
};

class TexelMask {
  public:
    TexelMask() = default;
    TexelMask(std::uint32_t width, std::uint32_t height);

    /// Returns the memory that a mask of the given size takes, in bytes.
    static std::uint64_t bytesOf(std::uint64_t width, std::uint64_t height) { return (width / 64 + 1) * 8 * height; }

    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }

    [[nodiscard]] bool has(std::uint32_t x, std::uint32_t y) const {
        return (words_[y * row_words_ + x / 64] >> (x % 64) & 1) != 0;
    }
    /// Adds the texels `begin` to `end` - 1 of row `y`, which must be inside the image. Time: one step per 64 texels.
    void fill(std::uint32_t y, std::uint32_t begin, std::uint32_t end);
    void fillAll();
    /// Adds the texels of a mask of the same size.
    void add(const TexelMask& other);
    /// Removes all texels. The time is proportional to the rows that contained texels.
    void clear();

    /// Returns true if a single call of fill() covered the whole row.
    [[nodiscard]] bool isWhole(std::uint32_t y) const { return is_whole_[y]; }
    [[nodiscard]] bool isWhole() const { return height_ != 0 && whole_count_ == height_; }
    /// Returns whether the two masks, which must have the same size, share a texel.
    [[nodiscard]] bool meets(const TexelMask& other) const;
    /// Returns the number of texels of the mask in a rectangle, which must lie inside the image.
    [[nodiscard]] std::uint64_t count(const TexelRect& rect) const;

  private:
    std::uint32_t width_ = 0, height_ = 0;
    std::size_t row_words_ = 0;
    std::uint32_t first_row_ = 0, end_row_ = 0;  ///< range of rows that may contain texels
    std::uint32_t whole_count_ = 0;
    std::vector<std::uint64_t> words_ = {};
    std::vector<bool> is_whole_ = {};
};

/// Triangles of a UV map, with the wrap modes of its texture.
struct UvTriangles {
    /// Vertices of the corners, three per triangle, each smaller than uvs.count. Without: each corner has its own UV.
    std::optional<std::span<const std::uint32_t>> corners = {};
    StridedSpan<const Vec2> uvs = {};  ///< one per vertex, after any transform; v points down
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;

    [[nodiscard]] std::size_t size() const { return (corners ? corners->size() : uvs.count) / 3; }
    /// Returns the UVs of a triangle's corners.
    [[nodiscard]] std::array<Vec2, 3> operator[](std::size_t triangle) const {
        const std::size_t i = 3 * triangle;
        if (!corners) return {uvs[i], uvs[i + 1], uvs[i + 2]};
        return {uvs[(*corners)[i]], uvs[(*corners)[i + 1]], uvs[(*corners)[i + 2]]};
    }
};

/// Returns the triangles of UVs, three per triangle, with the wrap modes of a texture.
template <class Texture>
UvTriangles uvTriangles(const StridedSpan<const Vec2>& uvs, const Texture& texture) {
    return {.uvs = uvs, .wrap_u = texture.wrap_u, .wrap_v = texture.wrap_v};
}

/// Adds to the mask each texel whose center is inside a triangle or on its edge. UVs are rounded to 1/256 texel, and
/// the rest is exact: triangles that share an edge leave no gap. Outside of 0 to 1 the wrap modes apply. Triangles are
/// skipped if their UVs are not finite, if they repeat the image more than 64 times, or if they cover only the edge
/// texels of a clamped image.
///
/// steps    remaining work limit: one step is a row of a triangle, or 64 texels of one. Each takes a few nanoseconds;
///          kCoverSteps is more than valid models need
///
/// Returns false if the steps are exhausted, as for malicious UV maps: the mask then contains all texels.
bool coverTexels(const UvTriangles& triangles, TexelMask& mask, std::uint64_t& steps);

inline constexpr std::uint64_t kCoverSteps = std::uint64_t{1} << 26;

}  // namespace tspace
