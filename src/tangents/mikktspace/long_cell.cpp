// SPDX-License-Identifier: MIT
#include "tangents/mikktspace/long_cell.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "core/byte_bits.h"
#include "core/float4.h"
#include "core/vec_math.h"
#include "tangents/mikktspace/weld_cell.h"
#include "tangents/mikktspace/words.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kPiece = 64;        // vertices
constexpr std::size_t kShortPart = 1024;  // vertices; weld_cell.h is as fast with so few
constexpr std::size_t kGrain = 256;       // pieces

/// Three components of a vector that has something else behind it.
Float4 loadThree(const Vec3& v) { return loadFloat4(&v.x); }
Vec3 threeOf(Float4 v) { return {v[0], v[1], v[2]}; }

struct Bounds {
    Float4 low = splat(std::numeric_limits<float>::infinity()), high = -low;

    void add(Float4 lowest, Float4 highest) {
        low = min4(lowest, low);
        high = max4(highest, high);
    }
};

/// How many of `count` bytes are below the limit.
std::size_t countBelow(const std::uint8_t* bytes, std::size_t count, std::uint8_t limit) {
    constexpr std::size_t kRun = 128;  // so many fit into a byte, and compilers count 16 at once
    std::size_t below = 0, i = 0;
    for (; i + kRun <= count; i += kRun) {
        std::uint8_t here = 0;
        for (std::size_t k = 0; k < kRun; ++k) here = static_cast<std::uint8_t>(here + (bytes[i + k] < limit ? 1 : 0));
        below += here;
    }
    for (; i < count; ++i) below += bytes[i] < limit ? 1 : 0;
    return below;
}

/// The bits of a block's elements that are in [begin, end).
std::uint64_t blockBits(std::size_t block, std::size_t begin, std::size_t end) {
    constexpr std::size_t kBlock = NumberedCorners::kBlock;
    const std::size_t first = std::max(begin, kBlock * block), last = std::min(end, kBlock * (block + 1));
    if (first >= last) return 0;
    return ~std::uint64_t{0} >> (kBlock - (last - first)) << (first - kBlock * block);
}

}  // namespace

/// The reference goes from the left to the first element that belongs to the right, from the right to the first
/// one that belongs to the left, swaps them, and so on until it meets itself. Let the cut be where the right side
/// will begin. As many elements before the cut belong to the right as behind it belong to the left. So while some
/// are left, the next one from the left is before the cut and the next one from the right is behind it: the first
/// changes places with the last, the second with the last but one. Then all are on their sides.
std::size_t NumberedCorners::partition(std::size_t begin, std::size_t end, std::uint8_t first_right, bool keep_left,
                                       bool keep_right) {
    const std::size_t cut = begin + countBelow(parts.data() + begin, end - begin, first_right);
    const auto goLeft = [&](std::size_t block) { return bytesBelow(parts.data() + kBlock * block, first_right); };
    std::size_t left_block = begin / kBlock, right_block = (end + kBlock - 1) / kBlock;
    std::uint64_t on_left = 0, on_right = 0;  // who has to leave the block before left_block, and right_block
    while (true) {
        for (; on_left == 0; ++left_block) {
            if (kBlock * left_block >= cut) return cut;
            on_left = ~goLeft(left_block) & blockBits(left_block, begin, cut);
        }
        while (on_right == 0) {
            --right_block;
            on_right = goLeft(right_block) & blockBits(right_block, cut, end);
        }
        // Mostly several neighbours leave together.
        const int first = std::countr_zero(on_left), last = std::countl_zero(on_right);
        const int together = std::min(std::countr_one(on_left >> first), std::countl_one(on_right << last));
        const std::uint64_t ones = ~std::uint64_t{0};
        on_left &= ~(ones >> (64 - together) << first);
        on_right &= ~(ones << (64 - together) >> last);
        const std::size_t i = kBlock * (left_block - 1) + static_cast<std::size_t>(first);
        const std::size_t j = kBlock * right_block + kBlock - 1 - static_cast<std::size_t>(last);
        for (std::size_t n = 0; n < static_cast<std::size_t>(together); ++n) {
            const std::uint8_t part = parts[i + n];
            const std::uint32_t entry = entries[i + n];
            if (keep_left) {
                parts[i + n] = parts[j - n];
                entries[i + n] = entries[j - n];
            }
            if (keep_right) {
                parts[j - n] = part;
                entries[j - n] = entry;
            }
        }
    }
}

LongCell::LongCell(const StridedSpan<const Vec3>& positions, Buffer<std::uint32_t> vertices, std::span<Vec3> wanted,
                   std::size_t mesh_vertex_count, const Allocator* allocator, Parallel& parallel)
    : positions_(positions),
      vertices_(std::move(vertices)),
      wanted_(wanted),
      allocator_(allocator),
      part_of_(allocator, mesh_vertex_count),
      pieces_(allocator),
      left_pieces_(allocator),
      waiting_(allocator),
      steps_(allocator) {
    std::fill_n(part_of_.data(), part_of_.size(), kOutside);
    makePieces(parallel);
    Bounds whole;
    for (const Piece& piece : pieces_) whole.add(loadThree(piece.low), loadThree(piece.high));
    waiting_.push({threeOf(whole.low), threeOf(whole.high), kNone, vertices_.size(), 0, 0, wanted_.size()});
    while (!waiting_.empty()) {
        const Part part = waiting_[waiting_.size() - 1];
        waiting_.drop(1);
        if (part.cut != kNone) steps_[part.cut].first_right = part_count_;
        if (!cut(part)) finish(part);
    }
}

void LongCell::makePieces(Parallel& parallel) {
    const std::size_t count = (vertices_.size() + kPiece - 1) / kPiece;
    Piece* pieces = pieces_.extend(count);
    parallel.forRanges(count, kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n) {
            const std::size_t begin = n * kPiece, end = std::min(begin + kPiece, vertices_.size());
            Bounds box;
            for (std::size_t i = begin; i < end; ++i) {
                const Vec3& p = positions_[vertices_[i]];
                const Float4 here = {p.x, p.y, p.z, 0};
                box.add(here, here);
            }
            pieces[n] = {threeOf(box.low), static_cast<std::uint32_t>(begin), threeOf(box.high),
                         static_cast<std::uint32_t>(end)};
        }
    });
}

/// One side of a cut, while the pieces of both are found.
struct LongCell::Side {
    Bounds box;
    std::size_t vertex_count = 0;

    void add(const Piece& piece) {
        box.add(loadThree(piece.low), loadThree(piece.high));
        vertex_count += piece.end - piece.begin;
    }
};

/// Cuts the part, or returns false where it need not or cannot be cut.
bool LongCell::cut(const Part& part) {
    if (part.wanted_begin == part.wanted_end || part.vertex_count <= kShortPart) return false;
    if (part_count_ + waiting_.size() + 2 > kOutside) return false;  // each has to become a part
    const int axis = Box(part.low, part.high).longestAxis();
    const float low = component(part.low, axis), high = component(part.high, axis);
    const float middle = 0.5f * (high + low);
    if (middle >= high || middle <= low) return false;
    const auto wanted_cut = std::partition(wanted_.begin() + static_cast<std::ptrdiff_t>(part.wanted_begin),
                                           wanted_.begin() + static_cast<std::ptrdiff_t>(part.wanted_end),
                                           [=](const Vec3& p) { return component(p, axis) < middle; }) -
                            wanted_.begin();
    Side left, right;
    std::size_t right_end = part.piece_begin;  // pieces of the right side move together
    for (std::size_t i = part.piece_begin; i < pieces_.size(); ++i) {
        Piece piece = pieces_[i];
        if (component(piece.high, axis) < middle) {
            left.add(piece);
            left_pieces_.push(piece);
            continue;
        }
        if (component(piece.low, axis) < middle) {
            const Piece before = takeLeft(piece, axis, middle);
            left.add(before);
            left_pieces_.push(before);
        }
        right.add(piece);
        pieces_[right_end++] = piece;
    }
    pieces_.drop(pieces_.size() - right_end);
    std::copy(left_pieces_.begin(), left_pieces_.end(), pieces_.extend(left_pieces_.size()));
    left_pieces_.drop(left_pieces_.size());
    const auto step = static_cast<std::uint32_t>(steps_.size());
    const auto wanted_middle = static_cast<std::size_t>(wanted_cut);
    steps_.push({.is_cut = true,
                 .keep_left = wanted_middle != part.wanted_begin,
                 .keep_right = wanted_middle != part.wanted_end});
    waiting_.push({threeOf(right.box.low), threeOf(right.box.high), step, right.vertex_count, part.piece_begin,
                   wanted_middle, part.wanted_end});
    waiting_.push({threeOf(left.box.low), threeOf(left.box.high), kNone, left.vertex_count, right_end,
                   part.wanted_begin, wanted_middle});
    return true;
}

/// Parts a piece with vertices on both sides: leaves those on the right, and returns those on the left.
LongCell::Piece LongCell::takeLeft(Piece& piece, int axis, float middle) {
    std::uint32_t right[kPiece];
    Bounds boxes[2];
    std::uint32_t left_end = piece.begin, right_count = 0;
    for (std::uint32_t i = piece.begin; i < piece.end; ++i) {
        const std::uint32_t vertex = vertices_[i];
        const Vec3& p = positions_[vertex];
        const std::uint32_t is_right = component(p, axis) < middle ? 0 : 1;
        const Float4 here = {p.x, p.y, p.z, 0};
        boxes[is_right].add(here, here);
        vertices_[left_end] = right[right_count] = vertex;
        left_end += 1 - is_right;
        right_count += is_right;
    }
    std::copy_n(right, right_count, vertices_.data() + left_end);
    const Piece left{threeOf(boxes[0].low), piece.begin, threeOf(boxes[0].high), left_end};
    piece = {threeOf(boxes[1].low), left_end, threeOf(boxes[1].high), piece.end};
    return left;
}

void LongCell::finish(const Part& part) {
    for (std::size_t i = part.piece_begin; i < pieces_.size(); ++i) {
        for (std::uint32_t n = pieces_[i].begin; n < pieces_[i].end; ++n) part_of_[vertices_[n]] = part_count_;
    }
    pieces_.drop(pieces_.size() - part.piece_begin);
    steps_.push({.is_wanted = part.wanted_begin != part.wanted_end});
    ++part_count_;
}

}  // namespace tspace::mikk
