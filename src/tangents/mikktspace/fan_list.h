// SPDX-License-Identifier: MIT
// Whether the triangles around a node form one connected fan, from a list of them. Following it as triangles
// come (fan.h) costs less where they come in mesh order; where they come in any order, a processor cannot
// foresee what each does, and here nothing has to be foreseen.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

#if defined(TSPACE_SIMD_X86)
#include <emmintrin.h>
#elif defined(TSPACE_SIMD_ARM64)
#include <arm_neon.h>
#endif

namespace tspace::mikk {

/// The corners at a node, in any order: each goes on to `next` and comes from `previous`, nodes that are given by
/// their distance from some node.
struct alignas(16) FanList {
    static constexpr std::uint32_t kMost = 8;
    static constexpr std::int16_t kNoNext = -32768, kNoPrevious = -32767;  ///< what unused places hold
    static constexpr std::int32_t kLeast = -32766, kLargest = 32767;       ///< distances

    std::int16_t next[kMost], previous[kMost];

    void clear() {
        for (std::uint32_t i = 0; i < kMost; ++i) next[i] = kNoNext;
        for (std::uint32_t i = 0; i < kMost; ++i) previous[i] = kNoPrevious;
    }
    /// Whether a list can hold a distance, which may have passed below zero.
    static bool holds(std::uint32_t distance) {
        constexpr auto kBelow = static_cast<std::uint32_t>(-kLeast);
        return distance + kBelow <= kBelow + kLargest;
    }
    void set(std::uint32_t place, std::uint32_t to_next, std::uint32_t to_previous) {
        next[place] = static_cast<std::int16_t>(to_next);
        previous[place] = static_cast<std::int16_t>(to_previous);
    }
};

/// What follows each place of a list, as eight bytes each.
struct FanLinks {
    std::uint64_t places;  ///< 8 * a place from which the corner goes on, if there is one only
    std::uint64_t counts;  ///< how many there are
};

using EightNumbers = std::uint16_t __attribute__((vector_size(16)));

/// From 256 times a count plus 8 times a place, which are below 256 each.
inline FanLinks splitLinks(EightNumbers links) {
#if defined(TSPACE_SIMD_X86)
    const __m128i both = std::bit_cast<__m128i>(links);
    const __m128i bytes = _mm_packus_epi16(_mm_and_si128(both, _mm_set1_epi16(0xff)), _mm_srli_epi16(both, 8));
    return {static_cast<std::uint64_t>(_mm_cvtsi128_si64(bytes)),
            static_cast<std::uint64_t>(_mm_cvtsi128_si64(_mm_unpackhi_epi64(bytes, bytes)))};
#elif defined(TSPACE_SIMD_ARM64)
    const auto both = std::bit_cast<uint16x8_t>(links);
    return {std::bit_cast<std::uint64_t>(vmovn_u16(both)), std::bit_cast<std::uint64_t>(vshrn_n_u16(both, 8))};
#else
    FanLinks split{0, 0};
    for (std::uint32_t i = 0; i < FanList::kMost; ++i) {
        const std::uint64_t link = links[i];
        split.places |= (link & 0xff) << 8 * i;
        split.counts |= (link >> 8) << 8 * i;
    }
    return split;
#endif
}

/// Lane by lane, with the other list turned by 0 to 7 lanes: each match adds its place, and 1 to the byte above.
inline FanLinks linksOf(const FanList& list) {
    using FourPairs = std::uint32_t __attribute__((vector_size(16)));
    const auto load = [](const std::int16_t* from) {
        EightNumbers numbers;
        std::memcpy(&numbers, __builtin_assume_aligned(from, sizeof numbers), sizeof numbers);
        return numbers;
    };
    const EightNumbers next = load(list.next), even = load(list.previous);
    const EightNumbers odd = __builtin_shufflevector(even, even, 1, 2, 3, 4, 5, 6, 7, 0);
    const auto even_pairs = std::bit_cast<FourPairs>(even), odd_pairs = std::bit_cast<FourPairs>(odd);
    EightNumbers links = {};
    const auto match = [&](auto previous, std::uint16_t first) {
        const auto place = [=](unsigned i) { return static_cast<std::uint16_t>(0x100 + 8 * ((first + i) % 8)); };
        const EightNumbers places{place(0), place(1), place(2), place(3), place(4), place(5), place(6), place(7)};
        links += std::bit_cast<EightNumbers>(next == std::bit_cast<EightNumbers>(previous)) & places;
    };
    match(even, 0);
    match(odd, 1);
    match(__builtin_shufflevector(even_pairs, even_pairs, 1, 2, 3, 0), 2);
    match(__builtin_shufflevector(odd_pairs, odd_pairs, 1, 2, 3, 0), 3);
    match(__builtin_shufflevector(even_pairs, even_pairs, 2, 3, 0, 1), 4);
    match(__builtin_shufflevector(odd_pairs, odd_pairs, 2, 3, 0, 1), 5);
    match(__builtin_shufflevector(even_pairs, even_pairs, 3, 0, 1, 2), 6);
    match(__builtin_shufflevector(odd_pairs, odd_pairs, 3, 0, 1, 2), 7);
    return splitLinks(links);
}

/// Whether the `count` corners of a list are one fan: each half-edge is there once, and the links of
/// corner_links.h, between which there is then nothing to choose, make one path or one ring of all of them. Not for
/// an empty list.
inline bool isOneFan(const FanList& list, std::uint32_t count) {
    constexpr std::uint64_t kOnes = 0x0101010101010101u, kPlaces = 0x38 * kOnes;
    const FanLinks links = linksOf(list);
    const std::uint64_t all = kOnes >> (64 - 8 * count);
    // A ring has as many links as corners, a path one less. Then the place that none leads to is what is left of
    // the sum of all places, and a link from the path's end to there makes it a ring.
    const std::uint64_t ends = all & ~links.counts;
    const std::uint64_t rest = 4u * count * (count - 1) - ((links.places * kOnes) >> 56);
    const std::uint64_t places = (links.places + (rest & 0x38) * ends) & kPlaces;
    // Eight steps around a ring come to all of its corners, the first one as well. Where they do, each corner
    // has one that leads to it, so that no half-edge is there twice.
    std::uint64_t place = 0, seen = 0;
    for (std::uint32_t i = 0; i < FanList::kMost; ++i) {
        place = (places >> place) & 0xff;
        seen |= std::uint64_t{1} << place;
    }
    return seen == all && (links.counts & ~kOnes) == 0 && (ends & (ends - 1)) == 0;
}

}  // namespace tspace::mikk
