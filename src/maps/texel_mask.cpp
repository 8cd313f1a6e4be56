// SPDX-License-Identifier: MIT
#include "maps/texel_mask.h"

#include <algorithm>
#include <bit>

namespace tspace {

namespace {

/// The bits `begin` to `end` - 1 of a word; end is 64 at most.
std::uint64_t bitsOf(std::uint32_t begin, std::uint32_t end) {
    const std::uint64_t below_end = end == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << end) - 1;
    return below_end & ~((std::uint64_t{1} << begin) - 1);
}

/// work(word, bits) for each word of the texels `begin` to `end` - 1 of a row.
template <class Work>
void forWords(std::uint32_t begin, std::uint32_t end, const Work& work) {
    for (std::uint32_t word = begin / 64; word * 64 < end; ++word) {
        work(word, bitsOf(word == begin / 64 ? begin % 64 : 0, std::min(end - word * 64, 64U)));
    }
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
    : width_(width),
      height_(height),
      row_words_((std::size_t{width} + 63) / 64),
      first_row_(height),
      words_(row_words_ * height),
      is_whole_(height) {}

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

}  // namespace tspace
