// SPDX-License-Identifier: MIT
// Finds the few vertices that can be equal to others, without a look at most of them: each hash counts in a small
// table.
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/memory.h"
#include "core/parallel.h"

namespace tspace {

/// How often each value of the hashes' upper bits occurs: never, once, or more often. Two bits a place: bit 0
/// says at least once, bit 1 more often.
class RepeatedHashes {
  public:
    static constexpr unsigned kMostRanges = 4;  ///< of vertices, counted at the same time, each in a table of its own

    /// How many ranges to count in: at most one per thread, and vertices enough to be worth it.
    static std::size_t rangesFor(std::size_t vertex_count, const Parallel& parallel) {
        return std::clamp<std::size_t>(vertex_count / kGrain, 1, std::min(parallel.width(), kMostRanges));
    }

    /// With n places per vertex 1 vertex of n + 1 is found although it is like no other, or fewer. `places_per_vertex`
    /// decides between that and a table that stays in the cache: a place takes 2 bits, up to twice rounded up.
    RepeatedHashes(std::size_t places_per_vertex, const Allocator* allocator, std::size_t vertex_count,
                   std::size_t ranges)
        : log2_(std::clamp<unsigned>(std::bit_width(places_per_vertex * vertex_count), 6, 32)),
          bytes_(std::size_t{1} << (log2_ - 2)),
          table_(allocator, bytes_ * ranges) {}

    void clear(std::size_t range) { std::fill_n(table_.data() + range * bytes_, bytes_, std::uint8_t{0}); }

    void add(std::size_t range, const std::uint32_t* hashes, std::size_t count) {
        std::uint8_t* table = table_.data() + range * bytes_;
        const unsigned shift = 32 - log2_;  // a copy: bytes that are written might be the member's
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t place = hashes[i] >> shift;
            std::uint8_t& byte = table[place / kPlacesPerByte];
            const unsigned once = 1u << 2 * (place % kPlacesPerByte), now = byte;
            byte = static_cast<std::uint8_t>(now | (now & once) << 1 | once);
        }
    }

    /// Adds all ranges up in the first one. Returns how many places are taken.
    std::size_t sum(std::size_t ranges, Parallel& parallel) {
        std::atomic<std::size_t> taken{0};
        parallel.forRanges(bytes_ / sizeof(std::uint64_t), kGrain, [&](std::size_t begin, std::size_t end) {
            constexpr std::uint64_t kOnce = 0x5555555555555555u;
            std::size_t mine = 0;
            for (std::size_t i = begin; i < end; ++i) {
                std::uint64_t total = word(0, i);
                for (std::size_t r = 1; r < ranges; ++r) {
                    const std::uint64_t other = word(r, i);
                    total |= other | (total & other & kOnce) << 1;
                }
                if (ranges > 1) std::memcpy(table_.data() + i * sizeof total, &total, sizeof total);
                mine += pairsSet(total & kOnce);
            }
            taken += mine;
        });
        return taken;
    }

    /// Writes the vertices of [0, count) whose hash another one may have to `list`, ascending, and returns how many
    /// they are. `list` has room for all and may be `hashes` itself.
    std::size_t collect(const std::uint32_t* hashes, std::size_t count, std::size_t ranges, std::uint32_t* list,
                        Parallel& parallel) const {
        std::size_t found[kMostRanges] = {};
        parallel.forTasks(ranges, [&](std::size_t range) {
            const std::size_t begin = count * range / ranges, end = count * (range + 1) / ranges;
            found[range] = repeated(hashes, begin, end, list + begin);
        });
        std::size_t total = found[0];
        for (std::size_t range = 1; range < ranges; ++range) {
            std::copy_n(list + count * range / ranges, found[range], list + total);
            total += found[range];
        }
        return total;
    }

  private:
    /// Writes those of the vertices [begin, end) to `list` whose hash another vertex may have. Returns how
    /// many.
    std::size_t repeated(const std::uint32_t* hashes, std::size_t begin, std::size_t end, std::uint32_t* list) const {
        const std::uint8_t* table = table_.data();
        const unsigned shift = 32 - log2_;
        std::size_t count = 0;  // list[count] is written in any case, and stays when the next one is written behind it
        for (std::size_t v = begin; v < end; ++v) {
            const std::uint32_t place = hashes[v] >> shift;
            list[count] = static_cast<std::uint32_t>(v);
            count += table[place / kPlacesPerByte] >> (2 * (place % kPlacesPerByte) + 1) & 1u;
        }
        return count;
    }

    static constexpr std::size_t kPlacesPerByte = 4;
    static constexpr std::size_t kGrain = 16384;

    /// How many of the bits 0, 2, 4, ... are set. (std::popcount is a call where the target is plain x86-64.)
    static std::size_t pairsSet(std::uint64_t x) {
        x = (x & 0x3333333333333333u) + (x >> 2 & 0x3333333333333333u);
        x = (x + (x >> 4)) & 0x0f0f0f0f0f0f0f0fu;
        return static_cast<std::size_t>((x * 0x0101010101010101u) >> 56);
    }
    [[nodiscard]] std::uint64_t word(std::size_t range, std::size_t i) const {
        std::uint64_t value = 0;
        std::memcpy(&value, table_.data() + range * bytes_ + i * sizeof value, sizeof value);
        return value;
    }

    unsigned log2_;
    std::size_t bytes_;
    Buffer<std::uint8_t> table_;
};

}  // namespace tspace
