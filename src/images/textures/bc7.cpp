// SPDX-License-Identifier: MIT
// Decodes BC7. Formulas and tables: Khronos Data Format Specification 1.4, chapter BPTC.
#include <bit>
#include <cstddef>

#include "images/textures/texel_format.h"

namespace tspace {
namespace {

constexpr std::size_t kBc7Texels = 16;

/// Number of subsets, and number of bits of each field, in a mode.
struct Bc7Mode {
    std::uint8_t subsets, partition_bits, rotation_bits, selection_bits, color_bits, alpha_bits, endpoint_p, shared_p,
        index_bits, second_bits;
};
constexpr Bc7Mode kBc7Modes[] = {{3, 4, 0, 0, 4, 0, 1, 0, 3, 0}, {2, 6, 0, 0, 6, 0, 0, 1, 3, 0},
                                 {3, 6, 0, 0, 5, 0, 0, 0, 2, 0}, {2, 6, 0, 0, 7, 0, 1, 0, 2, 0},
                                 {1, 0, 2, 1, 5, 6, 0, 0, 2, 3}, {1, 0, 2, 0, 7, 8, 0, 0, 2, 2},
                                 {1, 0, 0, 0, 7, 7, 1, 0, 4, 0}, {2, 6, 0, 0, 5, 5, 1, 0, 2, 0}};

/// Subset of each texel, one bit per texel.
constexpr std::uint16_t kTwoSubsets[64] = {
    0xcccc, 0x8888, 0xeeee, 0xecc8, 0xc880, 0xfeec, 0xfec8, 0xec80, 0xc800, 0xffec, 0xfe80, 0xe800, 0xffe8,
    0xff00, 0xfff0, 0xf000, 0xf710, 0x008e, 0x7100, 0x08ce, 0x008c, 0x7310, 0x3100, 0x8cce, 0x088c, 0x3110,
    0x6666, 0x366c, 0x17e8, 0x0ff0, 0x718e, 0x399c, 0xaaaa, 0xf0f0, 0x5a5a, 0x33cc, 0x3c3c, 0x55aa, 0x9696,
    0xa55a, 0x73ce, 0x13c8, 0x324c, 0x3bdc, 0x6996, 0xc33c, 0x9966, 0x0660, 0x0272, 0x04e4, 0x4e40, 0x2720,
    0xc936, 0x936c, 0x39c6, 0x639c, 0x9336, 0x9cc6, 0x817e, 0xe718, 0xccf0, 0x0fcc, 0x7744, 0xee22};
/// Subset of each texel, two bits per texel.
constexpr std::uint32_t kThreeSubsets[64] = {
    0xaa685050, 0x6a5a5040, 0x5a5a4200, 0x5450a0a8, 0xa5a50000, 0xa0a05050, 0x5555a0a0, 0x5a5a5050,
    0xaa550000, 0xaa555500, 0xaaaa5500, 0x90909090, 0x94949494, 0xa4a4a4a4, 0xa9a59450, 0x2a0a4250,
    0xa5945040, 0x0a425054, 0xa5a5a500, 0x55a0a0a0, 0xa8a85454, 0x6a6a4040, 0xa4a45000, 0x1a1a0500,
    0x0050a4a4, 0xaaa59090, 0x14696914, 0x69691400, 0xa08585a0, 0xaa821414, 0x50a4a450, 0x6a5a0200,
    0xa9a58000, 0x5090a0a8, 0xa8a09050, 0x24242424, 0x00aa5500, 0x24924924, 0x24499224, 0x50a50a50,
    0x500aa550, 0xaaaa4444, 0x66660000, 0xa5a0a5a0, 0x50a050a0, 0x69286928, 0x44aaaa44, 0x66666600,
    0xaa444444, 0x54a854a8, 0x95809580, 0x96969600, 0xa85454a8, 0x80959580, 0xaa141414, 0x96960000,
    0xaaaa1414, 0xa05050a0, 0xa0a5a5a0, 0x96000000, 0x40804080, 0xa9a8a9a8, 0xaaaaaa44, 0x2a4a5254};

/// Anchor texel of the second subset, whose index has one bit less; the anchor of the first subset is texel 0.
constexpr std::uint8_t kAnchorOfTwo[64] = {15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15,
                                           15, 2,  8,  2,  2,  8,  8,  15, 2,  8,  2,  2,  8,  8,  2,  2,
                                           15, 15, 6,  8,  2,  8,  15, 15, 2,  8,  2,  2,  2,  15, 15, 6,
                                           6,  2,  6,  8,  15, 15, 2,  2,  15, 15, 15, 15, 15, 2,  2,  15};
constexpr std::uint8_t kSecondOfThree[64] = {
    3, 3,  15, 15, 8, 3,  15, 15, 8,  8, 6,  6, 6,  5,  3,  3,  3, 3,  8, 15, 3, 3, 6, 10, 5, 8,  8, 6,  8,  5,  15, 15,
    8, 15, 3,  5,  6, 10, 8,  15, 15, 3, 15, 5, 15, 15, 15, 15, 3, 15, 5, 5,  5, 8, 5, 10, 5, 10, 8, 13, 15, 12, 3,  3};
constexpr std::uint8_t kThirdOfThree[64] = {15, 8, 8,  3,  15, 15, 3,  8,  15, 15, 15, 15, 15, 15, 15, 8,
                                            15, 8, 15, 3,  15, 8,  15, 8,  3,  15, 6,  10, 15, 15, 10, 8,
                                            15, 3, 15, 10, 10, 8,  9,  10, 6,  15, 8,  15, 3,  6,  6,  8,
                                            15, 3, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 3,  15, 15, 8};

/// Interpolation weights in 64ths, one table for each number of index bits.
constexpr std::uint8_t kBc7Weights[5][16] = {{},
                                             {},
                                             {0, 21, 43, 64},
                                             {0, 9, 18, 27, 37, 46, 55, 64},
                                             {0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64}};

struct Bc7Block {
    Bc7Mode mode = {};
    std::uint32_t partition = 0, rotation = 0, selection = 0;
    /// 8-bit endpoints: [subset * 2 + end][channel].
    std::array<std::array<std::uint8_t, 4>, 6> ends = {};
    std::array<std::uint8_t, kBc7Texels> first = {}, second = {};  ///< both sets of interpolation indices

    [[nodiscard]] std::size_t subsetOf(std::size_t texel) const {
        if (mode.subsets == 2) return kTwoSubsets[partition] >> texel & 1;
        return mode.subsets == 3 ? kThreeSubsets[partition] >> 2 * texel & 3 : 0;
    }
    [[nodiscard]] bool isAnchor(std::size_t texel) const {
        if (texel == 0) return true;
        if (mode.subsets == 2) return texel == kAnchorOfTwo[partition];
        return mode.subsets == 3 && (texel == kSecondOfThree[partition] || texel == kThirdOfThree[partition]);
    }
};

void readBc7Ends(BlockBits& bits, Bc7Block& block) {
    const Bc7Mode& mode = block.mode;
    const std::size_t count = std::size_t{2} * mode.subsets;
    for (std::size_t channel = 0; channel < 4; ++channel) {
        const unsigned wide = channel == 3 ? mode.alpha_bits : mode.color_bits;
        for (std::size_t i = 0; i < count; ++i) block.ends[i][channel] = static_cast<std::uint8_t>(bits.take(wide));
    }
    std::array<std::uint32_t, 6> low{};
    for (std::size_t i = 0; i < count && mode.endpoint_p != 0; ++i) low[i] = bits.take(1);
    for (std::size_t i = 0; i < mode.subsets && mode.shared_p != 0; ++i) low[2 * i] = low[2 * i + 1] = bits.take(1);
    const unsigned extra = mode.endpoint_p + mode.shared_p;
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t channel = 0; channel < 4; ++channel) {
            const unsigned stored = channel == 3 ? mode.alpha_bits : mode.color_bits, wide = stored + extra;
            const std::uint32_t value = (std::uint32_t{block.ends[i][channel]} << extra | (extra != 0 ? low[i] : 0))
                                        << (8 - wide);
            block.ends[i][channel] = stored == 0 ? 255 : static_cast<std::uint8_t>(value | value >> wide);
        }
    }
}

/// Parses a block. Returns false for the reserved mode.
bool readBc7Block(const std::uint8_t* bytes, Bc7Block& block) {
    if (bytes[0] == 0) return false;
    const auto number = static_cast<unsigned>(std::countr_zero(bytes[0]));
    block.mode = kBc7Modes[number];
    BlockBits bits(bytes);
    bits.take(number + 1);
    block.partition = bits.take(block.mode.partition_bits);
    block.rotation = bits.take(block.mode.rotation_bits);
    block.selection = bits.take(block.mode.selection_bits);
    readBc7Ends(bits, block);
    for (std::size_t i = 0; i < kBc7Texels; ++i)
        block.first[i] = static_cast<std::uint8_t>(bits.take(block.mode.index_bits - (block.isAnchor(i) ? 1U : 0U)));
    if (block.mode.second_bits == 0) return true;
    for (std::size_t i = 0; i < kBc7Texels; ++i)
        block.second[i] = static_cast<std::uint8_t>(bits.take(block.mode.second_bits - (i == 0 ? 1U : 0U)));
    return true;
}

}  // namespace

void decodeBc7(const TexelFormat&, const std::uint8_t* bytes, Rgba* texels) {
    Bc7Block block;
    if (!readBc7Block(bytes, block)) {
        for (std::size_t i = 0; i < kBc7Texels; ++i) texels[i] = {0, 0, 0, 0};
        return;
    }
    const bool has_second = block.mode.second_bits != 0;
    for (std::size_t i = 0; i < kBc7Texels; ++i) {
        const std::size_t end = 2 * block.subsetOf(i);
        const unsigned first = kBc7Weights[block.mode.index_bits][block.first[i]];
        const unsigned second = has_second ? kBc7Weights[block.mode.second_bits][block.second[i]] : first;
        const unsigned of_color = block.selection == 0 ? first : second;
        const unsigned of_alpha = block.selection == 0 ? second : first;
        for (std::size_t channel = 0; channel < 4; ++channel) {
            const unsigned weight = channel == 3 ? of_alpha : of_color;
            const unsigned a = block.ends[end][channel], b = block.ends[end + 1][channel];
            texels[i][channel] = static_cast<float>((a * (64 - weight) + b * weight + 32) >> 6) / 255.0F;
        }
        if (block.rotation != 0) std::swap(texels[i][3], texels[i][block.rotation - 1]);
    }
}

}  // namespace tspace
