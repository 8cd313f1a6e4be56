// SPDX-License-Identifier: MIT
// Decodes UASTC. Formulas and tables: Khronos Data Format Specification 1.4, chapter UASTC (by Rich Geldreich, public
// domain).
#include <algorithm>
#include <cstddef>
#include <iterator>

#include "images/textures/texel_format.h"

namespace tspace {
namespace {

constexpr std::size_t kUastcTexels = 16, kSolid = 8;

/// A UASTC mode: its code, and the number of bits of each field.
struct UastcMode {
    std::uint8_t code, code_bits;
    std::uint8_t hint_bits;       ///< bits between the code and the pattern: hints for transcoding
    std::uint8_t pattern_bits;    ///< bits of the subset pattern
    std::uint8_t subsets, parts;  ///< parts: number of channels (2: luminance-alpha, 3: RGB, 4: RGBA)
    std::uint8_t base;            ///< base of the digits that extend the bits of an endpoint: 1 (none), 3 or 5
    std::uint8_t end_bits, weight_bits;
    bool has_planes, has_selector;  ///< two weight planes, and a field that selects the channel of the second one
};
constexpr UastcMode kUastcModes[] = {
    {0x01, 4, 15, 0, 1, 3, 3, 6, 4, false, false}, {0x35, 6, 15, 0, 1, 3, 1, 8, 2, false, false},
    {0x1d, 5, 15, 5, 2, 3, 1, 4, 3, false, false}, {0x03, 5, 15, 4, 3, 3, 3, 2, 2, false, false},
    {0x13, 5, 15, 5, 2, 3, 5, 3, 2, false, false}, {0x0b, 5, 15, 0, 1, 3, 1, 8, 3, false, false},
    {0x1b, 5, 15, 0, 1, 3, 5, 5, 2, true, true},   {0x07, 5, 15, 5, 2, 3, 5, 3, 2, false, false},
    {0x17, 5, 0, 0, 1, 4, 1, 8, 0, false, false},  {0x0f, 5, 23, 5, 2, 4, 1, 4, 2, false, false},
    {0x02, 3, 17, 0, 1, 4, 3, 4, 4, false, false}, {0x00, 2, 17, 0, 1, 4, 3, 4, 2, true, true},
    {0x06, 3, 17, 0, 1, 4, 3, 6, 3, false, false}, {0x1f, 5, 23, 0, 1, 4, 1, 8, 1, true, true},
    {0x0d, 5, 23, 0, 1, 4, 1, 8, 2, false, false}, {0x05, 7, 23, 0, 1, 2, 1, 8, 4, false, false},
    {0x15, 6, 23, 5, 2, 2, 1, 8, 2, false, false}, {0x25, 6, 23, 0, 1, 2, 1, 8, 2, true, false},
    {0x09, 4, 15, 0, 1, 3, 1, 5, 5, false, false}};

/// Subset of each texel, one bit per texel.
constexpr std::uint16_t kTwoPatterns[30] = {0xcccc, 0x8888, 0x1111, 0xecc8, 0x377f, 0xfeec, 0x0137, 0x137f,
                                            0xc800, 0x0013, 0xfe80, 0x17ff, 0x0017, 0x00ff, 0xfff0, 0x0fff,
                                            0xff71, 0x8eff, 0x08ce, 0x008c, 0x7310, 0xceff, 0x7331, 0x088c,
                                            0xceef, 0x6666, 0xf00f, 0x5555, 0x0f0f, 0x36c9};
constexpr std::uint16_t kPatternsOf7[19] = {0x00f0, 0x4444, 0x0133, 0xcc80, 0xf0ff, 0x2222, 0xffc8,
                                            0xccce, 0x3c03, 0x00ee, 0x7700, 0x3003, 0x00ce, 0xff80,
                                            0x6fff, 0x1333, 0x11ff, 0x136c, 0x00ef};
/// Subset of each texel, two bits per texel.
constexpr std::uint32_t kThreePatterns[11] = {0xa5a50000, 0xaa005555, 0xaa000055, 0x0000aa55, 0x25252525, 0x94949494,
                                              0x58585858, 0x56560202, 0x92929292, 0x55aa0055, 0xa05050a0};

constexpr std::uint8_t kUastcWeights[6][32] = {{},
                                               {0, 64},
                                               {0, 21, 43, 64},
                                               {0, 9, 18, 27, 37, 46, 55, 64},
                                               {0, 4, 8, 12, 17, 21, 25, 29, 35, 39, 43, 47, 52, 56, 60, 64},
                                               {0,  2,  4,  6,  8,  10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30,
                                                34, 36, 38, 40, 42, 44, 46, 48, 50, 52, 54, 56, 58, 60, 62, 64}};

/// Expands an endpoint of `bits` bits and a digit to 8 bits by ASTC's formula, whose constants depend on the number of
/// bits. The comments at the cases show the bits of `spread` as in ASTC's table: b is the second lowest bit of `value`,
/// c the third, and so on.
std::uint32_t widenWithDigit(std::uint32_t value, std::uint32_t digit, unsigned base, unsigned bits) {
    const std::uint32_t high = value >> 1;
    std::uint32_t spread = 0, factor = 0;
    if (base == 3) {
        switch (bits) {
            case 2:  // b000b0bb0
                spread = high << 8 | high << 4 | high << 2 | high << 1;
                factor = 93;
                break;
            case 4:  // dcb000dcb
                spread = high << 6 | high;
                factor = 22;
                break;
            default:  // 6: fedcb000f
                spread = high << 4 | high >> 4;
                factor = 5;
                break;
        }
    } else if (bits == 3) {  // cb0000cbc
        spread = high << 7 | high << 1 | high >> 1;
        factor = 26;
    } else {  // 5: edcb0000e
        spread = high << 5 | high >> 3;
        factor = 6;
    }
    const std::uint32_t flipped = (value & 1) != 0 ? 0x1ff : 0;
    const std::uint32_t sum = (digit * factor + spread) ^ flipped;
    return (flipped & 0x80) | sum >> 2;
}

struct UastcBlock {
    std::size_t number = 0;
    UastcMode mode = {};
    std::uint32_t pattern = 0, selected = 3;
    /// Endpoint colors with 8 bits per channel: [subset * 2 + end][channel].
    std::array<std::array<std::uint32_t, 4>, 6> ends = {};
    std::array<std::array<std::uint8_t, kUastcTexels>, 2> weights = {};

    [[nodiscard]] std::size_t subsetOf(std::size_t texel) const {
        if (mode.subsets == 3) return kThreePatterns[pattern] >> 2 * texel & 3;
        if (mode.subsets == 1) return 0;
        return (number == 7 ? kPatternsOf7[pattern] : kTwoPatterns[pattern]) >> texel & 1;
    }
    [[nodiscard]] bool hasPattern() const {
        if (mode.subsets == 1) return true;
        return pattern < (mode.subsets == 3 ? std::size(kThreePatterns)
                          : number == 7     ? std::size(kPatternsOf7)
                                            : std::size(kTwoPatterns));
    }
};

/// Reads the endpoints: low and high value of each channel, subset by subset.
void readUastcEnds(BlockBits& bits, UastcBlock& block) {
    const UastcMode& mode = block.mode;
    const std::size_t count = std::size_t{2} * mode.parts * mode.subsets;
    std::array<std::uint32_t, 18> values{}, digits{};
    const std::size_t per_group = mode.base == 3 ? 5 : 3;
    for (std::size_t at = 0; at < count && mode.base != 1; at += per_group) {
        constexpr unsigned kTritBits[] = {0, 2, 4, 5, 7, 8};
        const std::size_t group = std::min(per_group, count - at);
        std::uint32_t packed = bits.take(mode.base == 3 ? kTritBits[group] : 7);
        for (std::size_t i = 0; i < group; ++i, packed /= mode.base) digits[at + i] = packed % mode.base;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t value = bits.take(mode.end_bits);
        const unsigned wide = mode.end_bits;
        values[i] = mode.base == 1 ? (value << (8 - wide) | (wide == 8 ? 0 : value >> (2 * wide - 8)))
                                   : widenWithDigit(value, digits[i], mode.base, wide);
    }
    std::size_t at = 0;
    for (std::size_t subset = 0; subset < mode.subsets; ++subset) {
        std::array<std::uint32_t, 4>&low = block.ends[2 * subset], &high = block.ends[2 * subset + 1];
        low[3] = high[3] = 255;
        for (std::size_t part = 0; part < mode.parts; ++part, at += 2) {
            const std::size_t channel = mode.parts == 2 && part == 1 ? 3 : part;
            low[channel] = values[at];
            high[channel] = values[at + 1];
        }
        if (mode.parts != 2) continue;
        low[1] = low[2] = low[0];
        high[1] = high[2] = high[0];
    }
}

/// Reads the weights. The weight of the first texel of each subset has one bit less.
void readUastcWeights(BlockBits& bits, UastcBlock& block) {
    unsigned seen = 0;
    const std::size_t planes = block.mode.has_planes ? 2 : 1;
    for (std::size_t i = 0; i < kUastcTexels; ++i) {
        const unsigned subset = 1U << block.subsetOf(i);
        const unsigned wide = block.mode.weight_bits - ((seen & subset) == 0 ? 1U : 0U);
        seen |= subset;
        for (std::size_t plane = 0; plane < planes; ++plane)
            block.weights[plane][i] = kUastcWeights[block.mode.weight_bits][bits.take(wide)];
    }
}

/// Reads a block. Returns false if it is invalid. For a solid block only the first end is set.
bool readUastcBlock(const std::uint8_t* bytes, UastcBlock& block) {
    const auto hasCodeOf = [&](const UastcMode& mode) {
        return (bytes[0] & ((1U << mode.code_bits) - 1)) == mode.code;
    };
    const auto* const found = std::find_if(std::begin(kUastcModes), std::end(kUastcModes), hasCodeOf);
    if (found == std::end(kUastcModes)) return false;
    block.number = static_cast<std::size_t>(found - std::begin(kUastcModes));
    block.mode = *found;
    BlockBits bits(bytes);
    bits.take(block.mode.code_bits);
    if (block.number == kSolid) {
        for (std::uint32_t& channel : block.ends[0]) channel = bits.take(8);
        return true;
    }
    bits.take(block.mode.hint_bits);
    block.pattern = bits.take(block.mode.pattern_bits);
    if (block.mode.has_selector) block.selected = bits.take(2);
    if (!block.hasPattern()) return false;
    readUastcEnds(bits, block);
    readUastcWeights(bits, block);
    return true;
}

}  // namespace

void decodeUastc(const TexelFormat&, const std::uint8_t* bytes, Rgba* texels) {
    UastcBlock block;
    if (!readUastcBlock(bytes, block)) {
        // Magenta, which the specification defines as the error color.
        std::fill_n(texels, kUastcTexels, Rgba{1, 0, 1, 1});
        return;
    }
    for (std::size_t i = 0; i < kUastcTexels; ++i) {
        const std::size_t end = 2 * block.subsetOf(i);
        for (std::size_t channel = 0; channel < 4; ++channel) {
            std::uint32_t value = block.ends[end][channel];
            if (block.number != kSolid) {
                const std::size_t plane = block.mode.has_planes && channel == block.selected ? 1 : 0;
                const std::uint32_t weight = block.weights[plane][i];
                // Interpolates 16-bit endpoints and uses the upper 8 bits. (For files declared as sRGB, ASTC has
                // different lower 8 bits, which changes a value by at most 1; basisu ignores that too.)
                value = (257 * (value * (64 - weight) + block.ends[end + 1][channel] * weight) + 32) >> 14;
            }
            texels[i][channel] = static_cast<float>(value) / 255.0F;
        }
    }
}

}  // namespace tspace
