// SPDX-License-Identifier: MIT
// Texels as texture files (KTX2, DDS) hold them: one by one, or 4 x 4 in a block. Decoded to the numbers of the formulas, not rounded to 8 bits.
#pragma once

#include <array>
#include <cstdint>

#include "core/base/numbers.h"

namespace tspace {

/// Red, green, blue and alpha, from 0 to 1; of a signed format (v + 1) / 2, of floats as they are. A channel that the format does not
/// have is 0, alpha 1; a single channel is in all three colours.
using Rgba = std::array<float, 4>;

enum class TexelKind : std::uint8_t {
    r8,
    r8s,
    rg8,
    rg8s,
    rgb8,
    rgb8s,
    bgr8,
    rgba8,
    rgba8s,
    bgra8,
    bgrx8,
    rgb10a2,
    r16,
    r16s,
    rg16,
    rg16s,
    rgb16,
    rgb16s,
    rgba16,
    rgba16s,
    r16f,
    rg16f,
    rgb16f,
    rgba16f,
    r32f,
    rg32f,
    rgb32f,
    rgba32f,
    masked,  ///< up to 32 bits a texel, each channel where a mask says (DDS)
    bc1,
    bc2,
    bc3,
    bc4,
    bc4s,
    bc5,
    bc5s,
    bc7,
    eacR,
    eacRs,
    eacRg,
    eacRgs,
    uastc,
    etc1s,       ///< as decoded by unpackBasisLz
    etc1sAlpha,  ///< with a second slice, whose green is alpha
    astc,        ///< 4 x 4 texels; other block sizes must be set
    none
};

struct TexelFormat;

/// Inverts a channel of a block: 1 - c, exactly.
using InvertChannel = void (*)(const TexelFormat&, std::uint8_t* block, unsigned channel);

struct TexelFormat {
    const char* name = "";
    std::uint8_t width = 1, height = 1;  ///< texels of a block
    std::uint8_t block_bytes = 0;        ///< bytes per block
    std::uint8_t channels = 4;
    std::uint8_t bits = 8;  ///< effective bits per channel: 8, 16 or 32 (floats)
    bool is_signed = false, is_float = false;
    /// Writes width * height texels, row by row. Any bytes may come. Null: whole levels are decoded at once (ASTC).
    void (*decode)(const TexelFormat&, const std::uint8_t* block, Rgba* texels) = nullptr;
    InvertChannel invert = nullptr;           ///< null where the format cannot hold the result exactly
    std::array<std::uint32_t, 4> masks = {};  ///< channel masks of `masked`

    [[nodiscard]] std::uint64_t blocksAcross(std::uint32_t texels) const {
        return (std::uint64_t{texels} + width - 1) / width;
    }
    [[nodiscard]] std::uint64_t blocksDown(std::uint32_t texels) const {
        return (std::uint64_t{texels} + height - 1) / height;
    }
    /// Bytes of an image of that size. No product of sizes below 2^30 overflows.
    [[nodiscard]] std::uint64_t bytesOf(std::uint32_t across, std::uint32_t down) const {
        return blocksAcross(across) * blocksDown(down) * block_bytes;
    }
};

/// With block_bytes 0 for `none`; those of `masked` are to be set.
TexelFormat texelFormat(TexelKind kind);

// Decoders of blocks of 16 texels. BC7 and UASTC are defined in 8-bit integers.

void decodeBc1(const TexelFormat& format, const std::uint8_t* block, Rgba* texels);
void decodeBc2(const TexelFormat& format, const std::uint8_t* block, Rgba* texels);
void decodeBc3(const TexelFormat& format, const std::uint8_t* block, Rgba* texels);
/// One or two channels, signed or not.
void decodeBc4(const TexelFormat& format, const std::uint8_t* block, Rgba* texels);
void decodeEac(const TexelFormat& format, const std::uint8_t* block, Rgba* texels);
void decodeBc7(const TexelFormat& format, const std::uint8_t* block, Rgba* texels);
/// Eight bytes a slice: the colour of 5 bits a channel, the number of a table, and four rows of codes.
void decodeEtc1s(const TexelFormat& format, const std::uint8_t* block, Rgba* texels);
void decodeUastc(const TexelFormat& format, const std::uint8_t* block, Rgba* texels);

void invertBc4Channel(const TexelFormat& format, std::uint8_t* block, unsigned channel);

inline std::uint32_t little16(const std::uint8_t* at) { return loadLittleEndian<std::uint16_t>(at); }
inline std::uint32_t little32(const std::uint8_t* at) { return loadLittleEndian<std::uint32_t>(at); }
inline std::uint64_t little64(const std::uint8_t* at) { return loadLittleEndian<std::uint64_t>(at); }

/// A block of 128 bits, read from the lowest on.
class BlockBits {
  public:
    explicit BlockBits(const std::uint8_t* block) : low_(little64(block)), high_(little64(block + 8)) {}

    /// `count`: up to 32.
    std::uint32_t take(unsigned count) {
        if (count == 0) return 0;
        const auto value = static_cast<std::uint32_t>(low_ & ((std::uint64_t{1} << count) - 1));
        low_ = low_ >> count | high_ << (64 - count);
        high_ >>= count;
        return value;
    }

  private:
    std::uint64_t low_, high_;
};

}  // namespace tspace
