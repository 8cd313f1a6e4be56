// SPDX-License-Identifier: MIT
// Whether the triangles around a node form one connected fan, from a list of them. Following it as triangles
// come (fan.h) costs less where they come in mesh order; where they come in any order, a processor cannot
// foresee what each does, and here nothing has to be foreseen.
#pragma once

#include <bit>
#include <cstdint>

#if defined(TSPACE_SIMD_X86)
#include <emmintrin.h>
#endif

namespace tspace::mikk {

/// The corners at a node, in any order: each goes on to `next` and comes from `previous`. No node has the
/// numbers that unused places hold.
struct alignas(16) FanList {
    static constexpr std::uint32_t kMost = 8;
    static constexpr std::uint32_t kNoNext = 0xffffffffu, kNoPrevious = 0xfffffffeu;

    std::uint32_t next[kMost], previous[kMost];

    void clear() {
        for (std::uint32_t i = 0; i < kMost; ++i) next[i] = kNoNext;
        for (std::uint32_t i = 0; i < kMost; ++i) previous[i] = kNoPrevious;
    }
};

/// What follows each place of a list, as eight bytes each.
struct FanLinks {
    std::uint64_t places;  ///< 8 * a place from which the corner goes on, if there is one only
    std::uint64_t counts;  ///< how many there are
};

inline FanLinks linksOf(const FanList& list) {
#if defined(TSPACE_SIMD_X86)
    // Lane by lane, with one half of the other list turned by 0 to 3 lanes: each match adds its place, and 1 to
    // the byte above.
    const auto load = [](const std::uint32_t* from) {
        return _mm_load_si128(reinterpret_cast<const __m128i*>(from));
    };
    const __m128i next_low = load(list.next), next_high = load(list.next + 4);
    __m128i low = _mm_setzero_si128(), high = low;
    const auto match = [&](__m128i previous, __m128i places) {
        low = _mm_add_epi32(low, _mm_and_si128(_mm_cmpeq_epi32(next_low, previous), places));
        high = _mm_add_epi32(high, _mm_and_si128(_mm_cmpeq_epi32(next_high, previous), places));
    };
    const auto matchHalf = [&](__m128i previous, int first) {
        const auto place = [=](int i) { return 0x100 + 8 * (first + i % 4); };
        match(previous, _mm_setr_epi32(place(0), place(1), place(2), place(3)));
        match(_mm_shuffle_epi32(previous, 0x39), _mm_setr_epi32(place(1), place(2), place(3), place(4)));
        match(_mm_shuffle_epi32(previous, 0x4e), _mm_setr_epi32(place(2), place(3), place(4), place(5)));
        match(_mm_shuffle_epi32(previous, 0x93), _mm_setr_epi32(place(3), place(4), place(5), place(6)));
    };
    matchHalf(load(list.previous), 0);
    matchHalf(load(list.previous + 4), 4);
    const __m128i both = _mm_packs_epi32(low, high);
    const __m128i bytes =
        _mm_packus_epi16(_mm_and_si128(both, _mm_set1_epi16(0xff)), _mm_srli_epi16(both, 8));
    return {static_cast<std::uint64_t>(_mm_cvtsi128_si64(bytes)),
            static_cast<std::uint64_t>(_mm_cvtsi128_si64(_mm_unpackhi_epi64(bytes, bytes)))};
#else
    FanLinks links{0, 0};
    for (std::uint32_t i = 0; i < FanList::kMost; ++i) {
        std::uint64_t place = 0, count = 0;
        for (std::uint32_t j = 0; j < FanList::kMost; ++j) {
            place += list.next[i] == list.previous[j] ? 8 * j : 0;
            count += list.next[i] == list.previous[j] ? 1 : 0;
        }
        links.places |= (place & 0xff) << 8 * i;
        links.counts |= count << 8 * i;
    }
    return links;
#endif
}

/// Whether the `count` corners of a list are one fan: each half-edge is there once, and the links of
/// pairing.h, between which there is then nothing to choose, make one path or one ring of all of them. Not for
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
