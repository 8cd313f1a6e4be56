// SPDX-License-Identifier: MIT
#include "core/pack/formats.h"

#include <bit>
#include <cstring>
#include <iterator>

namespace tspace::pack {

namespace {

std::uint32_t readWord(const std::byte* in) {
    std::uint32_t word = 0;
    if constexpr (std::endian::native == std::endian::little) {
        std::memcpy(&word, in, 4);
    } else {
        for (std::size_t i = 0; i < 4; ++i) word |= std::to_integer<std::uint32_t>(in[i]) << (8 * i);
    }
    return word;
}

/// A word of which only `kBytes` are there.
template <std::size_t kBytes>
void writeWord(std::uint32_t word, std::byte* out) {
    if constexpr (std::endian::native == std::endian::little) {
        std::memcpy(out, &word, kBytes);
    } else {
        for (std::size_t i = 0; i < kBytes; ++i) out[i] = static_cast<std::byte>(word >> (8 * i) & 0xff);
    }
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
        for (std::size_t w = 0; w < kWhole; ++w) words.word[w][i] = readWord(in + 4 * w);
        if constexpr (kRest != 0) words.word[kWhole][i] = readWord(in + kBytes - 4) >> (32 - 8 * kRest);
    }
}

template <std::size_t kBytes>
void writeWords(const WordBlock& words, std::size_t count, std::byte* out) {
    constexpr std::size_t kWhole = kBytes / 4, kRest = kBytes % 4;
    for (std::size_t i = 0; i < count; ++i, out += kBytes) {
        for (std::size_t w = 0; w < kWhole; ++w) writeWord<4>(words.word[w][i], out + 4 * w);
        if constexpr (kRest != 0) writeWord<kRest>(words.word[kWhole][i], out + 4 * kWhole);
    }
}

template <std::size_t kBytes>
constexpr Format formatWith(FrameErrorBound bound, FrameKernel (*kernel)(SimdTarget)) {
    return {kBytes, bound, kernel, readWords<kBytes>, writeWords<kBytes>};
}

#define TSPACE_KERNEL_FOR(kernel) [](SimdTarget wish) { return simd::choose(wish, TSPACE_KERNEL_TABLE(kernel))(); }

/// By the enumerators' values.
constexpr Format kFormats[] = {
    formatWith<4>({0.135, 0.135}, TSPACE_KERNEL_FOR(frame32Kernel)),
    formatWith<6>({0.0037, 0.0042}, TSPACE_KERNEL_FOR(frame48Kernel)),
    formatWith<8>({0.0001, 0.00015}, TSPACE_KERNEL_FOR(frame64Kernel)),
    formatWith<4>({0.15, 0.165}, TSPACE_KERNEL_FOR(oct32Kernel)),
    formatWith<8>({0.004, 0.004}, TSPACE_KERNEL_FOR(qtangent64Kernel)),
    formatWith<8>({0.391, 0.391}, TSPACE_KERNEL_FOR(snorm8PairKernel)),
    formatWith<16>({0.00152, 0.00152}, TSPACE_KERNEL_FOR(snorm16PairKernel)),
    formatWith<7>({0.391, 0.391}, TSPACE_KERNEL_FOR(gltfSnorm8Kernel)),
    formatWith<14>({0.00152, 0.00152}, TSPACE_KERNEL_FOR(gltfSnorm16Kernel)),
};

}  // namespace

const Format* formatOf(FrameFormat format) {
    const auto index = static_cast<std::size_t>(format);
    return index < std::size(kFormats) ? &kFormats[index] : nullptr;
}

}  // namespace tspace::pack
