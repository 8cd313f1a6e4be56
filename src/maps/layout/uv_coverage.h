// SPDX-License-Identifier: MIT
// Which texels of an image the triangles of a UV map show.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tspace/maps.h"
#include "tspace/span.h"

namespace tspace {

// UDIM: UV maps whose unit squares have an image each, ten in a row, 1001 and on.

/// The tile of a triangle's middle, by the UVs of its three corners; 0: none (not finite, or outside of tiles 1001 to 9990).
inline std::uint32_t tileOf(const Vec2* uvs) {
    const double u = (static_cast<double>(uvs[0].x) + uvs[1].x + uvs[2].x) / 3;
    // Tiles go upwards, and v runs down.
    const double v = 1 - (static_cast<double>(uvs[0].y) + uvs[1].y + uvs[2].y) / 3;
    if (!(u >= 0 && u < 10 && v >= 0 && v < 899)) return 0;
    return 1001 + static_cast<std::uint32_t>(u) + 10 * static_cast<std::uint32_t>(v);
}

// A set of texels of one image: a bit each.

/// Texels `left` to `right` - 1 of the rows `top` to `bottom` - 1; row 0 is the top one.
struct TexelRect {
    std::uint32_t left = 0, top = 0, right = 0, bottom = 0;

    [[nodiscard]] bool isEmpty() const { return left >= right || top >= bottom; }
    /// The smallest that holds both.
    void include(const TexelRect& other);
};

class TexelMask {
  public:
    TexelMask() = default;
    TexelMask(std::uint32_t width, std::uint32_t height);

    /// Memory of a mask of that size.
    static std::uint64_t bytesOf(std::uint64_t width, std::uint64_t height) { return (width / 64 + 1) * 8 * height; }

    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }

    [[nodiscard]] bool has(std::uint32_t x, std::uint32_t y) const {
        return (words_[y * row_words_ + x / 64] >> (x % 64) & 1) != 0;
    }
    /// Texels `begin` to `end` - 1 of row `y`, all inside of the image. Time: one step per 64 of them.
    void fill(std::uint32_t y, std::uint32_t begin, std::uint32_t end);
    void fillAll();
    /// Adds those of a mask of the same size.
    void add(const TexelMask& other);
    /// Takes all texels out. Time: the rows that had some.
    void clear();

    /// True when a call of fill has taken all of the row at once.
    [[nodiscard]] bool isWhole(std::uint32_t y) const { return is_whole_[y]; }
    [[nodiscard]] bool isWhole() const { return height_ != 0 && whole_count_ == height_; }
    /// Whether a mask of the same size has a texel that this one has too.
    [[nodiscard]] bool meets(const TexelMask& other) const;
    /// Number of masked texels in the rectangle, which must lie inside the image.
    [[nodiscard]] std::uint64_t count(const TexelRect& rect) const;
    /// Rows that may have texels.
    [[nodiscard]] std::uint32_t firstRow() const { return first_row_; }
    [[nodiscard]] std::uint32_t endRow() const { return end_row_; }

  private:
    std::uint32_t width_ = 0, height_ = 0;
    std::size_t row_words_ = 0;
    std::uint32_t first_row_ = 0, end_row_ = 0, whole_count_ = 0;
    std::vector<std::uint64_t> words_ = {};
    std::vector<bool> is_whole_ = {};
};

/// Triangles as a texture is read with them.
struct UvTriangles {
    std::span<const std::uint32_t> corners = {};  ///< three per triangle, each smaller than uvs.size()
    std::span<const Vec2> uvs = {};               ///< one per vertex, after any transform; v runs down
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
};

/// Adds to the mask each texel whose centre lies inside of a triangle or on its edge. UVs are rounded to 1/256 texel,
/// and from there on all is exact: triangles that share an edge leave no gap. Outside of 0 to 1 the image goes on as
/// the wrap modes say. Triangles with UVs that are not finite, or that repeat the image more than 64 times, are left
/// out, and so is what shows the edge of a clamped image alone.
///
/// steps    how much work is left: a step is a row of a triangle, or 64 texels of one. Each takes some nanoseconds, and
///          kCoverSteps is more than sound models need
///
/// False where the steps ran out, as they do for hostile UV maps: the mask then has all texels.
bool coverTexels(const UvTriangles& triangles, TexelMask& mask, std::uint64_t& steps);

inline constexpr std::uint64_t kCoverSteps = std::uint64_t{1} << 26;

}  // namespace tspace
