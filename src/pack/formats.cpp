// SPDX-License-Identifier: MIT
#include "pack/formats.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace tspace::pack {

namespace {

/// A word of which only `kBytes` are there.
template <std::size_t kBytes>
std::uint32_t readWord(const std::byte* in) {
    std::uint32_t word = 0;
    if constexpr (std::endian::native == std::endian::little) {
        std::memcpy(&word, in, kBytes);
    } else {
        for (std::size_t i = 0; i < kBytes; ++i) word |= std::to_integer<std::uint32_t>(in[i]) << (8 * i);
    }
    return word;
}

template <std::size_t kBytes>
void readWords(const std::byte* in, std::size_t count, WordBlock& words) {
    // Words that lie as they are needed are copied many at a time: single ones would have to reach the cache before
    // vectors of them can be loaded.
    if (kBytes == 4 && std::endian::native == std::endian::little) {
        std::memcpy(words.word[0], in, 4 * count);
        return;
    }
    constexpr std::size_t kWhole = kBytes / 4, kRest = kBytes % 4;
    for (std::size_t i = 0; i < count; ++i, in += kBytes) {
        for (std::size_t w = 0; w < kWhole; ++w) words.word[w][i] = readWord<4>(in + 4 * w);
        if constexpr (kRest != 0) words.word[kWhole][i] = readWord<kRest>(in + 4 * kWhole);
    }
}

#define TSPACE_FRAME_FORMAT(bytes, bound_deg, kernel)                                                        \
    {                                                                                                        \
        bytes, bound_deg, [](SimdTarget wish) { return simd::choose(wish, TSPACE_KERNEL_TABLE(kernel))(); }, \
            readWords<bytes>                                                                                 \
    }

}  // namespace

const Format* formatOf(FrameFormat format) {
    constexpr FrameErrorBound kSnorm8{0.391, 0.391}, kSnorm16{0.00152, 0.00152};
    constexpr FrameErrorBound kFrame32{0.135, 0.135}, kFrame48{0.0037, 0.0042}, kFrame64{0.0001, 0.00015};
    constexpr FrameErrorBound kOct32{0.15, 0.165}, kQtangent64{0.004, 0.004};
    static constexpr Format kFormats[] = {
        // By the enumerators' values.
        TSPACE_FRAME_FORMAT(4, kFrame32, frame32Kernel),       TSPACE_FRAME_FORMAT(6, kFrame48, frame48Kernel),
        TSPACE_FRAME_FORMAT(8, kFrame64, frame64Kernel),       TSPACE_FRAME_FORMAT(4, kOct32, oct32Kernel),
        TSPACE_FRAME_FORMAT(8, kQtangent64, qtangent64Kernel), TSPACE_FRAME_FORMAT(8, kSnorm8, snorm8PairKernel),
        TSPACE_FRAME_FORMAT(16, kSnorm16, snorm16PairKernel),  TSPACE_FRAME_FORMAT(7, kSnorm8, gltfSnorm8Kernel),
        TSPACE_FRAME_FORMAT(14, kSnorm16, gltfSnorm16Kernel),
    };
    const auto index = static_cast<std::size_t>(format);
    return index < std::size(kFormats) ? &kFormats[index] : nullptr;
}

}  // namespace tspace::pack
