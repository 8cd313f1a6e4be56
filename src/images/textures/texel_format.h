// SPDX-License-Identifier: MIT
// Texels in texture files (KTX2, DDS): single texels, or blocks of 4 x 4. They are decoded by the formulas of the
// specifications, without rounding to 8 bits.
#pragma once

#include <array>
#include <cstdint>

#include "core/base/numbers.h"

namespace tspace {

/// Red, green, blue and alpha from 0 to 1. Signed formats are mapped to (v + 1) / 2; floats keep the stored value. A
/// missing color channel is 0, missing alpha is 1; a single channel is copied to all three colors.
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
    masked,  ///< up to 32 bits per texel, with a mask per channel (DDS)
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
    etc1s,       ///< blocks as unpackBasisLz returns them
    etc1sAlpha,  ///< like etc1s, with a second slice per block, whose green channel is alpha
    astc,        ///< blocks of 4 x 4 texels; the caller sets other block sizes
    none
};

struct TexelFormat;

/// Inverts a channel of a block exactly: 1 - c.
using InvertChannel = void (*)(const TexelFormat&, std::uint8_t* block, unsigned channel);

struct TexelFormat {
    const char* name = "";
    std::uint8_t width = 1, height = 1;  ///< size of a block in texels
    std::uint8_t block_bytes = 0;        ///< bytes per block
    std::uint8_t channels = 4;
    std::uint8_t bits = 8;  ///< effective bits per channel: 8, 16 or 32 (floats)
    bool is_signed = false, is_float = false;
    /// Decodes a block to width * height texels, row by row. Accepts arbitrary bytes. Null if only whole levels can be
    /// decoded (ASTC).
    void (*decode)(const TexelFormat&, const std::uint8_t* block, Rgba* texels) = nullptr;
    InvertChannel invert = nullptr;           ///< null if the format cannot represent the result exactly
    std::array<std::uint32_t, 4> masks = {};  ///< channel masks of `masked`

    [[nodiscard]] std::uint64_t blocksAcross(std::uint32_t texels) const {
        return (std::uint64_t{texels} + width - 1) / width;
    }
    [[nodiscard]] std::uint64_t blocksDown(std::uint32_t texels) const {
        return (std::uint64_t{texels} + height - 1) / height;
    }
    /// Returns the size in bytes of an image. Does not overflow for sizes below 2^30.
    [[nodiscard]] std::uint64_t bytesOf(std::uint32_t across, std::uint32_t down) const {
        return blocksAcross(across) * blocksDown(down) * block_bytes;
    }
};

/// Returns a format. `none` has block_bytes 0; the caller must set the masks of `masked`.
TexelFormat texelFormat(TexelKind kind);

// Decoders of blocks of 16 texels. BC7 and UASTC are defined in 8-bit integers.

void decodeBc1(const TexelFormat& format, const std::uint8_t* block, Rgba* texels);
void decodeBc2(const TexelFormat& format, const std::uint8_t* block, Rgba* texels);
void decodeBc3(const TexelFormat& format, const std::uint8_t* block, Rgba* texels);
/// Decodes one or two channels, signed or unsigned.
void decodeBc4(const TexelFormat& format, const std::uint8_t* block, Rgba* texels);
void decodeEac(const TexelFormat& format, const std::uint8_t* block, Rgba* texels);
void decodeBc7(const TexelFormat& format, const std::uint8_t* block, Rgba* texels);
/// Decodes eight bytes per slice: RGB555 base color, intensity table index, and four rows of selectors.
void decodeEtc1s(const TexelFormat& format, const std::uint8_t* block, Rgba* texels);
void decodeUastc(const TexelFormat& format, const std::uint8_t* block, Rgba* texels);

void invertBc4Channel(const TexelFormat& format, std::uint8_t* block, unsigned channel);

inline std::uint32_t little16(const std::uint8_t* at) { return loadLittleEndian<std::uint16_t>(at); }
inline std::uint32_t little32(const std::uint8_t* at) { return loadLittleEndian<std::uint32_t>(at); }
inline std::uint64_t little64(const std::uint8_t* at) { return loadLittleEndian<std::uint64_t>(at); }

/// Block of 128 bits, read from the lowest bit on.
class BlockBits {
  public:
    explicit BlockBits(const std::uint8_t* block) : low_(little64(block)), high_(little64(block + 8)) {}

    /// Returns the next `count` bits (up to 32).
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
