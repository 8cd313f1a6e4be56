// SPDX-License-Identifier: MIT
// Images as numbers: what normal maps are read into and written from. Linear; colour spaces are not looked at.
#pragma once

#include "images/image.h"
#include "tspace/vec.h"

namespace tspace {

/// Bytes per pixel that decoding, converting and packing a map hold, without the decoder's own.
inline constexpr std::uint64_t kMapPixelBytes = 72;
/// Larger images of a model are not written anew.
inline constexpr std::uint64_t kMostModelMapPixels = std::uint64_t{1} << 26;

/// Channels as stored, from 0 (the integer 0) to 1 (the largest integer); floats of an EXR as they are. The first row is the top
/// one. An integer n of up to 16 bits comes back as n when it is written with as many bits.
struct FloatImage {
    std::uint32_t width = 0, height = 0;
    unsigned bits = 8;              ///< of a channel in the file: 8 or 16; of an EXR: 16 or 32
    std::vector<Vec3> texels = {};  ///< width * height; of grey images all three are equal
    std::vector<float> alpha = {};  ///< as many, or empty: opaque
    std::uint64_t not_finite = 0;   ///< texels of an EXR that were not finite, and are grey now
};

/// decodeImage with all bits of the file. Memory: 16 bytes a pixel, or 12 without alpha, and the decoder's.
std::optional<FloatImage> decodeFloatImage(ByteSpan bytes, std::uint64_t most_pixels, std::string& why);

/// An EXR with channels of 16 (half) or 32 bits, packed without loss. All are finite. Nothing where it is out of memory.
/// whyNotRead(ImageFormat::exr) must be null.
std::optional<std::vector<std::uint8_t>> encodeExr(const FloatImage& image, unsigned bits);

/// A PNG of 8 or 16 bits without a word on colours: each channel clamped to 0 to 1, then rounded to the nearest integer
/// (not finite: 0). Nothing where this build writes no PNG or libspng fails.
std::optional<std::vector<std::uint8_t>> encodePng(const FloatImage& image, unsigned bits);
/// encodePng for bytes.
std::optional<std::vector<std::uint8_t>> encodePng(const RgbImage& image);

}  // namespace tspace
