// SPDX-License-Identifier: MIT
// Uncompressed texel formats, and the table of all formats.
#include "images/textures/texel_format.h"

#include <algorithm>
#include <bit>
#include <cstddef>

#include "images/textures/pack_block.h"

namespace tspace {

// Decoders of BC1 to BC5 and EAC. Formulas: Khronos Data Format Specification 1.4, chapters S3TC, RGTC and ETC2. Values
// are computed exactly, whereas hardware rounds.

namespace {

constexpr std::size_t kBlockTexels = 16;

/// Decodes BC1 colors. With `has_alpha`, if the first endpoint is not larger than the second, the third color is their
/// mean and the fourth is transparent black.
void decodeColors(const std::uint8_t* block, bool has_alpha, Rgba* texels) {
    const std::uint32_t first = little16(block), second = little16(block + 2), codes = little32(block + 4);
    const bool is_cut = has_alpha && first <= second;
    constexpr unsigned kShift[] = {11, 5, 0}, kMax[] = {31, 63, 31};
    std::array<Rgba, 4> palette{};
    for (std::size_t i = 0; i < 3; ++i) {
        const unsigned a = first >> kShift[i] & kMax[i], b = second >> kShift[i] & kMax[i];
        const auto of = [&](unsigned sum, unsigned parts) {
            return static_cast<float>(sum) / static_cast<float>(parts * kMax[i]);
        };
        palette[0][i] = of(a, 1);
        palette[1][i] = of(b, 1);
        palette[2][i] = is_cut ? of(a + b, 2) : of(2 * a + b, 3);
        palette[3][i] = is_cut ? 0 : of(a + 2 * b, 3);
    }
    for (std::size_t i = 0; i < 4; ++i) palette[i][3] = is_cut && i == 3 ? 0.0F : 1.0F;
    for (std::size_t i = 0; i < kBlockTexels; ++i) texels[i] = palette[codes >> 2 * i & 3];
}

/// Returns the eight values of a BC4 channel.
std::array<float, 8> channelPalette(const std::uint8_t* block, bool is_signed) {
    const auto end = [&](std::uint8_t byte) {
        const int value = is_signed ? std::bit_cast<std::int8_t>(byte) : byte;
        return is_signed ? std::max(value, -127) + 127 : value;
    };
    const int most = is_signed ? 254 : 255, first = end(block[0]), second = end(block[1]);
    // Endpoints are compared as stored integers: -128 differs from -127, although both represent -1.
    const bool is_full =
        is_signed ? std::bit_cast<std::int8_t>(block[0]) > std::bit_cast<std::int8_t>(block[1]) : block[0] > block[1];
    const auto of = [&](int sum, int parts) { return static_cast<float>(sum) / static_cast<float>(parts * most); };
    std::array<float, 8> palette{of(first, 1), of(second, 1), 0, 0, 0, 0, 0, 1};
    const int parts = is_full ? 7 : 5;
    for (int k = 1; k < parts; ++k)
        palette[static_cast<std::size_t>(k) + 1] = of((parts - k) * first + k * second, parts);
    return palette;
}

void decodeChannel(const std::uint8_t* block, bool is_signed, std::size_t channel, Rgba* texels) {
    const std::array<float, 8> palette = channelPalette(block, is_signed);
    std::uint64_t codes = little64(block) >> 16;
    for (std::size_t i = 0; i < kBlockTexels; ++i, codes >>= 3) texels[i][channel] = palette[codes & 7];
}

/// Decodes an EAC channel. Its block is big-endian, with the codes in column-major order.
void decodeEacChannel(const std::uint8_t* block, bool is_signed, std::size_t channel, Rgba* texels) {
    const int stored = is_signed ? std::max<int>(std::bit_cast<std::int8_t>(block[0]), -127) : block[0];
    const int base = is_signed ? stored * 8 : stored * 8 + 4;
    const int multiplier = block[1] >> 4, step = multiplier == 0 ? 1 : 8 * multiplier;
    const std::int8_t* const modifiers = kEacModifiers[block[1] & 15];
    std::uint64_t codes = 0;
    for (std::size_t i = 2; i < 8; ++i) codes = codes << 8 | block[i];
    for (std::size_t i = 0; i < kBlockTexels; ++i) {
        const int value = base + modifiers[codes >> (45 - 3 * i) & 7] * step;
        const std::size_t texel = i % 4 * 4 + i / 4;
        texels[texel][channel] = is_signed ? static_cast<float>(std::clamp(value, -1023, 1023) + 1023) / 2046.0F
                                           : static_cast<float>(std::clamp(value, 0, 2047)) / 2047.0F;
    }
}

constexpr std::uint8_t kEtc1Modifiers[8][2] = {{2, 8},   {5, 17},  {9, 29},   {13, 42},
                                               {18, 60}, {24, 80}, {33, 106}, {47, 183}};

/// Returns a channel of an ETC1S slice, 0 to 255.
int etc1sValue(const std::uint8_t* slice, std::size_t channel, std::size_t texel) {
    const unsigned code = slice[4 + texel / 4] >> 2 * (texel % 4) & 3;
    const std::uint8_t* const modifiers = kEtc1Modifiers[slice[3] & 7];
    const int by = code == 0 ? -modifiers[1] : code == 1 ? -modifiers[0] : modifiers[code - 2];
    return std::clamp((slice[channel] << 3 | slice[channel] >> 2) + by, 0, 255);
}

template <class DecodeOne>
void decodeChannels(const TexelFormat& format, const std::uint8_t* block, Rgba* texels, const DecodeOne& decode) {
    std::fill_n(texels, kBlockTexels, Rgba{0, 0, 0, 1});
    for (std::size_t i = 0; i < format.channels; ++i) decode(block + 8 * i, format.is_signed, i, texels);
    if (format.channels != 1) return;
    for (std::size_t i = 0; i < kBlockTexels; ++i) texels[i][1] = texels[i][2] = texels[i][0];
}

}  // namespace

void decodeBc1(const TexelFormat&, const std::uint8_t* block, Rgba* texels) { decodeColors(block, true, texels); }

void decodeBc2(const TexelFormat&, const std::uint8_t* block, Rgba* texels) {
    decodeColors(block + 8, false, texels);
    const std::uint64_t alpha = little64(block);
    for (std::size_t i = 0; i < kBlockTexels; ++i) texels[i][3] = static_cast<float>(alpha >> 4 * i & 15) / 15.0F;
}

void decodeBc3(const TexelFormat&, const std::uint8_t* block, Rgba* texels) {
    decodeColors(block + 8, false, texels);
    decodeChannel(block, false, 3, texels);
}

void decodeBc4(const TexelFormat& format, const std::uint8_t* block, Rgba* texels) {
    decodeChannels(format, block, texels, decodeChannel);
}

/// Inverts a BC4 channel exactly: inverts and swaps the endpoints, and exchanges the codes accordingly.
void invertBc4Channel(const TexelFormat& format, std::uint8_t* block, unsigned channel) {
    std::uint8_t* const at = block + std::size_t{8} * channel;
    const auto inverted = [&](std::uint8_t byte) {
        if (!format.is_signed) return static_cast<std::uint8_t>(255 - byte);
        const int value = std::bit_cast<std::int8_t>(byte);
        return static_cast<std::uint8_t>(value == -128 ? 127 : -value);
    };
    const bool is_full =
        format.is_signed ? std::bit_cast<std::int8_t>(at[0]) > std::bit_cast<std::int8_t>(at[1]) : at[0] > at[1];
    const std::uint8_t first = inverted(at[1]), second = inverted(at[0]);
    at[0] = first;
    at[1] = second;
    // -127 and -128 represent the same value. If both are endpoints, all values of the block are equal.
    const bool is_one = is_full && first == second;
    std::uint64_t codes = 0;
    for (unsigned i = 0; i < kBlockTexels; ++i) {
        const std::size_t bit = 16 + 3 * i;
        const unsigned code = static_cast<unsigned>(little64(at) >> bit) & 7;
        unsigned changed = code < 2 ? 1 - code : is_full ? 9 - code : code < 6 ? 7 - code : 13 - code;
        if (is_one) changed = 0;
        codes |= std::uint64_t{changed} << 3 * i;
    }
    for (std::size_t i = 0; i < 6; ++i) at[2 + i] = static_cast<std::uint8_t>(codes >> 8 * i);
}

void decodeEtc1s(const TexelFormat& format, const std::uint8_t* block, Rgba* texels) {
    for (std::size_t i = 0; i < kBlockTexels; ++i) {
        for (std::size_t k = 0; k < 3; ++k) texels[i][k] = static_cast<float>(etc1sValue(block, k, i)) / 255.0F;
        texels[i][3] = format.channels == 4 ? static_cast<float>(etc1sValue(block + 8, 1, i)) / 255.0F : 1.0F;
    }
}

void decodeEac(const TexelFormat& format, const std::uint8_t* block, Rgba* texels) {
    decodeChannels(format, block, texels, decodeEacChannel);
}

namespace {

float halfValue(std::uint32_t half) {
    const std::uint32_t sign = (half & 0x8000) << 16, exponent = half >> 10 & 31, fraction = half & 1023;
    if (exponent == 0) {
        // Subnormal numbers are multiples of 2^-24.
        const float value = static_cast<float>(fraction) * 0x1p-24F;
        return sign != 0 ? -value : value;
    }
    const std::uint32_t wide = exponent == 31 ? 255 : exponent + 112;
    return std::bit_cast<float>(sign | wide << 23 | fraction << 13);
}

/// Assigns the stored channels to red, green, blue and alpha.
template <class Channel>
void placeChannels(unsigned count, Rgba& texel, const Channel& channel) {
    texel = {0, 0, 0, 1};
    for (unsigned i = 0; i < count; ++i) texel[i] = channel(i);
    if (count == 1) texel[1] = texel[2] = texel[0];
}

void decodeBytes(const TexelFormat& format, const std::uint8_t* block, Rgba* texels) {
    placeChannels(format.channels, *texels, [&](unsigned i) {
        if (!format.is_signed) return static_cast<float>(block[i]) / 255.0F;
        const int value = std::bit_cast<std::int8_t>(block[i]);
        return static_cast<float>((value < -127 ? -127 : value) + 127) / 254.0F;
    });
}

/// Decodes texels whose channels are stored in the order blue, green, red.
void decodeBgrBytes(const TexelFormat& format, const std::uint8_t* block, Rgba* texels) {
    decodeBytes(format, block, texels);
    const float blue = (*texels)[0];
    (*texels)[0] = (*texels)[2];
    (*texels)[2] = blue;
}

void decodeWords(const TexelFormat& format, const std::uint8_t* block, Rgba* texels) {
    placeChannels(format.channels, *texels, [&](unsigned i) {
        const std::uint32_t word = little16(block + std::size_t{2} * i);
        if (!format.is_signed) return static_cast<float>(word) / 65535.0F;
        const int value = std::bit_cast<std::int16_t>(static_cast<std::uint16_t>(word));
        return static_cast<float>((value < -32767 ? -32767 : value) + 32767) / 65534.0F;
    });
}

void decodeHalves(const TexelFormat& format, const std::uint8_t* block, Rgba* texels) {
    placeChannels(format.channels, *texels,
                  [&](unsigned i) { return halfValue(little16(block + std::size_t{2} * i)); });
}

void decodeFloats(const TexelFormat& format, const std::uint8_t* block, Rgba* texels) {
    placeChannels(format.channels, *texels,
                  [&](unsigned i) { return std::bit_cast<float>(little32(block + std::size_t{4} * i)); });
}

void decodeTenBits(const TexelFormat&, const std::uint8_t* block, Rgba* texels) {
    const std::uint32_t word = little32(block);
    const auto part = [&](unsigned at) { return static_cast<float>(word >> at & 1023) / 1023.0F; };
    *texels = {part(0), part(10), part(20), static_cast<float>(word >> 30) / 3.0F};
}

void decodeMasked(const TexelFormat& format, const std::uint8_t* block, Rgba* texels) {
    std::uint32_t word = 0;
    for (unsigned i = 0; i < format.block_bytes; ++i) word |= std::uint32_t{block[i]} << 8 * i;
    const auto part = [&](std::uint32_t mask) {
        const auto shift = static_cast<unsigned>(std::countr_zero(mask));
        return static_cast<float>(static_cast<double>((word & mask) >> shift) / static_cast<double>(mask >> shift));
    };
    *texels = {0, 0, 0, 1};
    for (unsigned i = 0; i < 4; ++i) {
        if (format.masks[i] != 0) (*texels)[i] = part(format.masks[i]);
    }
    if (format.masks[1] == 0 && format.masks[2] == 0) (*texels)[1] = (*texels)[2] = (*texels)[0];
}

void invertByte(const TexelFormat& format, std::uint8_t* block, unsigned channel) {
    std::uint8_t& byte = block[channel];
    const int value = std::bit_cast<std::int8_t>(byte);
    byte = static_cast<std::uint8_t>(!format.is_signed ? 255 - byte : value == -128 ? 127 : -value);
}

void invertWord(const TexelFormat& format, std::uint8_t* block, unsigned channel) {
    std::uint8_t* const at = block + std::size_t{2} * channel;
    const std::uint32_t word = little16(at);
    const std::uint32_t changed = !format.is_signed ? 65535 - word : word == 0x8000 ? 0x7fff : 0x10000 - word;
    at[0] = static_cast<std::uint8_t>(changed);
    at[1] = static_cast<std::uint8_t>(changed >> 8);
}

/// Inverts the bits of the block that the channel's mask selects.
void invertMasked(const TexelFormat& format, std::uint8_t* block, unsigned channel) {
    for (unsigned i = 0; i < format.block_bytes; ++i)
        block[i] ^= static_cast<std::uint8_t>(format.masks[channel] >> 8 * i);
}

constexpr TexelFormat plainFormat(const char* name, std::uint8_t channels, std::uint8_t bits,
                                  void (*decode)(const TexelFormat&, const std::uint8_t*, Rgba*),
                                  bool is_signed = false) {
    return {.name = name,
            .block_bytes = static_cast<std::uint8_t>(channels * bits / 8),
            .channels = channels,
            .bits = bits,
            .is_signed = is_signed,
            .decode = decode,
            .invert = bits == 8    ? invertByte
                      : bits == 16 ? invertWord
                                   : nullptr};
}

constexpr TexelFormat floatFormat(const char* name, std::uint8_t channels, std::uint8_t bits,
                                  void (*decode)(const TexelFormat&, const std::uint8_t*, Rgba*)) {
    TexelFormat format = plainFormat(name, channels, bits, decode);
    format.is_float = true;
    format.invert = nullptr;
    return format;
}

constexpr TexelFormat blockFormat(const char* name, std::uint8_t bytes, std::uint8_t channels, std::uint8_t bits,
                                  void (*decode)(const TexelFormat&, const std::uint8_t*, Rgba*),
                                  bool is_signed = false) {
    return {.name = name,
            .width = 4,
            .height = 4,
            .block_bytes = bytes,
            .channels = channels,
            .bits = bits,
            .is_signed = is_signed,
            .decode = decode,
            .invert = decode == decodeBc4 ? invertBc4Channel : nullptr};
}

constexpr TexelFormat bgrxFormat() {
    TexelFormat format = plainFormat("B8G8R8X8", 3, 8, decodeBgrBytes);
    format.block_bytes = 4;
    return format;
}

constexpr TexelFormat tenBitFormat() {
    TexelFormat format = plainFormat("R10G10B10A2", 4, 16, decodeTenBits);
    format.block_bytes = 4;
    format.invert = invertMasked;
    format.masks = {0x3ff, 0xffc00, 0x3ff00000, 0xc0000000};
    return format;
}

constexpr TexelFormat maskedFormat() {
    TexelFormat format = plainFormat("uncompressed", 4, 8, decodeMasked);
    format.invert = invertMasked;
    return format;
}

/// Table of formats, in the order of TexelKind. In uncompressed formats that start with blue, green is still the second
/// channel. BC4, BC5 and EAC resolve more than 8 bits.
constexpr TexelFormat kFormats[] = {
    plainFormat("R8", 1, 8, decodeBytes),
    plainFormat("R8 signed", 1, 8, decodeBytes, true),
    plainFormat("R8G8", 2, 8, decodeBytes),
    plainFormat("R8G8 signed", 2, 8, decodeBytes, true),
    plainFormat("R8G8B8", 3, 8, decodeBytes),
    plainFormat("R8G8B8 signed", 3, 8, decodeBytes, true),
    plainFormat("B8G8R8", 3, 8, decodeBgrBytes),
    plainFormat("R8G8B8A8", 4, 8, decodeBytes),
    plainFormat("R8G8B8A8 signed", 4, 8, decodeBytes, true),
    plainFormat("B8G8R8A8", 4, 8, decodeBgrBytes),
    bgrxFormat(),
    tenBitFormat(),
    plainFormat("R16", 1, 16, decodeWords),
    plainFormat("R16 signed", 1, 16, decodeWords, true),
    plainFormat("R16G16", 2, 16, decodeWords),
    plainFormat("R16G16 signed", 2, 16, decodeWords, true),
    plainFormat("R16G16B16", 3, 16, decodeWords),
    plainFormat("R16G16B16 signed", 3, 16, decodeWords, true),
    plainFormat("R16G16B16A16", 4, 16, decodeWords),
    plainFormat("R16G16B16A16 signed", 4, 16, decodeWords, true),
    floatFormat("R16 float", 1, 16, decodeHalves),
    floatFormat("R16G16 float", 2, 16, decodeHalves),
    floatFormat("R16G16B16 float", 3, 16, decodeHalves),
    floatFormat("R16G16B16A16 float", 4, 16, decodeHalves),
    floatFormat("R32 float", 1, 32, decodeFloats),
    floatFormat("R32G32 float", 2, 32, decodeFloats),
    floatFormat("R32G32B32 float", 3, 32, decodeFloats),
    floatFormat("R32G32B32A32 float", 4, 32, decodeFloats),
    maskedFormat(),
    blockFormat("BC1", 8, 4, 8, decodeBc1),
    blockFormat("BC2", 16, 4, 8, decodeBc2),
    blockFormat("BC3", 16, 4, 8, decodeBc3),
    blockFormat("BC4", 8, 1, 16, decodeBc4),
    blockFormat("BC4 signed", 8, 1, 16, decodeBc4, true),
    blockFormat("BC5", 16, 2, 16, decodeBc4),
    blockFormat("BC5 signed", 16, 2, 16, decodeBc4, true),
    blockFormat("BC7", 16, 4, 8, decodeBc7),
    blockFormat("EAC R11", 8, 1, 16, decodeEac),
    blockFormat("EAC R11 signed", 8, 1, 16, decodeEac, true),
    blockFormat("EAC RG11", 16, 2, 16, decodeEac),
    blockFormat("EAC RG11 signed", 16, 2, 16, decodeEac, true),
    blockFormat("UASTC", 16, 4, 8, decodeUastc),
    blockFormat("ETC1S", 8, 3, 8, decodeEtc1s),
    blockFormat("ETC1S", 16, 4, 8, decodeEtc1s),
    blockFormat("ASTC", 16, 4, 16, nullptr),
    {},
};

}  // namespace

TexelFormat texelFormat(TexelKind kind) { return kFormats[static_cast<std::size_t>(kind)]; }

}  // namespace tspace
