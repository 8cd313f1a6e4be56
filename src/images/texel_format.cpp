// SPDX-License-Identifier: MIT
// Formats of texels that stand one by one, and the table of all formats.
#include "images/texel_format.h"

#include <bit>

namespace tspace {

namespace {

float halfValue(std::uint32_t half) {
    const std::uint32_t sign = (half & 0x8000) << 16, exponent = half >> 10 & 31, fraction = half & 1023;
    if (exponent == 0) {
        // Denormal: a multiple of 2^-24.
        const float value = static_cast<float>(fraction) * 0x1p-24F;
        return sign != 0 ? -value : value;
    }
    const std::uint32_t wide = exponent == 31 ? 255 : exponent + 112;
    return std::bit_cast<float>(sign | wide << 23 | fraction << 13);
}

/// Gives the channels that there are their places.
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

/// Blue first.
void decodeTurnedBytes(const TexelFormat& format, const std::uint8_t* block, Rgba* texels) {
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

/// All bits of the mask.
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
    TexelFormat format = plainFormat("B8G8R8X8", 3, 8, decodeTurnedBytes);
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

/// In the order of TexelKind. Of plain formats with blue first green is the second too. BC4, BC5 and EAC resolve more than 8 bits.
constexpr TexelFormat kFormats[] = {
    plainFormat("R8", 1, 8, decodeBytes),
    plainFormat("R8 signed", 1, 8, decodeBytes, true),
    plainFormat("R8G8", 2, 8, decodeBytes),
    plainFormat("R8G8 signed", 2, 8, decodeBytes, true),
    plainFormat("R8G8B8", 3, 8, decodeBytes),
    plainFormat("R8G8B8 signed", 3, 8, decodeBytes, true),
    plainFormat("B8G8R8", 3, 8, decodeTurnedBytes),
    plainFormat("R8G8B8A8", 4, 8, decodeBytes),
    plainFormat("R8G8B8A8 signed", 4, 8, decodeBytes, true),
    plainFormat("B8G8R8A8", 4, 8, decodeTurnedBytes),
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
