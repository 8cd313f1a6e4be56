// SPDX-License-Identifier: MIT
// Rasterizes UV triangles: finds the texel centers inside each triangle, in integer arithmetic.
#include "maps/layout/uv_coverage.h"

#include <algorithm>
#include <array>
#include <bit>

#include "maps/layout/uv_rows.h"

namespace tspace {
namespace {

/// Returns a mask of the bits `begin` to `end` - 1 of a word; `end` is at most 64.
std::uint64_t bitsOf(std::uint32_t begin, std::uint32_t end) {
    const std::uint64_t below_end = end == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << end) - 1;
    return below_end & ~((std::uint64_t{1} << begin) - 1);
}

/// Calls work(word, bits) for each word of the texels `begin` to `end` - 1 of a row.
template <class Work>
void forWords(std::uint32_t begin, std::uint32_t end, const Work& work) {
    for (std::uint32_t word = begin / 64; word * 64 < end; ++word)
        work(word, bitsOf(word == begin / 64 ? begin % 64 : 0, std::min(end - word * 64, 64U)));
}

}  // namespace

void TexelRect::include(const TexelRect& other) {
    if (other.isEmpty()) return;
    if (isEmpty()) {
        *this = other;
        return;
    }
    left = std::min(left, other.left);
    top = std::min(top, other.top);
    right = std::max(right, other.right);
    bottom = std::max(bottom, other.bottom);
}

TexelMask::TexelMask(std::uint32_t width, std::uint32_t height)
    : width_(width), height_(height), row_words_((std::size_t{width} + 63) / 64), first_row_(height),
      words_(row_words_ * height), is_whole_(height) {}

void TexelMask::fill(std::uint32_t y, std::uint32_t begin, std::uint32_t end) {
    if (begin >= end || is_whole_[y]) return;
    first_row_ = std::min(first_row_, y);
    end_row_ = std::max(end_row_, y + 1);
    forWords(begin, end, [&](std::uint32_t word, std::uint64_t bits) { words_[y * row_words_ + word] |= bits; });
    if (begin != 0 || end != width_) return;
    is_whole_[y] = true;
    ++whole_count_;
}

void TexelMask::fillAll() {
    for (std::uint32_t y = 0; y < height_; ++y) fill(y, 0, width_);
}

void TexelMask::add(const TexelMask& other) {
    for (std::uint32_t y = other.first_row_; y < other.end_row_; ++y) {
        if (other.is_whole_[y]) {
            fill(y, 0, width_);
            continue;
        }
        for (std::size_t i = 0; i < row_words_; ++i) words_[y * row_words_ + i] |= other.words_[y * row_words_ + i];
    }
    first_row_ = std::min(first_row_, other.first_row_);
    end_row_ = std::max(end_row_, other.end_row_);
}

void TexelMask::clear() {
    for (std::uint32_t y = first_row_; y < end_row_; ++y) {
        std::fill_n(words_.begin() + static_cast<std::ptrdiff_t>(y * row_words_), row_words_, 0);
        is_whole_[y] = false;
    }
    first_row_ = height_;
    end_row_ = whole_count_ = 0;
}

bool TexelMask::meets(const TexelMask& other) const {
    const std::size_t begin = std::max(first_row_, other.first_row_) * row_words_;
    const std::size_t end = std::min(end_row_, other.end_row_) * row_words_;
    for (std::size_t i = begin; i < end; ++i) {
        if ((words_[i] & other.words_[i]) != 0) return true;
    }
    return false;
}

std::uint64_t TexelMask::count(const TexelRect& rect) const {
    std::uint64_t result = 0;
    for (std::uint32_t y = std::max(rect.top, first_row_); y < std::min(rect.bottom, end_row_); ++y) {
        forWords(rect.left, rect.right, [&](std::uint32_t word, std::uint64_t bits) {
            result += static_cast<std::uint64_t>(std::popcount(words_[y * row_words_ + word] & bits));
        });
    }
    return result;
}

namespace {

class Coverage {
  public:
    Coverage(const UvTriangles& triangles, TexelMask& mask, std::uint64_t& steps)
        : triangles_(triangles), shape_{mask.width(), mask.height(), triangles.wrap_u, triangles.wrap_v}, mask_(mask),
          steps_(steps) {}

    bool run() {
        for (std::size_t i = 0; i < triangles_.size() && !mask_.isWhole(); ++i) {
            addTriangle(triangles_[i]);
            if (steps_ != 0) continue;
            mask_.fillAll();
            return false;
        }
        return true;
    }

  private:
    void addTriangle(const std::array<Vec2, 3>& uvs) {
        PlacedTriangle triangle;
        if (triangle.place(uvs, shape_) != UvPlacing::placed || large_.countEarlier(triangle) > 0) return;
        const TexelRange rows = triangle.rows();
        for (std::int64_t row = rows.first; row <= rows.last; ++row) {
            take(1);
            const std::uint32_t at = texelInImage(row, shape_.height, shape_.wrap_v);
            if (at >= shape_.height || mask_.isWhole(at)) continue;
            const TexelRange columns = triangle.columns(row);
            if (!columns.isEmpty()) addSpan(columns.first, columns.last + 1, at);
        }
    }

    void addSpan(std::int64_t begin, std::int64_t end, std::uint32_t row) {
        const std::int64_t width = shape_.width;
        const TextureWrap wrap = shape_.wrap_u;
        if (wrap == TextureWrap::clamp) {
            begin = std::max<std::int64_t>(begin, 0);
            end = std::min(end, width);
        } else if (end - begin >= (wrap == TextureWrap::mirror ? 2 : 1) * width) {
            begin = 0;
            end = width;
        }
        while (begin < end) {
            const std::int64_t tile = floorDiv(begin, width), in_tile = std::min(end, (tile + 1) * width);
            std::uint32_t from = texelInImage(begin, shape_.width, wrap),
                          to = texelInImage(in_tile - 1, shape_.width, wrap);
            if (from > to) std::swap(from, to);
            mask_.fill(row, from, to + 1);
            take((to - from) / 64);
            begin = in_tile;
        }
    }

    void take(std::uint64_t steps) { steps_ -= std::min(steps_, steps); }

    const UvTriangles& triangles_;
    TextureShape shape_;
    TexelMask& mask_;
    std::uint64_t& steps_;
    LargeTriangles large_ = {};
};

}  // namespace

bool coverTexels(const UvTriangles& triangles, TexelMask& mask, std::uint64_t& steps) {
    return mask.width() == 0 || mask.height() == 0 || Coverage(triangles, mask, steps).run();
}

}  // namespace tspace
