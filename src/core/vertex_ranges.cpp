// SPDX-License-Identifier: MIT
#include "core/vertex_ranges.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "core/prefetch.h"
#include "core/typed_indices.h"

namespace tspace {

namespace {

/// The bits that any of some numbers has, and those that all of them have.
struct RangeBits {
    std::uint32_t any, all;
    bool are_below;  ///< whether all are below a limit, which is at most 2^31
};
RangeBits bitsOf(const std::uint32_t* numbers, std::size_t count, std::uint32_t limit) {
    std::uint32_t any = 0, all = ~std::uint32_t{0}, below = ~std::uint32_t{0};
    for (std::size_t i = 0; i < count; ++i) {
        any |= numbers[i];
        all &= numbers[i];
        below &= numbers[i] - limit;  // for numbers below 2^31 the highest bit says whether they are below
    }
    return {any, all, (below & ~any) >> 31 != 0};
}

/// Whether each vertex is its own point. Mostly so; comparisons are cheaper than keeping what was read.
bool areTheirOwn(const std::uint32_t* points, const std::uint32_t* vertices, std::size_t count) {
    for (std::size_t i = 0; i < count; i += 3) {
        if (points[vertices[i]] != vertices[i] || points[vertices[i + 1]] != vertices[i + 1] ||
            points[vertices[i + 2]] != vertices[i + 2]) {
            return false;
        }
    }
    return true;
}

}  // namespace

VertexRanges::VertexRanges(const IndexView& vertices, std::size_t triangle_count, std::size_t point_count,
                           const std::uint32_t* points)
    : vertices_(vertices),
      triangle_count_(triangle_count),
      block_count_((triangle_count + kBlock - 1) / kBlock),
      point_count_(point_count),
      limit_(static_cast<std::uint32_t>(point_count)),
      points_(points) {}

unsigned VertexRanges::shiftFor(std::size_t wanted) const {
    const std::size_t most = std::clamp<std::size_t>(wanted, 1, kMost);
    unsigned shift = 0;
    while (((point_count_ - 1) >> shift) >= most) ++shift;
    return shift;
}

bool VertexRanges::wouldBeCompact(std::size_t wanted) const {
    constexpr std::size_t kSamples = 64;
    const unsigned shift = shiftFor(wanted);
    const std::size_t samples = std::min(block_count_, kSamples);
    std::size_t named = 0;
    for (std::size_t i = 0; i < samples; ++i) {
        const std::uint64_t mark = markOf((2 * i + 1) * block_count_ / (2 * samples), shift);
        named += static_cast<std::size_t>(std::popcount(mark & ~kRepeated));
    }
    return 2 * named <= 3 * samples;
}

bool VertexRanges::cut(std::size_t wanted, const Allocator* allocator, Parallel& parallel) {
    shift_ = shiftFor(wanted);
    count_ = static_cast<unsigned>((point_count_ - 1) >> shift_) + 1;
    marks_ = Buffer<std::uint64_t>(allocator, block_count_);
    constexpr std::size_t kGrain = 256;
    parallel.forRanges(block_count_, kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t block = begin; block < end; ++block) marks_[block] = markOf(block, shift_);
    });
    if (std::find(marks_.begin(), marks_.end(), std::uint64_t{0}) != marks_.end()) return false;
    list(allocator);
    return true;
}

std::uint64_t VertexRanges::markOf(std::size_t block, unsigned shift) const {
    std::uint32_t buffer[3 * kBlock];
    const std::size_t count = 3 * blockSize(block);
    if (count == 0) return 0;
    const std::uint32_t* v = readIndices(vertices_, 3 * block * kBlock, count, buffer);
    prefetchLines(v, 3 * kBlock * sizeof *v);
    RangeBits bits = bitsOf(v, count, limit_);
    if (!bits.are_below) return 0;
    std::uint64_t mark = 0;
    if (points_ != nullptr && !areTheirOwn(points_, v, count)) {
        for (std::size_t i = 0; i < count; ++i) buffer[i] = points_[v[i]];
        v = buffer;
        bits = bitsOf(v, count, limit_);
        mark = kRepeated;
    }
    mark |= std::uint64_t{1} << (v[0] >> shift);
    if ((bits.any ^ bits.all) >> shift == 0) return mark;  // mostly so, and found without a loop over bits
    for (std::size_t i = 1; i < count; ++i) mark |= std::uint64_t{1} << (v[i] >> shift);
    return mark;
}

void VertexRanges::list(const Allocator* allocator) {
    const auto forEach = [&](const auto& body) {
        for (std::size_t block = 0; block < block_count_; ++block) {
            for (std::uint64_t rest = marks_[block] & ~kRepeated; rest != 0; rest &= rest - 1)
                body(block, static_cast<std::size_t>(std::countr_zero(rest)));
        }
    };
    std::fill_n(begins_, kMost + 1, std::size_t{0});
    forEach([&](std::size_t, std::size_t range) { ++begins_[range]; });
    std::size_t total = 0;
    for (std::size_t& place : begins_) total += std::exchange(place, total);
    blocks_ = Buffer<std::uint32_t>(allocator, total);
    forEach(
        [&](std::size_t block, std::size_t range) { blocks_[begins_[range]++] = static_cast<std::uint32_t>(block); });
    for (std::size_t range = kMost; range > 0; --range) begins_[range] = begins_[range - 1];
    begins_[0] = 0;
}

}  // namespace tspace
