// SPDX-License-Identifier: MIT
// Images as numbers: what normal maps are read into and written from. Linear; colour spaces are not looked at.
#pragma once

#include "images/image.h"
#include "tspace/images.h"
#include "tspace/vec.h"

namespace tspace {

/// Bytes per pixel that decoding, converting and packing a map hold, without the decoder's own.
inline constexpr std::uint64_t kMapPixelBytes = 72;
/// Larger images of a model are not written anew.
inline constexpr std::uint64_t kMostModelMapPixels = std::uint64_t{1} << 26;

/// What a file with its own layout of channels (KTX2, DDS, EXR) says of its pixels.
struct TextureFacts {
    std::string name = {};    ///< "BC5 in a DDS"
    MapLayout layout = {};    ///< of a normal map: where the format has x, y and z. Not the default: z is to be made
    bool is_guessed = false;  ///< the layout is not said by the format, but the texels look like it
    bool is_srgb = false;     ///< it says that its numbers have the sRGB curve, which normal maps must not have
    bool has_blocks = false;  ///< smaller levels cannot be made of it by who loads it
    std::uint32_t level_count = 1;
};

/// Whether it is a WebP that was packed as photographs are.
bool isLossyWebp(ByteSpan bytes);

/// By the head alone, so that nothing is guessed; nothing for other files and for what is not read.
std::optional<TextureFacts> textureFacts(ByteSpan bytes);

/// Channels as stored, from 0 (the integer 0) to 1 (the largest integer); floats as
/// they are, but for vectors from -1 to 1 (ImageUse). Of textures see Rgba in texel_format.h. The first row is the top one. An integer n of up to 16 bits comes back as n when it is written with as many bits.
struct FloatImage {
    std::uint32_t width = 0, height = 0;
    unsigned bits = 8;              ///< of a channel in the file: 8 or 16; of floats: 16 or 32. Of BC4, BC5 and EAC 16
    std::vector<Vec3> texels = {};  ///< width * height; of grey images all three are equal
    std::vector<float> alpha = {};  ///< as many, or empty: opaque
    std::uint64_t not_finite = 0;   ///< texels of an EXR or texture that were not finite, and are grey now
    TextureFacts texture = {};      ///< with an empty name for other files
    /// Where numbers of the file were moved to 0 to 1: one sentence that says why, and how sure that is. Else empty.
    std::string range_text = {};
};

/// decodeImage with all bits of the file. Memory: 16 bytes a pixel, or 12 without alpha, and the decoder's.
std::optional<FloatImage> decodeFloatImage(ByteSpan bytes, std::uint64_t most_pixels, std::string& why,
                                           ImageUse use = ImageUse::vectors);

/// An EXR with channels of 16 (half) or 32 bits, packed without loss. All are finite. Nothing where it is out of memory.
/// whyNotRead(ImageFormat::exr) must be null.
std::optional<std::vector<std::uint8_t>> encodeExr(const FloatImage& image, unsigned bits);

/// A PNG of 8 or 16 bits without a word on colours: each channel clamped to 0 to 1, then rounded to the nearest integer
/// (not finite: 0). Nothing where this build writes no PNG or libspng fails.
std::optional<std::vector<std::uint8_t>> encodePng(const FloatImage& image, unsigned bits);
/// encodePng for bytes.
std::optional<std::vector<std::uint8_t>> encodePng(const RgbImage& image);

}  // namespace tspace
