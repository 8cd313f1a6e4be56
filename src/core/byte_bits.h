// SPDX-License-Identifier: MIT
// Comparisons of 64 bytes at once, a bit each.
#pragma once

#include <cstddef>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__aarch64__) && defined(__ARM_NEON)
#include <arm_neon.h>
#endif

namespace tspace {

/// Bit i is set when bytes[i] < limit, for 64 bytes.
inline std::uint64_t bytesBelow(const std::uint8_t* bytes, std::uint8_t limit) {
#if defined(__SSE2__)
    const __m128i limits = _mm_set1_epi8(static_cast<char>(limit));
    std::uint64_t not_below = 0;
    for (std::size_t i = 0; i < 64; i += 16) {
        const __m128i here = _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes + i));
        const __m128i is_limit_least = _mm_cmpeq_epi8(_mm_min_epu8(here, limits), limits);
        not_below |= std::uint64_t{static_cast<std::uint32_t>(_mm_movemask_epi8(is_limit_least))} << i;
    }
    return ~not_below;
#elif defined(__aarch64__) && defined(__ARM_NEON)
    const uint8x16_t limits = vdupq_n_u8(limit), weights = vreinterpretq_u8_u64(vdupq_n_u64(0x8040201008040201u));
    const auto weighed = [&](std::size_t i) { return vandq_u8(vcltq_u8(vld1q_u8(bytes + i), limits), weights); };
    const uint8x16_t pairs = vpaddq_u8(vpaddq_u8(weighed(0), weighed(16)), vpaddq_u8(weighed(32), weighed(48)));
    return vgetq_lane_u64(vreinterpretq_u64_u8(vpaddq_u8(pairs, pairs)), 0);
#else
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < 64; ++i) bits |= std::uint64_t{bytes[i] < limit ? 1u : 0u} << i;
    return bits;
#endif
}

}  // namespace tspace
