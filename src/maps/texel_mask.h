// SPDX-License-Identifier: MIT
// A set of texels of one image: a bit each.
#pragma once

#include <cstdint>
#include <vector>

namespace tspace {

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
    /// How many texels of the rectangle, which lies inside of the image, are in the mask.
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

}  // namespace tspace
