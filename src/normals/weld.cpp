// SPDX-License-Identifier: MIT
// Welding by hash buckets, each sorted by position: no bucket, however full, costs more than sorting it.
#include "normals/weld.h"

#include <algorithm>
#include <bit>
#include <compare>

#include "core/hash.h"
#include "tspace/vec.h"

namespace tspace {

namespace {

constexpr std::size_t kGrain = 4096;

struct Key {
    std::uint32_t x, y, z;
    friend auto operator<=>(const Key&, const Key&) = default;
};

std::uint32_t bitsOf(float f) { return std::bit_cast<std::uint32_t>(f == 0 ? 0.0f : f); }

Key keyOf(const Vec3& p) { return {bitsOf(p.x), bitsOf(p.y), bitsOf(p.z)}; }

bool hasNan(const Vec3& p) { return p.x != p.x || p.y != p.y || p.z != p.z; }

void weldBucket(StridedSpan<const Vec3> positions, std::uint32_t* begin, std::uint32_t* end,
                std::uint32_t* lowest) {
    if (end - begin > 1) {
        std::sort(begin, end, [&](std::uint32_t a, std::uint32_t b) {
            const auto order = keyOf(positions[a]) <=> keyOf(positions[b]);
            return order != 0 ? order < 0 : a < b;
        });
    }
    for (const std::uint32_t* v = begin; v != end; ++v) {
        const bool same =
            v != begin && !hasNan(positions[*v]) && keyOf(positions[*v]) == keyOf(positions[v[-1]]);
        lowest[*v] = same ? lowest[v[-1]] : *v;
    }
}

}  // namespace

Buffer<std::uint32_t> weldPositions(StridedSpan<const Vec3> positions, const Allocator* allocator,
                                    Parallel& parallel) {
    const std::size_t count = positions.count;
    const std::size_t bucket_count = std::bit_ceil(std::max<std::size_t>(count, 1));
    const auto bucketOf = [&](std::size_t v) { return hashPosition(positions[v]) & (bucket_count - 1); };

    Buffer<std::uint32_t> ends(allocator, bucket_count + 1, 0);
    for (std::size_t v = 0; v < count; ++v) ++ends[bucketOf(v) + 1];
    for (std::size_t b = 0; b < bucket_count; ++b) ends[b + 1] += ends[b];
    Buffer<std::uint32_t> order(allocator, count);
    for (std::size_t v = 0; v < count; ++v) order[ends[bucketOf(v)]++] = static_cast<std::uint32_t>(v);

    // Filling has moved each bucket's begin to its end, which is where the next one began.
    Buffer<std::uint32_t> lowest(allocator, count);
    parallel.forRanges(bucket_count, kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            std::uint32_t* const begin = order.data() + (b == 0 ? 0 : ends[b - 1]);
            weldBucket(positions, begin, order.data() + ends[b], lowest.data());
        }
    });
    return lowest;
}

}  // namespace tspace
